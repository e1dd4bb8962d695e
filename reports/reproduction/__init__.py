"""The reproduction of the paper by Manos, Petalas and Demosthenous: what it states, what we find, the pages."""
