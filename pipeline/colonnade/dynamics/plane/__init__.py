"""The plane models: linear and nonlinear, on a sampled and on a harmonic base motion."""
