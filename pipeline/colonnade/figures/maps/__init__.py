"""Figures of stability maps and steady responses."""
