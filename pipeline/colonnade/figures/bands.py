"""The measured angle over the band that a model's own uncertainty leaves: is the misfit within its spread?"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from colonnade.figures.curve import INTERVALS, Curve
from colonnade.figures.histories import ANGLE_LABEL, draw_angle, limit_of, time_limits
from colonnade.figures.panels import legend_above, stacked_panels
from colonnade.figures.style import model_style, styled

Array = NDArray[np.float64]

HEIGHT = 1.9
"""Of a model's panel, inches."""

SHADES = (0.18, 0.3)
"""Opacity of the widest band and of those inside it."""


class Spread(NamedTuple):
    """
    What an ensemble of one model says over time.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s.
    levels : ndarray, shape (q,)
        Between 0 and 1, increasing, the same distance from 0 and from 1.
    bands : ndarray, shape (q, n)
        θ/α at these quantiles; NaN where there is none.
    overturning_probability : float
    """

    time: Array
    levels: Array
    bands: Array
    overturning_probability: float


def bands_over_time(measured: Curve | None, spreads: Mapping[str, Spread]) -> Figure:
    """
    Draw the measured angle over the bands of each model, one panel a model.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s); None where it was not measured.
    spreads : mapping of str to Spread
        By model.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no model, or levels are not paired about the median.
    """
    if not spreads:
        raise ValueError("no ensemble was given; that of at least one model was expected")
    for model, spread in spreads.items():
        if not np.allclose(spread.levels + spread.levels[::-1], 1.0):
            raise ValueError(f"{model}: the levels {spread.levels.tolist()} are not paired about 0.5")
    with styled():
        figure, axes = stacked_panels([HEIGHT] * len(spreads))
        curves = [Curve(spread.time, band) for spread in spreads.values() for band in spread.bands]
        curves += [measured] if measured is not None else []
        limit = limit_of(curves)
        for panel, (model, spread) in zip(axes, spreads.items(), strict=True):
            colour = model_style(model)["color"]
            for index, low in enumerate(spread.levels[spread.levels < 0.5]):
                time, below, above = between(spread.time, spread.bands[index], spread.bands[-1 - index])
                panel.fill_between(
                    time,
                    np.clip(below, -2 * limit, 2 * limit),
                    np.clip(above, -2 * limit, 2 * limit),
                    color=colour,
                    alpha=SHADES[min(index, len(SHADES) - 1)],
                    linewidth=0,
                    label=f"{1 - 2 * low:.0%} of the runs" if panel is axes[0] else None,
                )
            draw_angle(panel, measured, {}, limit)
            panel.set_ylabel(f"{ANGLE_LABEL}, {model}")
            if spread.overturning_probability > 0:
                panel.annotate(
                    f"{spread.overturning_probability:.0%} overturn",
                    (0.995, 0.04),
                    xycoords="axes fraction",
                    ha="right",
                    fontsize=8,
                )
        axes[-1].set_xlim(*time_limits(curves))
        axes[-1].set_xlabel("time (s)")
        legend_above(figure, axes)
        return figure


def between(time: Array, below: Array, above: Array, *, intervals: int = INTERVALS) -> tuple[Array, Array, Array]:
    """
    Thin a band to one lowest and one highest value an interval of time, so that nothing inside it is lost.

    Parameters
    ----------
    time, below, above : ndarray, shape (n,)
    intervals : int, optional

    Returns
    -------
    time, below, above : ndarray
        As given where there are at most two samples an interval; else one of each an interval.
    """
    if time.size <= 2 * intervals:
        return time, below, above
    starts = np.unique(np.searchsorted(time, np.linspace(time[0], time[-1], intervals + 1)[:-1]))
    ends = np.append(starts[1:], time.size) - 1
    return (
        0.5 * (time[starts] + time[ends]),
        np.fmin.reduceat(below, starts),
        np.fmax.reduceat(above, starts),
    )
