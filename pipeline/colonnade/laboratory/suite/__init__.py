"""A site for real columns: synthetic ground motions of known origin, broad-band, some of them with a pulse."""
