"""Which test tells most: of sine tests, free vibrations and earthquakes, from arrays of what is known so far."""
