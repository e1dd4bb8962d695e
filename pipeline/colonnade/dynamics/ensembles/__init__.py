"""Ensembles: many runs of one motion with varied inputs."""
