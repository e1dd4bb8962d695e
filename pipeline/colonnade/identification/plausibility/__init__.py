"""Plausibility: channels compared with each other and with the equation of motion."""
