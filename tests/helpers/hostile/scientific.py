"""Hostile files of NumPy, HDF5, NetCDF and MATLAB."""

import struct
import warnings
import zlib

import numpy as np

from hostile.place import SWOLLEN, TIME, Hostile, Program


def numpy_object(place):
    """NumPy's own format: runs a program."""
    path = place.folder / "r.npy"
    np.save(path, np.array([Program(place.victim)], dtype=object), allow_pickle=True)
    return Hostile(path)


def _elsewhere(file, place):
    import h5py

    secret = str(place.secrets / "secret.h5")
    file["plain"] = np.arange(100.0)
    file["linked"] = h5py.ExternalLink(secret, "/x")
    raw = [(str(place.secrets / "secret"), 0, 400)]
    file.create_dataset("external", (100,), "<i4", external=raw)
    layout = h5py.VirtualLayout((100,), "<f8")
    layout[:] = h5py.VirtualSource(secret, "x", (100,))
    file.create_virtual_dataset("virtual", layout)
    file["circle"] = h5py.SoftLink("/circle")


def netcdf_elsewhere(place):
    """h5py, as NetCDF: takes numbers from another file."""
    import h5py

    path = place.folder / "r.nc"
    with h5py.File(path, "w") as file:
        _elsewhere(file, place)
    return Hostile(path)


def matlab_elsewhere(place):
    """h5py, as MATLAB 7.3: takes numbers from another file."""
    import h5py

    path = place.folder / "r73.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        _elsewhere(file, place)
        for item in ("plain", "external", "virtual"):
            file[item].attrs["MATLAB_class"] = np.bytes_("double")
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\2IM")
    return Hostile(path)


def hdf5_swelling(place):
    """h5py: a dataset of a terabyte in a few kilobytes."""
    import h5py

    path = place.folder / "swelling.h5"
    with h5py.File(path, "w") as file:
        file["plain"] = np.arange(100.0)
        file.create_dataset("huge", (1 << 37,), "f8", chunks=(1 << 20,), compression="gzip")
    return Hostile(path)


def matlab_swelling(place):
    """Own parser of MATLAB 5: a variable of a quarter of a gigabyte in a quarter of a megabyte."""
    size = SWOLLEN + 8
    head = (
        struct.pack("<II", 14, size + 56) + struct.pack("<IIII", 6, 8, 6, 0) + struct.pack("<IIii", 5, 8, 1, size // 8)
    )
    element = zlib.compress(
        head + struct.pack("<IHH4s", 0, 1, 1, b"a\0\0\0")[4:] + struct.pack("<II", 9, size) + bytes(size)
    )
    path = place.folder / "r5.mat"
    start = b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM"
    path.write_bytes(start + struct.pack("<II", 15, len(element)) + element)
    return Hostile(path)


def netcdf_classic(place):
    """SciPy's NetCDF 3: a dimension of two thousand million."""
    from scipy.io import netcdf_file

    path = place.folder / "r3.nc"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with netcdf_file(path, "w") as file:
            file.createDimension("n", 200)
            file.createVariable("a", "f8", ("n",))[:] = TIME
    content = path.read_bytes()
    path.write_bytes(content.replace(struct.pack(">I", 200), struct.pack(">I", 0x7FFFFFFF)))
    return Hostile(path)
