"""The block, the base motion and the models of rocking, on plain arrays."""
