"""Plain arrays of samples: clocks, filters, quality checks, rest, metrics."""
