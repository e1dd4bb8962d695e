"""How a campaign file is written: tables, values with units, ids, paths, and the place of each key."""
