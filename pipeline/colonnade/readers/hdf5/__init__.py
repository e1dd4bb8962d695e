"""NetCDF and plain HDF5."""
