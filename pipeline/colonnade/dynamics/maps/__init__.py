"""Stability maps of a block over frequency and amplitude, and its steady responses."""
