"""Whether the verdict "within its own spread" is right as often as it says, and what it finds."""
