"""Long arrays on their way to disk: NetCDF writes them as they are, without an image of the file in memory."""

from __future__ import annotations

import errno
import os
import shutil
from concurrent.futures import Future
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

_AROUND = 1 << 20
"""Bytes that a file may need besides its arrays."""


def write_file(path: Path, dataset: xr.Dataset, content: Future[str]) -> None:
    """
    Write a NetCDF file of which some arrays are long; it is on the disk when this returns.

    Parameters
    ----------
    path : Path
        Of a file that nobody else writes; what it holds is lost.
    dataset : xr.Dataset
        As it is to be stored.
    content : Future of str
        Hash of the dataset, stored as its attribute `content`; computed while the arrays are written.

    Raises
    ------
    OSError
        If there is not enough room, or the disk refuses.

    Notes
    -----
    The room is checked first: HDF5 does not let go of a file that it could not complete, nor of its bytes on the disk.
    """
    import netCDF4
    from xarray.backends import NetCDF4DataStore

    with path.open("wb"):  # the system's own error if it may not be written
        _expect_room(path, dataset.nbytes + _AROUND)
    try:
        with netCDF4.Dataset(path, "w") as opened:
            opened.set_fill_off()
            dataset.dump_to_store(NetCDF4DataStore(opened))  # type: ignore[no-untyped-call]
            opened.setncattr("content", content.result())
    except RuntimeError as error:
        _expect_room(path, _AROUND)
        raise OSError(errno.EIO, f"NetCDF could not write it: {error}") from error
    with path.open("rb") as stream:
        os.fsync(stream.fileno())


def _expect_room(path: Path, needed: int) -> None:
    if shutil.disk_usage(path.parent).free < needed:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
