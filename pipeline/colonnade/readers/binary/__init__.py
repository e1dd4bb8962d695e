"""Binary files of recorders: catman, DIAdem, FAMOS, UFF."""
