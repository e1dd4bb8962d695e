"""The plane models on a harmonic base motion: its envelope, and arcs in closed form or by series."""
