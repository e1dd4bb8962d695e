"""
A dataset as NetCDF and back: attributes in forms that NetCDF has, labels as CF wants them, values as they are.

Text that names the positions of a dimension is stored as `<dimension>_name`: CF coordinate variables are numbers.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.findings import Finding, from_text, to_text
from colonnade.store.provenance import is_long

if TYPE_CHECKING:
    import netCDF4
    import xarray as xr

_LABEL = "_name"
_COORDINATES = "coordinates"
"""Attribute that names the coordinates of a variable or of the file, as CF has it."""

_COMPRESSION = {"zlib": True, "complevel": 4, "shuffle": True}
_AROUND = 1 << 20
"""Bytes that a file may need besides its arrays."""


def storable(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """
    Turn attributes into what NetCDF can hold.

    Returns
    -------
    stored : dict
        None left out, truth values as int8, mappings, lists of text and findings as JSON text.

    Examples
    --------
    >>> storable({"a": None, "notes": ["x"], "b": {"c": 1}, "d": 2.5})
    {'notes': '["x"]', 'b': '{"c": 1}', 'd': 2.5}
    """
    return {name: _storable(value) for name, value in attributes.items() if value is not None}


def _storable(value: Any) -> Any:
    if isinstance(value, (bool, np.bool_)):
        return np.int8(value)
    if isinstance(value, Mapping):
        return json.dumps(value, ensure_ascii=False, sort_keys=True)
    if isinstance(value, (list, tuple)) and any(isinstance(item, Finding) for item in value):
        return to_text(value)
    if isinstance(value, (list, tuple)) and all(isinstance(item, str) for item in value):
        return json.dumps(list(value), ensure_ascii=False)
    return value


def restored(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Turn what NetCDF held back into lists: of text, and the `warnings` into findings."""
    return {name: from_text(str(value)) if name == "warnings" else _listed(value) for name, value in attributes.items()}


def _listed(value: Any) -> Any:
    """Turn JSON text of a list of text back into the list; all else passes."""
    if not (isinstance(value, str) and value.startswith("[")):
        return value
    try:
        found = json.loads(value)
    except json.JSONDecodeError:
        return value
    return found if isinstance(found, list) and all(isinstance(item, str) for item in found) else value


def dump(path: Path, dataset: xr.Dataset) -> None:
    """
    Write a NetCDF file; it is on the disk when this returns.

    Parameters
    ----------
    path : Path
        Of a file that nobody else writes; what it holds is lost.
    dataset : xr.Dataset
        With attributes as `storable` makes them. Long arrays are stored as they are, all others compressed.

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
            _prepared(dataset).dump_to_store(NetCDF4DataStore(opened))  # type: ignore[no-untyped-call]
    except RuntimeError as error:
        _expect_room(path, _AROUND)
        raise OSError(errno.EIO, f"NetCDF could not write it: {error}") from error
    with path.open("rb") as stream:
        os.fsync(stream.fileno())


def _expect_room(path: Path, needed: int) -> None:
    if shutil.disk_usage(path.parent).free < needed:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def _prepared(dataset: xr.Dataset) -> xr.Dataset:
    """Set how xarray stores each variable."""
    # Text as text: of an empty array of objects xarray would make numbers.
    texts = {name: value.astype(str) for name, value in dataset.variables.items() if value.dtype.kind == "O"}
    prepared = dataset.assign(texts)
    for name in [str(name) for name in dataset.dims if name in prepared and prepared[name].dtype.kind in "UT"]:
        label = prepared[name].variable
        prepared = prepared.drop_vars(name).assign_coords({f"{name}{_LABEL}": (label.dims, label.values, label.attrs)})
    for variable in prepared.variables.values():
        if variable.dtype.kind in "fiu":
            # Missing samples are NaN and flagged; a fill value on a clock would be against CF.
            how = {"contiguous": True} if is_long(variable) else _COMPRESSION if variable.ndim > 0 else {}
            variable.encoding = {"_FillValue": None} | how
    return prepared


def loaded(opened: netCDF4.Dataset) -> xr.Dataset:
    """
    Load an open file with all values as they are stored: nothing is masked, scaled or decoded.

    xarray's own way decodes whatever CF knows, array by array, which takes nearly twice as long.
    """
    import xarray as xr

    opened.set_auto_maskandscale(False)
    attributes = attributes_of(opened)
    coordinates = {*str(attributes.pop(_COORDINATES, "")).split()}
    values: dict[str, xr.Variable] = {}
    for name, stored in opened.variables.items():
        own = attributes_of(stored)
        coordinates |= {*str(own.pop(_COORDINATES, "")).split()}
        array = np.asarray(stored[...], dtype=str if stored.dtype is str else None)
        dimension = name.removesuffix(_LABEL)
        if name != dimension and stored.dimensions == (dimension,):
            name = dimension
        values[name] = xr.Variable(stored.dimensions, array, own, fastpath=True)
        if stored.dimensions == (name,):
            coordinates.add(name)
    return xr.Dataset(
        {name: value for name, value in values.items() if name not in coordinates},
        {name: value for name, value in values.items() if name in coordinates},
        attributes,
    )


def attributes_of(stored: netCDF4.Dataset | netCDF4.Variable[Any]) -> dict[str, Any]:
    """Attributes of an open file or of a variable in it, as they are stored."""
    return {name: stored.getncattr(name) for name in stored.ncattrs()}
