"""Curves over time, drawn with as many points as can be seen, and bands that stay exact as tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D

from colonnade.arrays import Array

INTERVALS = 600
"""Time intervals of an envelope: finer than a screen or a printer shows across a figure's width."""


class Curve(NamedTuple):
    """Times (s) and values of one line, both shape (n,); NaN for a missing value."""

    time: Array
    values: Array

    def within(self, first: float, last: float) -> Curve:
        """Return its part between two times, s."""
        inside = (self.time >= first) & (self.time <= last)
        return Curve(self.time[inside], self.values[inside])


def known(curves: Mapping[str, Curve]) -> dict[str, Curve]:
    """Leave out curves without any value."""
    return {name: curve for name, curve in curves.items() if np.isfinite(curve.values).any()}


def envelope(curve: Curve, *, intervals: int = INTERVALS) -> Curve:
    """
    Thin a long curve to the lowest and highest value of each stretch of its samples, so that no peak is lost.

    Parameters
    ----------
    curve : Curve
        Times not decreasing.
    intervals : int, optional
        Stretches with the same number of samples.

    Returns
    -------
    thinned : Curve
        The curve itself where it has at most two values a stretch; else at most two a stretch, in their order of time,
        and the first and last value. A stretch without any value gives one NaN, so that gaps stay gaps.

    Examples
    --------
    >>> short = Curve(np.array([0.0, 1.0]), np.array([0.0, 2.0]))
    >>> envelope(short) is short
    True
    """
    time, values = curve
    if time.size <= 2 * intervals:
        return curve
    size = -(-time.size // intervals)
    stretches = np.pad(values, (0, -time.size % size), constant_values=np.nan).reshape(-1, size)
    known = np.isfinite(stretches)
    starts = size * np.arange(len(stretches))
    lowest = starts + np.where(known, stretches, np.inf).argmin(axis=1)
    highest = starts + np.where(known, stretches, -np.inf).argmax(axis=1)
    index = np.unique(np.concatenate(([0, time.size - 1], lowest, highest)))
    return Curve(time[index], values[index])


def between(time: Array, below: Array, above: Array, *, intervals: int = INTERVALS) -> tuple[Array, Array, Array]:
    """Thin a long band to one lowest and one highest value a stretch of samples, so that nothing inside it is lost."""
    if time.size <= 2 * intervals:
        return time, below, above
    starts = np.arange(0, time.size, -(-time.size // intervals))
    ends = np.append(starts[1:], time.size) - 1
    return 0.5 * (time[starts] + time[ends]), np.fmin.reduceat(below, starts), np.fmax.reduceat(above, starts)


INTERVALS_PER_INCH = 104.0
"""Time intervals of an envelope over the width of its panel: finer than a screen or a printer shows."""


class LongLine(Line2D):
    """A line over rising times; `get_data` gives every sample, even those that are not drawn."""

    def draw(self, renderer: RendererBase) -> None:
        """Draw the envelope of the part in view."""
        time, values = (np.asarray(each, dtype=np.float64) for each in self.get_data(orig=False))
        axes = self.axes
        if not isinstance(axes, Axes) or time.size < 2:
            super().draw(renderer)
            return
        (first, last), intervals = _view(axes, time), _intervals(axes)
        thinned = envelope(Curve(time[first:last], _near(axes, values[first:last])), intervals=intervals)
        try:
            self.set_data(*thinned)
            super().draw(renderer)
        finally:
            self.set_data(time, values)
            self.stale = False


class LongBand(PolyCollection):
    """
    A band over rising times, a gap where either edge is NaN.

    `time`, `below` and `above` keep every sample, even if it is not drawn.
    """

    def __init__(self, time: Array, below: Array, above: Array, **look: Any) -> None:
        self.time, self.below, self.above = time, below, above
        super().__init__(_outlines(time, below, above), **look)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the part in view, with one lowest and one highest value for each interval that can be seen."""
        axes = self.axes
        if isinstance(axes, Axes) and self.time.size > 1:
            first, last = _view(axes, self.time)
            edges = (_near(axes, each[first:last]) for each in (self.below, self.above))
            self.set_verts(_outlines(*between(self.time[first:last], *edges, intervals=_intervals(axes))))
        super().draw(renderer)
        self.stale = False


def draw_curve(axes: Axes, curve: Curve, **look: Any) -> LongLine:
    """Draw a curve of any length into a panel; `look` is that of a line, with its `label`."""
    line = LongLine(curve.time, curve.values, **look)
    axes.add_artist(line)
    known = np.flatnonzero(np.isfinite(curve.values))
    if known.size:  # as `add_line` does by way of a path of all samples
        low, high = (float(limit(curve.values[known])) for limit in (np.min, np.max))
        axes.update_datalim([(curve.time[known[0]], low), (curve.time[known[-1]], high)])
    _scale_later(axes)
    return line


def draw_band(axes: Axes, time: Array, below: Array, above: Array, **look: Any) -> LongBand:
    """Shade between two curves of any length; `look` is that of a `PolyCollection`, with its `label`."""
    band = LongBand(time, below, above, **{"linewidth": 0, **look})
    axes.add_collection(band)
    _scale_later(axes)
    return band


def _scale_later(axes: Axes) -> None:
    """Have the axes that scale themselves do so once, before they are drawn, instead of after each curve."""
    axes.autoscale(None)  # type: ignore[arg-type]  # None is documented: it changes no switch


def _intervals(axes: Axes) -> int:
    return max(int(INTERVALS_PER_INCH * axes.bbox.width / axes.get_figure(root=True).dpi), 1)  # type: ignore[union-attr]


def _view(axes: Axes, time: Array) -> tuple[int, int]:
    """First and last index, the latter excluded, of the samples in view, with one more at each side."""
    low, high = sorted(axes.get_xlim())
    first, last = np.searchsorted(time, (low, high), side="left")
    return max(int(first) - 1, 0), min(int(last) + 2, time.size)


def _near(axes: Axes, values: Array) -> Array:
    """Clip values well outside the axis: a fallen block's ±π/2 would only lengthen a file."""
    if axes.get_yscale() != "linear":
        return values
    low, high = sorted(axes.get_ylim())
    return np.clip(values, low - (high - low) / 2, high + (high - low) / 2)


def _outlines(time: Array, below: Array, above: Array) -> list[Array]:
    """Outline of each stretch in which both edges are known."""
    known = np.concatenate(([False], np.isfinite(below) & np.isfinite(above), [False]))
    bounds = np.flatnonzero(known[1:] != known[:-1]).reshape(-1, 2)
    edges = [[np.column_stack((time, edge))[first:last] for edge in (below, above)] for first, last in bounds]
    return [np.concatenate((low, high[::-1])) for low, high in edges]
