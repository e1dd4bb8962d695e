"""How probable overturning is at an intensity: curves of outcomes, their intervals over records, and annual rates."""
