"""Identification of the coefficient of restitution from free vibrations."""
