"""The models of rocking, one module each, and their registry."""
