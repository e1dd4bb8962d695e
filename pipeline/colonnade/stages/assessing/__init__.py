"""The real column of an assessment, and the answer about it."""
