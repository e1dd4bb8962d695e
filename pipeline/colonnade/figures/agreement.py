"""How good predictions are: peaks over those measured, and PIT."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import scipy
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.arrays import Array
from colonnade.figures.files.output import link_to
from colonnade.figures.panels.layout import legend_outside, note, plain_decades
from colonnade.figures.style import LIMIT, SOFT, blank_figure, model_style, styled, width

LEAST_SPAN = 0.1, 1.0
"""Of both axes, at least."""

ROOM = 1.25
"""Factor by which the axes reach beyond the points; predictions outside, and overturning, are marked at the edge."""

PANEL = 0.88
"""Of its share of the width, the side of a panel without its labels."""

CLEAR = 7.0
"""Printer's points from the middle of a label to the next mark that are enough."""

ALONG = 30
"""Places on a bar that a label keeps clear of."""


class PeakPoint(NamedTuple):
    """
    One prediction of a test that rocked.

    Attributes
    ----------
    measured : float
        max |θ|/α.
    predicted : float or None
        None if the model overturns.
    low, high : float or None
        Ends of the band that holds 95 % of the model's runs; None if it is not known. Of a band that ends with
        runs that overturn, only `low` is known.
    test : str
        Id of the test that its mark leads to.
    number : int or None
        Under which the test is named.
    """

    measured: float
    predicted: float | None
    low: float | None
    high: float | None
    test: str
    number: int | None = None


@styled()
def predicted_over_measured(points: Mapping[str, Sequence[PeakPoint]]) -> Figure:
    """
    Draw predicted against measured peaks on logarithmic axes, a panel a model, with the line of equal peaks.

    Parameters
    ----------
    points : mapping of str to sequence of PeakPoint
        By model.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no point.

    Notes
    -----
    Bars are the bands of the model's runs. A triangle at the upper edge is a test that the model overturns, one at the
    lower edge a prediction too small for the axis.
    """
    limits = _limits([point for own in points.values() for point in own])
    # Square panels, with room for titles and labels.
    side = width() / max(len(points), 2)
    figure = Figure(figsize=(width(), side + 0.4), layout="constrained")
    panels = figure.subplots(1, max(len(points), 2), sharex=True, sharey=True, squeeze=False)[0]
    for axes in panels[len(points) :]:
        axes.remove()
    for axes, (model, own) in zip(panels, points.items(), strict=False):
        _scale(axes, limits)
        _draw(axes, model, own, limits, 72 * PANEL * side)
        axes.set(title=f"{model} model", xlabel="measured max |θ|/α")
    panels[0].set_ylabel("predicted max |θ|/α")
    return figure


def _limits(points: Sequence[PeakPoint]) -> tuple[float, float]:
    """Range of the measured peaks, widened to those predicted within a factor of ten."""
    measured = np.array([point.measured for point in points])
    low, high = min(float(measured.min()), LEAST_SPAN[0]), max(float(measured.max()), LEAST_SPAN[1])
    near = [point.predicted for point in points if point.predicted and low / 10 <= point.predicted <= 10 * high]
    return min([low, *near]) / ROOM, max([high, *near]) * ROOM


def _scale(axes: Axes, limits: tuple[float, float]) -> None:
    axes.set(xscale="log", yscale="log", xlim=limits, ylim=limits)
    axes.set_box_aspect(1)
    for axis in (axes.xaxis, axes.yaxis):
        plain_decades(axis, subs=(1.0, 2.0, 5.0) if limits[1] < 100 * limits[0] else (1.0,))
    axes.plot(limits, limits, **LIMIT)


def _draw(axes: Axes, model: str, points: Sequence[PeakPoint], limits: tuple[float, float], side: float) -> None:
    """Draw the points of a model in a panel of this side, in printer's points."""
    low, high = limits
    color = model_style(model)["color"]
    bars = [(each.measured, max(each.low, low), each.high or high) for each in points if each.low is not None]
    if bars:
        # One line with gaps: a bar each would make a page of a thousand tests heavy.
        lines = np.array([[(across, bottom), (across, top), (np.nan, np.nan)] for across, bottom, top in bars])
        axes.plot(*lines.reshape(-1, 2).T, color=color, linewidth=0.8, alpha=0.45, zorder=2)
    predicted = np.array([np.inf if point.predicted is None else point.predicted for point in points])
    heights = np.where(predicted > high, high / 1.06, np.where(predicted < low, low * 1.06, predicted))
    measured = np.array([point.measured for point in points])
    for marker, chosen in (("o", heights == predicted), ("^", predicted > high), ("v", predicted < low)):
        if chosen.any():
            size = 14 if marker == "o" else 26
            places = axes.scatter(
                measured[chosen],
                heights[chosen],
                s=size,
                marker=marker,
                linewidths=0.9,
                zorder=3,
                facecolors="white",
                edgecolors=color,
            )
            places.set_urls([link_to(point.test) for point, is_so in zip(points, chosen, strict=True) if is_so])
    where, ends = (
        np.log(each / low) / np.log(high / low) * side
        for each in (np.column_stack((measured, heights)), np.reshape(bars, (-1, 3)))
    )
    across, bottom, top = ends.T[..., None]
    along = np.broadcast_arrays(across, bottom + np.linspace(0.0, 1.0, ALONG) * (top - bottom))
    taken = np.vstack((where, np.stack(along, axis=-1).reshape(-1, 2)))
    for place, point, height in zip(where, points, heights.tolist(), strict=True):
        if point.number is None:
            continue
        shift = _free_place(place, taken, side)
        taken = np.vstack((taken, place + shift))
        aside = (float(shift[0]), float(shift[1]))
        note(axes, str(point.number), (point.measured, height), aside, ha="center", va="center", fontsize=7)


def _free_place(place: Array, taken: Array, side: float) -> Array:
    """Find where around a point, in printer's points, a label is clear of all that is there and of the edges."""
    shifts = np.array([(7, 4), (7, -4), (8, 0), (-7, 4), (-7, -4), (-8, 0), (0, 8), (0, -8)], dtype=np.float64)
    seen = place + shifts
    free = np.hypot(*(seen[:, None] - taken).transpose(2, 0, 1)).min(axis=1)
    room = np.minimum(free, np.minimum(seen, side - seen).min(axis=1))
    return np.asarray(shifts[np.argmax(np.minimum(room, CLEAR))])


FEW, FEW_BINS, BINS = 100, 5, 10
"""Bins of the PIT histogram of fewer tests than the first number, and of more."""


@styled()
def pit_histogram(models: Mapping[str, Array]) -> Figure:
    """
    Draw the histogram of the PIT of the measured amplitudes, by model.

    Grey: 95 % of the shares if the forecasts are right and the tests share no error.
    """
    figure = blank_figure(3.3)
    axes = figure.subplots()
    tests = max(each.size for each in models.values())
    count = FEW_BINS if tests < FEW else BINS
    edges = np.linspace(0.0, 1.0, count + 1)
    low, high = (scipy.stats.binom.ppf(level, tests, 1 / count) / tests for level in (0.025, 0.975))
    axes.axhspan(low, high, color=SOFT, alpha=0.15, linewidth=0)
    axes.axhline(1 / count, **LIMIT)
    for model, each in models.items():
        shares = np.histogram(each, edges)[0] / each.size
        axes.stairs(shares, edges, label=f"{model} model", baseline=None, **model_style(model))
    axes.set(xlim=(0, 1), xlabel="PIT of the measured amplitude", ylabel="share of the tests")
    axes.set_ylim(0, max(axes.get_ylim()[1], 1.15 * high))
    legend_outside(figure, [axes])
    return figure
