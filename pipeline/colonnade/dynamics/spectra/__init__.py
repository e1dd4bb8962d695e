"""Rocking spectra of recorded motions and overturning spectra of pulses."""
