"""Marks with error bars of what was measured: filled if it was used, open if it was left out."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.figures.style import FAINT, MEASURED


def draw_marks(
    axes: Axes,
    x: Array,
    y: Array,
    bars: Array,
    shown: NDArray[np.bool_],
    used: NDArray[np.bool_],
    labels: tuple[str, str],
    *,
    mark: str = "o",
    size: float = 3.0,
) -> None:
    """
    Draw marks with their bars.

    Parameters
    ----------
    axes : Axes
    x, y : ndarray, shape (n,)
    bars : ndarray, shape (n,) or (2, n)
        Lengths of the bars below and above; none where NaN.
    shown, used : ndarray of bool, shape (n,)
    labels : tuple of str
        Of those that were used, and of those that were left out.
    mark : str, optional
    size : float, optional
        Points.
    """
    for chosen, face, label in zip((shown & used, shown & ~used), (MEASURED["color"], "white"), labels, strict=True):
        if chosen.any():
            axes.errorbar(
                x[chosen],
                y[chosen],
                yerr=np.nan_to_num(bars[..., chosen]),
                fmt=mark,
                markersize=size,
                markerfacecolor=face,
                markeredgecolor=MEASURED["color"],
                markeredgewidth=0.8,
                ecolor=FAINT,
                elinewidth=0.8,
                label=label,
            )
