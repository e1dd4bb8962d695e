"""Which histories of a real column are run, and how each of them ends."""
