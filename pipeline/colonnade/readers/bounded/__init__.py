"""The separate process that reads binary files, with bounded memory, time and access to files."""
