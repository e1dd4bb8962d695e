"""Synthetic ground motions of known origin: broad-band ones, some of them with a pulse."""
