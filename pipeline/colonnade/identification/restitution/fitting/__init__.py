"""Free rocking fitted to the samples of a record, and what its residual says."""
