"""Figures of rocking spectra and overturning spectra."""
