"""Features of a response: outcome, order, impacts, forcing, and its rank among runs of a model."""
