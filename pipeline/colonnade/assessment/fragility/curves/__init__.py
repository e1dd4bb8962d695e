"""Curves over intensity: lognormal and isotonic fragilities, their misfit, the hazard and the annual rate."""
