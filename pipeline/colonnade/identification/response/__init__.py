"""What a response shows: outcome, order, impacts, forcing, and its rank among runs of a model."""
