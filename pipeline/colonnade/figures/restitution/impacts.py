"""The coefficient of restitution of each impact against its speed: is e constant?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array, Mask
from colonnade.figures.panels.layout import BOTTOM, GAP, TOP, add_panel, legend_above, margins, note
from colonnade.figures.restitution.peaks import draw_marks
from colonnade.figures.style import FAINT, FIT, LIMIT, is_narrow, styled, width

HEIGHT = 2.4
"""Of the panels, inches."""

OVER_SPEED = 0.6
"""Share of the width of the panel over the speed of impact; the rest is over the impact number."""

MARKS = ("o", "s", "^", "D", "v", "P", "X", "<", ">")
"""Of several free vibrations; from the tenth on they are drawn as the first ones."""

SMALLEST_RANGE = 2e-3
"""No axis of e is narrower than this."""

BEST = 0.25
"""Share of the impacts, those with the smallest errors, whose bars find room on the axis in any case."""

SPREAD = 6.0
"""Robust standard deviations about the median that the axis of e shows; what tiny impacts scatter may leave it."""

MOST_BARS, AROUND = 60, 9
"""Impacts up to which each has its bar; of more the bars merge: a band has the median error of so many neighbours."""

MOST_NAMED = 3
"""Free vibrations up to which each is named in the legend."""


class ImpactSeries(NamedTuple):
    """
    Impacts of one free vibration: |ω| before (rad/s), e with its standard error, whether used; all of shape (n,).
    """

    title: str
    velocity: Array
    restitution: Array
    standard_error: Array
    used: Mask


class Level(NamedTuple):
    """A value of e with its interval, NaN where it has none."""

    value: float
    low: float
    high: float
    name: str


@styled()
def impact_restitution(series: Sequence[ImpactSeries], *, level: Level, rigid: float) -> Figure:
    """Draw e of each impact with its error over speed and number, the value identified with its band, and the rigid."""
    left, right = margins()
    figure = Figure(figsize=(width(), TOP + HEIGHT + BOTTOM))
    room = width() - left - right - 2 * GAP
    wide = OVER_SPEED * room
    axes = add_panel(figure, left, TOP, wide, HEIGHT)
    later = add_panel(figure, left + wide + 2 * GAP, TOP, room - wide, HEIGHT, sharey=axes)
    later.tick_params(labelleft=False)
    later.xaxis.set_major_locator(MaxNLocator(nbins=5, integer=True))
    draw_impacts([axes, later], series, level)
    later.set_xlabel("impact number n")
    draw_rigid(axes, rigid)
    legend_above(figure, [axes])
    return figure


def draw_impacts(panels: Sequence[Axes], series: Sequence[ImpactSeries], level: Level) -> None:
    """
    Draw e of the impacts of each free vibration over their speed and, in a second panel, over their number.

    Bars, or if they are many a band about the level, are ± two standard errors.
    """
    numbers = [np.arange(1.0, one.velocity.size + 1) for one in series]
    speeds = [one.velocity for one in series]
    fastest = max(float(np.nanmax(each, initial=0.0)) for each in speeds) or 1.0
    has_bars = sum(int(np.isfinite(one.restitution).sum()) for one in series) <= MOST_BARS / (1 + is_narrow())
    ends = (1.05 * fastest, max(each.size for each in numbers) + 1)
    for panel, places, end in zip(panels, (speeds, numbers), ends, strict=False):
        panel.set_xlim(0, end)
        if not has_bars:
            _draw_errors(panel, np.concatenate(places), series, level)
        for index, (one, place) in enumerate(zip(series, places, strict=True)):
            title = one.title if 1 < len(series) <= MOST_NAMED else "impact used"
            shown = np.isfinite(one.restitution) & np.isfinite(one.velocity)
            draw_marks(
                panel,
                place,
                one.restitution,
                2 * one.standard_error,
                shown,
                one.used,
                (title, "impact left out"),
                mark=MARKS[index % len(MARKS)],
                thickness=0.8 if has_bars else 0.0,
            )
        draw_level(panel, level)
    axes = panels[0]
    axes.set_ylim(*_limits(series, level))
    if not any(np.isfinite(one.restitution).any() for one in series):
        axes.text(0.5, 0.5, "no impacts", transform=axes.transAxes, ha="center", va="center")
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    axes.set_xlabel("speed of impact (rad/s)" if is_narrow() else "angular velocity before the impact (rad/s)")
    axes.set_ylabel("e of each impact")


def _draw_errors(axes: Axes, place: Array, series: Sequence[ImpactSeries], level: Level) -> None:
    """Draw where e of an impact is expected to lie if it is constant, by the errors of its neighbours."""
    error = np.concatenate([2 * one.standard_error for one in series])
    values = np.concatenate([one.restitution for one in series])
    seen = np.isfinite(error) & np.isfinite(values) & np.isfinite(np.concatenate([one.velocity for one in series]))
    if seen.sum() <= AROUND:
        return
    middle = level.value if np.isfinite(level.value) else float(np.median(values[seen]))
    order = np.flatnonzero(seen)[np.argsort(place[seen], kind="stable")]
    wide = np.median(np.lib.stride_tricks.sliding_window_view(error[order], AROUND), axis=1)
    wide = np.pad(wide, AROUND // 2, mode="edge")
    name = "± two standard errors of an impact"
    axes.fill_between(place[order], middle - wide, middle + wide, color=FAINT, alpha=0.3, linewidth=0, label=name)


def draw_level(axes: Axes, level: Level) -> None:
    """Draw a value of e, if it is known, over the whole panel, with its interval."""
    if not np.isfinite(level.value):
        return
    if np.isfinite(level.low) and np.isfinite(level.high):
        axes.axhspan(level.low, level.high, color=FIT["color"], alpha=0.18, linewidth=0, gid=f"{level.name}, interval")
    axes.axhline(level.value, label=level.name, **FIT)


def draw_rigid(axes: Axes, rigid: float) -> None:
    """Draw the rigid-body value if the axis reaches it, else write it at the edge."""
    low, high = axes.get_ylim()
    if low < rigid < high:
        axes.axhline(rigid, label="rigid body", **LIMIT)
        return
    above = rigid >= high
    at, side, arrow = ((0.995, 0.97), "top", "↑") if above else ((0.995, 0.03), "bottom", "↓")
    note(axes, f"rigid body {rigid:.4f} {arrow}", at, xycoords="axes fraction", ha="right", va=side)


def _limits(series: Sequence[ImpactSeries], level: Level) -> tuple[float, float]:
    """Return the range that shows nearly all impacts, and the interval of the level."""
    values = np.concatenate([one.restitution[np.isfinite(one.restitution)] for one in series])
    bounds = [value for value in level[:3] if np.isfinite(value)]
    if values.size:
        middle = float(np.median(values))
        spread = max(SPREAD * 1.4826 * float(np.median(np.abs(values - middle))), SMALLEST_RANGE / 2)
        errors = np.concatenate([one.standard_error[np.isfinite(one.restitution)] for one in series])
        bar = 2 * float(np.nan_to_num(np.nanquantile(errors, BEST))) if np.isfinite(errors).any() else 0.0
        bounds += [max(float(values.min()), middle - spread) - bar, min(float(values.max()), middle + spread) + bar]
    if not bounds:
        return 0.0, 1.0
    half = max(0.58 * (max(bounds) - min(bounds)), SMALLEST_RANGE / 2)
    middle = (max(bounds) + min(bounds)) / 2
    return middle - half, middle + half
