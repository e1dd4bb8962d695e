"""Drawings of a specimen with its transducers, to scale, from what the campaign file says of them."""
