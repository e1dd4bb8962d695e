"""What functions take and return: arrays, one name for each element type, and datasets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Codes = NDArray[np.int8]
Vector = tuple[float, float, float]
Dataset: TypeAlias = "xr.Dataset"


def dataset(variables: Mapping[str, Any], coords: Any = None, attrs: Any = None) -> Dataset:
    """Make a dataset; xarray, whose import takes its time, is imported with the first."""
    import xarray as xr

    return xr.Dataset(variables, coords, attrs)
