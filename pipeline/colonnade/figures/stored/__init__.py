"""Figures of stored results: which curves go into which figure, and what is said to those who do not see it."""
