"""Long arrays on their way to disk: NetCDF lays out the file, then each array is written to its place as it is."""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr
from xarray.backends import NetCDF4DataStore
from xarray.backends.common import ArrayWriter

from colonnade.store.provenance import is_long

_AROUND = 1 << 20
"""Bytes that a file may need besides its long arrays."""


def write_file(path: Path, dataset: xr.Dataset) -> None:
    """
    Write a NetCDF file of which some arrays are long; it is on the disk when this returns.

    Parameters
    ----------
    path : Path
        Of a file that nobody else writes; what it holds is lost.
    dataset : xr.Dataset
        As it is to be stored. Attributes may be added with `add_attribute`.

    Raises
    ------
    OSError
        If there is not enough room, or the disk refuses.

    Notes
    -----
    Neither a copy of the arrays nor an image of the file is made. The arrays do not pass through HDF5, so that what
    the disk refuses is told by its own error.
    """
    arrays = {str(name): variable.values for name, variable in dataset.variables.items() if is_long(variable)}
    with path.open("wb"):  # whether it may be written is told here
        _expect_room(path, sum(values.nbytes for values in arrays.values()) + _AROUND)
    try:
        _lay_out(path, dataset)
        places = _places(path, arrays)
    except RuntimeError as error:
        raise OSError(errno.EIO, f"NetCDF could not begin it: {error}") from error
    with path.open("r+b") as stream:
        for name, values in arrays.items():
            stream.seek(places[name])
            stream.write(np.ascontiguousarray(values).data.cast("B"))
        stream.flush()
        os.fsync(stream.fileno())


def add_attribute(path: Path, name: str, value: str) -> None:
    """Add a global attribute to a file that was written; it is on the disk when this returns."""
    try:
        with netCDF4.Dataset(path, "a") as opened:
            opened.setncattr(name, value)
    except RuntimeError as error:
        raise OSError(errno.EIO, f"NetCDF could not complete it: {error}") from error
    with path.open("rb") as stream:
        os.fsync(stream.fileno())


class _Outline(ArrayWriter):
    """Writes the arrays that are not long; of others the last number, for which HDF5 gives all their place."""

    def add(self, source: Any, target: Any, region: Any = None) -> None:
        key = (slice(-1, None),) * source.ndim if is_long(source) else ...
        target[key] = source[key]


def _lay_out(path: Path, dataset: xr.Dataset) -> None:
    with netCDF4.Dataset(path, "w") as opened:
        opened.set_fill_off()
        dataset.dump_to_store(NetCDF4DataStore(opened), writer=_Outline())  # type: ignore[no-untyped-call]


def _places(path: Path, names: Any) -> dict[str, int]:
    """Where in the file each array starts, in bytes."""
    import h5py

    with h5py.File(path, "r") as opened:
        return {name: int(opened[name].id.get_offset()) for name in names}


def _expect_room(path: Path, needed: int) -> None:
    if shutil.disk_usage(path.parent).free < needed:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
