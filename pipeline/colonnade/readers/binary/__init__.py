"""Binary files of recorders: catman, FAMOS, MDF, UFF."""
