"""Records as plain arrays: clocks, filters, quality, metrics."""
