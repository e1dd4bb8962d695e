"""How far a prediction is from a measurement."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def nrmse(measured: ArrayLike, predicted: ArrayLike, scale: float) -> float:
    """
    Root mean square of predicted minus measured, over a scale.

    Parameters
    ----------
    measured, predicted : array_like, shape (n,)
        In the same unit, without NaN.
    scale : float
        In that unit; the critical angle where the two are rocking angles.

    Returns
    -------
    nrmse : float
        Dimensionless.

    Raises
    ------
    ValueError
        If the shapes differ, there is no sample, or the scale is not positive.

    Examples
    --------
    >>> nrmse([0.0, 0.0], [0.1, -0.1], scale=0.2)
    0.5
    """
    a, b = np.asarray(measured, dtype=np.float64), np.asarray(predicted, dtype=np.float64)
    if a.shape != b.shape or a.size == 0:
        raise ValueError(f"measured has shape {a.shape} and predicted {b.shape}; the same, not empty, was expected")
    if not scale > 0:
        raise ValueError(f"scale is {scale}; a positive number was expected")
    return float(np.sqrt(np.mean((b - a) ** 2)) / scale)


def peak_ratio(values: ArrayLike, scale: float) -> float:
    """
    Largest magnitude over a scale, NaN samples left out.

    Parameters
    ----------
    values : array_like, shape (n,)
    scale : float
        In the unit of the values; the critical angle where they are rocking angles.

    Raises
    ------
    ValueError
        If no sample is a number, or the scale is not positive.

    Examples
    --------
    >>> peak_ratio([0.05, -0.1], scale=0.2)
    0.5
    """
    samples = np.asarray(values, dtype=np.float64)
    if not np.isfinite(samples).any():
        raise ValueError(f"none of {samples.size} samples is a number; at least one was expected")
    if not scale > 0:
        raise ValueError(f"scale is {scale}; a positive number was expected")
    return float(np.nanmax(np.abs(samples)) / scale)
