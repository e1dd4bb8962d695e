"""Figures as files: SVG, PNG, PDF, and CSV of what they show."""
