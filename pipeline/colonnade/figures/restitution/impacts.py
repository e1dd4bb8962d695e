"""The coefficient of restitution of each impact against its speed: is e constant?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.figures.panels.layout import BOTTOM, GAP, TOP, add_panel, legend_above, margins
from colonnade.figures.restitution.peaks import draw_marks
from colonnade.figures.style import FAINT, FIT, INK, LIMIT, is_narrow, styled, width

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
    used: NDArray[np.bool_]


class Level(NamedTuple):
    """A value of e with its interval, NaN where it has none."""

    value: float
    low: float
    high: float
    name: str


@styled()
def impact_restitution(
    series: Sequence[ImpactSeries],
    *,
    level: Level | None = None,
    rigid: float | None = None,
    axes: Axes | None = None,
) -> Figure:
    """
    Draw e of each impact with its error over speed and number, and the value identified with its band.

    Parameters
    ----------
    series : sequence of ImpactSeries
        One a free vibration; bars, or if they are many a band about the level, are ± two standard errors.
    level : Level, optional
        The value if e is constant.
    rigid : float, optional
        Rigid-body value, drawn if the axis reaches it, else written at its edge.
    axes : Axes, optional
        To draw into; a new figure with its legend otherwise.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no series.
    """
    if not series:
        raise ValueError("no free vibration was given; at least one series of impacts was expected")
    own = axes is None
    later = None
    if axes is None:
        axes, later = _panels()
    figure = cast(Figure, axes.get_figure(root=True))
    fastest = max((float(np.nanmax(one.velocity, initial=0.0)) for one in series), default=0.0) or 1.0
    axes.set_xlim(0, 1.05 * fastest)
    if later is not None:
        later.set_xlim(0, max(one.velocity.size for one in series) + 1)
    has_bars = sum(int(np.isfinite(one.restitution).sum()) for one in series) <= MOST_BARS / (1 + is_narrow())
    if not has_bars:
        _draw_errors(axes, later, series, level)
    for index, one in enumerate(series):
        mark, named = MARKS[index % len(MARKS)], 1 < len(series) <= MOST_NAMED
        _draw_impacts(axes, one, one.velocity, mark, named=named, has_bars=has_bars)
        if later is not None:
            numbers = np.arange(1.0, one.velocity.size + 1)
            _draw_impacts(later, one, numbers, mark, named=named, has_bars=has_bars)
    if level is not None and np.isfinite(level.value):
        for panel in filter(None, (axes, later)):
            draw_level(panel, level)
    axes.set_ylim(*_limits(series, level))
    if rigid is not None:
        draw_rigid(axes, rigid)
    if not any(np.isfinite(one.restitution).any() for one in series):
        axes.text(0.5, 0.5, "no impacts", transform=axes.transAxes, ha="center", va="center")
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    axes.set_xlabel("speed of impact (rad/s)" if is_narrow() else "angular velocity before the impact (rad/s)")
    axes.set_ylabel("e of each impact")
    if own:
        legend_above(figure, [axes])
    return figure


def _panels() -> tuple[Axes, Axes]:
    """Return a panel over the speed of impact, and a narrower one over the impact number at the same height."""
    left, right = margins()
    figure = Figure(figsize=(width(), TOP + HEIGHT + BOTTOM))
    room = width() - left - right - 2 * GAP
    wide = OVER_SPEED * room
    axes = add_panel(figure, left, TOP, wide, HEIGHT)
    later = add_panel(figure, left + wide + 2 * GAP, TOP, room - wide, HEIGHT, sharey=axes)
    later.tick_params(labelleft=False)
    later.xaxis.set_major_locator(MaxNLocator(nbins=5, integer=True))
    later.set_xlabel("impact number n")
    return axes, later


def _draw_errors(axes: Axes, later: Axes | None, series: Sequence[ImpactSeries], level: Level | None) -> None:
    """Draw where e of an impact is expected to lie if it is constant, by the errors of its neighbours."""
    error = np.concatenate([2 * one.standard_error for one in series])
    values = np.concatenate([one.restitution for one in series])
    speeds = np.concatenate([one.velocity for one in series])
    numbers = np.concatenate([np.arange(1.0, one.velocity.size + 1) for one in series])
    seen = np.isfinite(error) & np.isfinite(values) & np.isfinite(speeds)
    middle = float(np.median(values[seen])) if level is None or not np.isfinite(level.value) else level.value
    for panel, place in ((axes, speeds), (later, numbers)):
        if panel is not None and seen.sum() > AROUND:
            order = np.flatnonzero(seen)[np.argsort(place[seen], kind="stable")]
            wide = np.median(np.lib.stride_tricks.sliding_window_view(error[order], AROUND), axis=1)
            wide = np.pad(wide, AROUND // 2, mode="edge")
            name = "± two standard errors of an impact"
            panel.fill_between(
                place[order], middle - wide, middle + wide, color=FAINT, alpha=0.3, linewidth=0, label=name
            )


def _draw_impacts(axes: Axes, impacts: ImpactSeries, place: Array, mark: str, *, named: bool, has_bars: bool) -> None:
    shown = np.isfinite(impacts.restitution) & np.isfinite(impacts.velocity)
    labels = (impacts.title if named else "impact used", "impact left out")
    bars = 2 * impacts.standard_error
    draw_marks(
        axes,
        place,
        impacts.restitution,
        bars,
        shown,
        impacts.used,
        labels,
        mark=mark,
        thickness=0.8 if has_bars else 0.0,
    )


def draw_level(axes: Axes, level: Level) -> None:
    """Draw a value of e over the whole panel, with its interval."""
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
    axes.annotate(
        f"rigid body {rigid:.4f} {'↑' if above else '↓'}",
        (0.995, 0.97 if above else 0.03),
        xycoords="axes fraction",
        ha="right",
        va="top" if above else "bottom",
        fontsize=8,
        color=INK,
    )


def _limits(series: Sequence[ImpactSeries], level: Level | None) -> tuple[float, float]:
    """Return the range that shows nearly all impacts, and the interval of the level."""
    values = np.concatenate([one.restitution[np.isfinite(one.restitution)] for one in series])
    bounds = [] if level is None else [value for value in level[:3] if np.isfinite(value)]
    if values.size:
        middle = float(np.median(values))
        spread = SPREAD * 1.4826 * float(np.median(np.abs(values - middle)))
        spread = max(spread, SMALLEST_RANGE / 2)
        errors = np.concatenate([one.standard_error[np.isfinite(one.restitution)] for one in series])
        bar = 2 * float(np.nan_to_num(np.nanquantile(errors, BEST))) if np.isfinite(errors).any() else 0.0
        bounds += [max(float(values.min()), middle - spread) - bar, min(float(values.max()), middle + spread) + bar]
    if not bounds:
        return 0.0, 1.0
    half = max(0.58 * (max(bounds) - min(bounds)), SMALLEST_RANGE / 2)
    middle = (max(bounds) + min(bounds)) / 2
    return middle - half, middle + half
