"""How probably a real column overturns: curves over a measure of intensity, and twenty columns at a few levels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from colonnade.arrays import Array
from colonnade.figures.style import FAINT, FIT, INK, LIMIT, MEASURED, SOFT, LineStyle, blank_figure, is_narrow, styled

COLUMNS = 20
"""Columns that stand for all: one is 5 %."""

GROUND, FALLEN = "#8a6d3b", "#b5482f"
"""Colours of the ground, and of columns that have fallen; these also lie."""


class Curve(NamedTuple):
    """Probability over intensity with its interval; all of shape (n,)."""

    intensity: Array
    probability: Array
    low: Array
    high: Array


@styled()
def fragility(
    lognormal: Curve | None,
    isotonic: Curve,
    *,
    label: str,
    taken: str,
    shares: Array | None = None,
    axes: Axes | None = None,
) -> Figure:
    """
    Draw the probability of overturning over a measure of intensity.

    Parameters
    ----------
    lognormal : Curve or None
        None if missing.
    isotonic : Curve
        At the levels.
    label : str
        Of the measure, with its unit.
    taken : str
        The curve from which the answer is read: "lognormal" or "isotonic".
    shares : ndarray, shape (levels,), optional
        Shares of the histories that overturn at the levels of `isotonic`.
    axes : Axes, optional
        To draw into; a new figure with its legend otherwise.

    Returns
    -------
    figure : Figure
    """
    alone = axes is None
    if axes is None:
        axes = blank_figure(3.4).subplots()
    figure = cast(Figure, axes.get_figure(root=True))
    own: LineStyle = {**FIT, "linewidth": 1.6 if taken == "lognormal" else 0.9}
    steps: LineStyle = {
        **MEASURED,
        "linewidth": 1.6 if taken == "isotonic" else 0.9,
        "linestyle": (0, (4.0, 1.5)),
    }
    _draw(axes, isotonic, steps, "curve that only rises")
    if lognormal is not None:
        _draw(axes, lognormal, own, "lognormal curve")
    if shares is not None:
        axes.plot(
            isotonic.intensity,
            shares,
            linestyle="none",
            marker="o",
            markersize=4,
            color=INK,
            markerfacecolor="white",
            label="share at a level",
        )
    for share in (0.05, 0.5):
        axes.axhline(share, **LIMIT)
    axes.set(xscale="log", ylim=(-0.02, 1.02), xlabel=label, ylabel="probability of overturning")
    axes.set_yticks([0, 0.05, 0.25, 0.5, 0.75, 1.0], ["0", "5 %", "25 %", "50 %", "75 %", "100 %"])
    _plain_decades(axes)
    if alone:
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper left", ncols=1 if is_narrow() else 3)
    return figure


@styled()
def twenty_columns(levels: Sequence[str], probability: Array) -> Figure:
    """
    Draw, for a few levels, how many of twenty columns fall.

    Parameters
    ----------
    levels : sequence of str, length n
        Levels with their units.
    probability : ndarray, shape (n,)
        Of overturning, rounded to a twentieth in the picture.

    Returns
    -------
    figure : Figure
    """
    figure = blank_figure(0.42 * len(levels) + 0.35)
    axes = figure.subplots()
    for row, (level, share) in enumerate(zip(levels, np.asarray(probability), strict=True)):
        fallen = round(COLUMNS * float(share))
        base = -1.35 * row
        axes.plot([-0.4, COLUMNS - 0.1], [base, base], color=GROUND, linewidth=1.2)
        for place in range(COLUMNS):
            lies = place >= COLUMNS - fallen
            size = (0.74, 0.2) if lies else (0.2, 0.85)
            shape = Rectangle((place - (0.1 if lies else 0.0), base), *size, color=FALLEN if lies else INK, linewidth=0)
            axes.add_patch(shape)
        axes.text(-0.8, base + 0.3, level, ha="right", va="center")
        axes.text(COLUMNS + 0.1, base + 0.3, _falls(fallen), va="center", color=FALLEN if fallen else SOFT)
    axes.set(xlim=(-4.5, COLUMNS + 4.0), ylim=(-1.35 * (len(levels) - 1) - 0.25, 1.1))
    axes.axis("off")
    return figure


@styled()
def rate_by_intensity(edges: Array, shares: Array, *, label: str) -> Figure:
    """
    Draw which intensities make the annual rate of overturning.

    Parameters
    ----------
    edges : ndarray, shape (n + 1,)
        Of the measure.
    shares : ndarray, shape (n,)
        Of the rate.
    label : str
        Of the measure, with its unit.
    """
    figure = blank_figure(2.4)
    axes = figure.subplots()
    axes.stairs(100 * shares, edges, fill=True, color=SOFT, alpha=0.6)
    axes.set(xscale="log", xlabel=label, ylabel="share of the annual rate (%)")
    _plain_decades(axes)
    return figure


@styled()
def response_spectra(period: Array, acceleration: Array) -> Figure:
    """
    Draw the response spectra of ground motions as recorded, with their median.

    Parameters
    ----------
    period : ndarray, shape (k,)
        s.
    acceleration : ndarray, shape (n, k)
        Pseudo-acceleration, g.
    """
    figure = blank_figure(2.8)
    axes = figure.subplots()
    lines = axes.plot(period, acceleration.T, color=FAINT, linewidth=0.6)
    lines[0].set_label("a ground motion")
    axes.plot(period, np.median(acceleration, axis=0), color=INK, linewidth=1.6, label="median")
    axes.set(xscale="log", yscale="log", xlabel="period (s)", ylabel="pseudo-acceleration (g)")
    _plain_decades(axes)
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper left", ncols=2)
    return figure


def _falls(fallen: int) -> str:
    if fallen in (0, COLUMNS):
        return "hardly any falls" if fallen == 0 else "all fall"
    return f"{fallen} of {COLUMNS} {'falls' if fallen == 1 else 'fall'}"


def _draw(axes: Axes, curve: Curve, style: LineStyle, label: str) -> None:
    axes.fill_between(curve.intensity, curve.low, curve.high, color=style["color"], alpha=0.12, linewidth=0)
    axes.plot(curve.intensity, curve.probability, label=label, **style)


def _plain_decades(axes: Axes) -> None:
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
