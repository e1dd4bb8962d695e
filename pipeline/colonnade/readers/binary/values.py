"""Numbers of any type -> a channel's values."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array


def as_values(numbers: NDArray[Any]) -> tuple[Array, str]:
    """
    Take numbers as a channel's values.

    Parameters
    ----------
    numbers : ndarray, shape (n,)
        Booleans, integers or floats.

    Returns
    -------
    values : ndarray of float64, shape (n,)
        The array itself where it is one already and needs no change; NaN in place of infinities.
    warning : str
        How many infinities there were, such as "2 values are infinite, …"; empty where there are none.
    """
    values = np.ascontiguousarray(numbers, dtype=np.float64)
    with np.errstate(all="ignore"):
        if np.isfinite(values.sum()):  # one pass without a copy: the usual case
            return values, ""
    infinite = np.isinf(values)
    if not infinite.any():
        return values, ""
    count = int(infinite.sum())
    first = int(np.argmax(infinite)) + 1
    what = "1 value is" if count == 1 else f"{count} values are"
    return np.where(infinite, np.nan, values), f"{what} infinite, the first at sample {first}: taken as missing"
