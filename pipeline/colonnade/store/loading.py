"""
NetCDF as `files` writes it, into memory.

xarray's own way decodes whatever CF knows, array by array, which takes a third longer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import netCDF4
    import xarray as xr

LABEL = "_name"
"""Ends the name of the variable that holds the labels of a dimension."""

_COORDINATES = "coordinates"
"""Attribute that names the coordinates of a variable or of the file, as CF has it."""


def loaded(opened: netCDF4.Dataset) -> xr.Dataset:
    """
    Load an open file with all values as they are stored.

    Parameters
    ----------
    opened : netCDF4.Dataset

    Returns
    -------
    dataset : xr.Dataset
        Nothing is masked, scaled or decoded. Labels are coordinates of their dimensions.
    """
    import xarray as xr

    opened.set_auto_maskandscale(False)
    attributes = _attributes(opened)
    coordinates = {*str(attributes.pop(_COORDINATES, "")).split()}
    values: dict[str, xr.Variable] = {}
    for name, stored in opened.variables.items():
        own = _attributes(stored)
        coordinates |= {*str(own.pop(_COORDINATES, "")).split()}
        array = np.asarray(stored[...], dtype=str if stored.dtype is str else None)
        dimension = name.removesuffix(LABEL)
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


def _attributes(stored: netCDF4.Dataset | netCDF4.Variable[Any]) -> dict[str, Any]:
    return {name: stored.getncattr(name) for name in stored.ncattrs()}
