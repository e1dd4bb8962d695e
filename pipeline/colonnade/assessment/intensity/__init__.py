"""How strong a ground motion is: measures in one registry, drift and its corrections, the largest velocity pulse."""
