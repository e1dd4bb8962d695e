"""What cannot be right: channels held against each other and against the equation of motion."""
