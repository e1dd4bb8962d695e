"""Measures of how well two histories agree."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def nrmse(measured: ArrayLike, predicted: ArrayLike, scale: float) -> float:
    """
    Root mean square of predicted minus measured over a scale.

    Parameters
    ----------
    measured, predicted : array_like, shape (n,)
        In one unit; a sample that is NaN in either does not count.
    scale : float
        In that unit, as the critical angle.

    Returns
    -------
    nrmse : float
        Dimensionless; NaN where no sample is in both.

    Examples
    --------
    >>> nrmse([0.0, 0.1], [0.0, 0.2], 0.1)
    0.7071067811865476
    """
    difference = np.asarray(predicted, dtype=np.float64) - np.asarray(measured, dtype=np.float64)
    difference = difference[np.isfinite(difference)]
    if difference.size == 0:
        return float("nan")
    return float(np.sqrt(np.mean(difference**2)) / scale)
