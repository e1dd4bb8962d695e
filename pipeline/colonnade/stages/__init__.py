"""The stages, one module each: the inputs, the work, and the description of the result."""
