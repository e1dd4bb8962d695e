"""What is asked of the real column: its properties, and the assessments of it."""
