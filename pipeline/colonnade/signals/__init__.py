"""Records as plain arrays: filters, rest, quality, metrics, and the clocks of recorders."""
