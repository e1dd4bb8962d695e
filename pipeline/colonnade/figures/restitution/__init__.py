"""Figures of a free vibration and its restitution."""
