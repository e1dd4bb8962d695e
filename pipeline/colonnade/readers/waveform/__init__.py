"""Seismic waveforms, read by ObsPy."""
