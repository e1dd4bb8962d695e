"""Sets of ground motions, and the hazard of a site."""
