"""Arcs of a rocking history, each between two impacts."""
