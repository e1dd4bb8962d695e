"""Clocks of recorders: time columns, delays and rates."""
