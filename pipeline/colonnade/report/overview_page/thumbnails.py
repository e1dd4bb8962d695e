"""The rocking angle of a test in a row of a table: a line of some hundred bytes."""

from __future__ import annotations

import numpy as np

from colonnade.figures.panels.curve import Curve, envelope

WIDTH, HEIGHT = 64, 20
"""Of the picture, in its own units; its full height is ± the critical angle."""

_INTERVALS = 32


def polyline(ratio: Curve | None) -> str:
    """
    Write a history as the points of an SVG polyline.

    Parameters
    ----------
    ratio : Curve or None
        θ/α over time; gaps are bridged.

    Returns
    -------
    points : str
        Within `WIDTH` and `HEIGHT`, θ > 0 upwards, whole numbers; empty without two finite values.

    Examples
    --------
    >>> polyline(Curve(np.linspace(0.0, 1.0, 5), np.array([0.0, 0.0, 0.0, 1.0, 2.0])))
    '0,10 32,10 48,0 64,0'
    """
    if ratio is None:
        return ""
    known = np.isfinite(ratio.values)
    time, values = ratio.time[known], ratio.values[known]
    if time.size < 2 or time[-1] <= time[0]:
        return ""
    time, values = envelope(Curve(time, values), intervals=_INTERVALS)
    x = np.rint(WIDTH * (time - time[0]) / (time[-1] - time[0])).astype(int)
    y = np.rint(HEIGHT / 2 * (1 - np.clip(values, -1.0, 1.0))).astype(int)
    bends = np.ones(y.size, dtype=bool)
    bends[1:-1] = (y[1:-1] != y[:-2]) | (y[1:-1] != y[2:])
    return " ".join(f"{across},{down}" for across, down in zip(x[bends], y[bends], strict=True))
