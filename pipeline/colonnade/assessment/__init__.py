"""Whether the real column will stand: measures of ground motions, fragility, criteria of practice."""
