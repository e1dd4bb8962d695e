"""Figures of stored results: the curves of each figure, and its description for those who cannot see it."""
