"""How probably a real column overturns: curves over a measure of intensity, and twenty columns at a few levels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from colonnade.arrays import Array
from colonnade.figures.panels.layout import legend_outside, plain_decades
from colonnade.figures.style import FAINT, FIT, INK, LIMIT, MEASURED, SOFT, LineStyle, one_panel, styled

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
def fragility(lognormal: Curve | None, isotonic: Curve, *, label: str, taken: str, shares: Array | None) -> Figure:
    """
    Draw the probability of overturning over a measure of intensity.

    `label` is that of the measure with its unit, `taken` the curve from which the answer is read ("lognormal" or
    "isotonic"), `shares` are those of the histories that overturn at the levels of `isotonic`.
    """
    figure, axes = one_panel(3.4)
    draw_fragility(axes, lognormal, isotonic, label=label, taken=taken)
    if shares is not None:
        name = "share at a level"
        axes.plot(isotonic.intensity, shares, "o", markersize=4, color=INK, markerfacecolor="white", label=name)
    legend_outside(figure, [axes])
    return figure


def draw_fragility(axes: Axes, lognormal: Curve | None, isotonic: Curve, *, label: str, taken: str) -> None:
    """Draw both curves, the one that is taken thicker, with their intervals."""
    steps: LineStyle = {**MEASURED, "linestyle": (0, (4.0, 1.5))}
    drawn = [("isotonic", isotonic, "curve that only rises", steps), ("lognormal", lognormal, "lognormal curve", FIT)]
    for kind, curve, name, style in drawn:
        if curve is not None:
            look: LineStyle = {**style, "linewidth": 1.6 if kind == taken else 0.9}
            axes.fill_between(curve.intensity, curve.low, curve.high, color=style["color"], alpha=0.12, linewidth=0)
            axes.plot(curve.intensity, curve.probability, label=name, **look)
    for share in (0.05, 0.5):
        axes.axhline(share, **LIMIT)
    axes.set(xscale="log", ylim=(-0.02, 1.02), xlabel=label, ylabel="probability of overturning")
    axes.set_yticks([0, 0.05, 0.25, 0.5, 0.75, 1.0], ["0", "5 %", "25 %", "50 %", "75 %", "100 %"])
    plain_decades(axes.xaxis)


@styled()
def twenty_columns(levels: Sequence[str], probability: Array) -> Figure:
    """Draw, for levels with their units, how many of twenty columns fall at these probabilities of overturning."""
    figure, axes = one_panel(0.42 * len(levels) + 0.35)
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
def response_spectra(period: Array, acceleration: Array) -> Figure:
    """Draw spectra of ground motions (g; a row each) over period (s) as recorded, with their median."""
    figure, axes = one_panel(2.8)
    lines = axes.plot(period, acceleration.T, color=FAINT, linewidth=0.6)
    lines[0].set_label("a ground motion")
    axes.plot(period, np.median(acceleration, axis=0), color=INK, linewidth=1.6, label="median")
    axes.set(xscale="log", yscale="log", xlabel="period (s)", ylabel="pseudo-acceleration (g)")
    plain_decades(axes.xaxis)
    plain_decades(axes.yaxis, subs=(1.0,))
    legend_outside(figure, [axes])
    return figure


def _falls(fallen: int) -> str:
    if fallen in (0, COLUMNS):
        return "hardly any falls" if fallen == 0 else "all fall"
    return f"{fallen} of {COLUMNS} {'falls' if fallen == 1 else 'fall'}"
