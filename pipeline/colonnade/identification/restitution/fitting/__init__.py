"""Free rocking fitted to the samples of a record, and the statistics of its residual."""
