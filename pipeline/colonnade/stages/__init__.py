"""The stages, one module each: what it reads, the work, how the result is described."""
