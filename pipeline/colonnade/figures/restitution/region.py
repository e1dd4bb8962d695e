"""The joint region of confidence of e and the critical angle: what one record says of both at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.figures.panels.layout import legend_outside
from colonnade.figures.style import FIT, LIMIT, MEASURED, blank_figure, styled
from colonnade.units.text import format_percent

POINTS = 181
"""Of an ellipse."""


class Region(NamedTuple):
    """
    Two quantities of one fit.

    Attributes
    ----------
    title : str
    centre : ndarray, shape (2,)
        e, and the critical angle over the one given.
    covariance : ndarray, shape (2, 2)
    """

    title: str
    centre: Array
    covariance: Array


@styled()
def joint_region(
    regions: Sequence[Region], *, levels: Sequence[float] = (0.5, 0.95), fixed: tuple[float, float, float] | None = None
) -> Figure:
    """
    Draw ellipses of confidence over e and α.

    Parameters
    ----------
    regions : sequence of Region
        One a free vibration.
    levels : sequence of float, optional
        Confidence that both quantities together lie inside.
    fixed : (float, float, float), optional
        e with its interval from the fit with the given α: drawn at 1.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no region, or a covariance is not positive definite.
    """
    if not regions:
        raise ValueError("no fit was given; at least one with the critical angle freed was expected")
    figure = blank_figure(3.0)
    axes = figure.subplots()
    for region in regions:
        for level in levels:
            outline = _ellipse(region, level)
            axes.plot(*outline, label=format_percent(level), color=FIT["color"], linewidth=0.6 + 0.8 * level)
            axes.fill(*outline, color=FIT["color"], alpha=0.1, linewidth=0)
        axes.plot(*region.centre, "o", color=FIT["color"], markersize=4)
        axes.annotate(
            region.title,
            (float(region.centre[0]), float(region.centre[1])),
            xytext=(5, 4),
            textcoords="offset points",
            fontsize=8,
        )
    axes.margins(0.06)
    axes.autoscale_view()
    axes.axhline(1.0, label="α as given", **LIMIT)
    if fixed is not None:
        value, low, high = fixed
        axes.errorbar(
            [value],
            [1.0],
            xerr=[[value - low], [high - value]],
            fmt="D",
            color=MEASURED["color"],
            markersize=4,
            elinewidth=1.1,
            label="e with α as given",
        )
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6))
    axes.set_xlabel("coefficient of restitution e")
    axes.set_ylabel("α fitted / α given")
    legend_outside(figure, [axes])
    return figure


def _ellipse(region: Region, level: float) -> tuple[Array, Array]:
    """Outline inside which χ² of two degrees of freedom has a probability of `level`."""
    covariance = np.asarray(region.covariance, dtype=np.float64)
    values, vectors = np.linalg.eigh(covariance)
    if covariance.shape != (2, 2) or not values.min() > 0:
        raise ValueError(f"{region.title}: the covariance {covariance.tolist()} is not positive definite")
    turn = np.linspace(0, 2 * np.pi, POINTS)
    radius = np.sqrt(-2 * np.log(1 - level))
    x, y = region.centre[:, None] + radius * (vectors * np.sqrt(values)) @ np.array([np.cos(turn), np.sin(turn)])
    return np.asarray(x), np.asarray(y)
