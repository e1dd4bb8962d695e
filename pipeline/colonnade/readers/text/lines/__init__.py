"""Lines of a text file: encoding, cells, blocks of numbers, and damage."""
