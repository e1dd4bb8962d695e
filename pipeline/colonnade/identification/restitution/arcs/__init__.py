"""Arcs of a rocking history: what lies between two impacts."""
