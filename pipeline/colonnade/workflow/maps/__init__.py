"""Stability maps and steady responses of a campaign: planned, made in blocks, stored, drawn."""
