"""Peaks and impacts of free vibrations: is Housner's relation a straight line, and e the same at every speed?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.errors import count
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.layout import (
    BOTTOM,
    GAP,
    TOP,
    add_panel,
    legend_above,
    legend_outside,
    margins,
    note,
    plain_decades,
)
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import FAINT, FIT, LIMIT, MEASURED, SOFT, blank_figure, is_narrow, shortened, styled, width
from colonnade.identification.restitution.peaks import released_energy
from colonnade.store.records.stored import Stored
from colonnade.units.text import interval, number

STAGE = "restitution"

LONGEST_NAME = 26
"""Letters of a test's name above a panel."""


class EstimateRow(NamedTuple):
    """A value of e, by what it is from, with its interval, NaN if it is not known; whether and why it is given."""

    name: str
    value: float
    low: float
    high: float
    recommended: bool = False
    reason: str = ""

    @property
    def text(self) -> str:
        """Its e with its interval."""
        return interval(self.value, self.low, self.high)


def draw_marks(
    axes: Axes,
    x: Array,
    y: Array,
    bars: Array,
    shown: Mask,
    used: Mask,
    labels: tuple[str, str],
    *,
    mark: str = "o",
    size: float = 3.0,
    thickness: float = 0.8,
) -> None:
    """
    Draw marks with their bars, hollow those that were left out.

    `bars` are the lengths below and above, none where NaN; `labels` those of what was used and of what was left out.
    With a `thickness` of 0 the bars are in the figure's table alone.
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
                elinewidth=thickness,
                label=label,
            )


COLUMNS = 3
"""Of tests side by side."""

BELOW = 0.5
"""The energy axis ends at this share of that of the lowest peak that stands two standard errors above zero."""


class PeakSeries(NamedTuple):
    """
    Peaks of one free vibration, all of shape (n,).

    Attributes
    ----------
    title : str
    angle, standard_error, fitted_angle : ndarray
        rad.
    used : ndarray of bool
    """

    title: str
    angle: Array
    standard_error: Array
    fitted_angle: Array
    used: Mask


@styled()
def peak_decay(series: Sequence[PeakSeries], block: Block) -> Figure:
    """
    Draw the energy of successive peaks against the impact number, a panel a test, all on the same scales.

    The energy is the share of the overturning barrier that a peak holds (`released_energy`): each impact multiplies it
    by e², so that on a logarithmic axis a constant e is a straight line. Bars are ± two standard errors.
    """
    columns = min(len(series), COLUMNS)
    rows = -(-len(series) // columns)
    figure = blank_figure(0.7 + 2.1 * rows)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for unused in grid.flat[len(series) :]:
        unused.remove()
    axes = list(grid.flat[: len(series)])
    for index, (one, peaks) in enumerate(zip(axes, series, strict=True)):
        # The lowest panel of each column carries the scale, also where the last row is not full.
        one.tick_params(labelbottom=index + columns >= len(series))
        one.set_xlabel("impact number n" if index + columns >= len(series) else "")
        one.set_ylabel("energy / barrier" if index % columns == 0 else "")
        _draw_peaks(one, peaks, block)
    lowest = min((_lowest(peaks, block) for peaks in series), default=1.0)
    for one in axes:
        if lowest < 1.0:
            one.set_ylim(bottom=max(one.get_ylim()[0], lowest))
        # 1, 2 and 5 of each decade where few are shown, so that at least two labels stand at any scale.
        low, high = one.get_ylim()
        plain_decades(one.yaxis, subs=(1.0, 2.0, 5.0) if high < 1e3 * low else (1.0,))
    legend_outside(figure, axes)
    return figure


def _draw_peaks(axes: Axes, peaks: PeakSeries, block: Block) -> None:
    number = np.arange(1.0, peaks.angle.size + 1)
    critical = block.critical_angle_at(peaks.angle)
    shown = np.isfinite(peaks.angle) & (np.abs(peaks.angle) < critical) & (peaks.angle != 0)
    size = np.clip(np.abs(peaks.angle), 0.0, critical)
    low = np.clip(size - 2 * peaks.standard_error, 1e-3 * size, critical)
    high = np.clip(size + 2 * peaks.standard_error, 0.0, critical)
    energy, lowest, highest = (released_energy(angle, critical) for angle in (size, low, high))
    bars = np.array([energy - lowest, highest - energy])
    draw_marks(axes, number, energy, bars, shown, peaks.used, ("peak used", "peak left out"), size=2.8)
    fitted = np.isfinite(peaks.fitted_angle)
    if fitted.any():
        line = released_energy(np.abs(peaks.fitted_angle[fitted]), critical[fitted])
        axes.plot(number[fitted], line, label="fit", zorder=3, **FIT)
    axes.set(yscale="log", xlim=(0, max(peaks.angle.size + 1, axes.get_xlim()[1])), title=peaks.title)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=5, integer=True))
    if not shown.any():
        axes.text(0.5, 0.5, "no peaks", transform=axes.transAxes, ha="center", va="center")


def _lowest(peaks: PeakSeries, block: Block) -> float:
    """Energy below which a scale shows nothing but the bars of peaks near the noise."""
    size = np.abs(peaks.angle)
    critical = block.critical_angle_at(peaks.angle)
    known = np.isfinite(size) & (size < critical) & (size > 2 * np.nan_to_num(peaks.standard_error))
    return BELOW * float(released_energy(size[known], critical[known]).min()) if known.any() else 1.0


def peak_series(one: OfTest) -> PeakSeries | None:
    """Return the peaks of a free vibration, None if none were found."""
    angle, error, fit, used = _columns(one, "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
    if not angle.size:
        return None
    return PeakSeries(shortened(one.test.id, LONGEST_NAME), angle, error, fit, used == 1)


def peaks(identity: str, series: Sequence[PeakSeries], block: Block, note: str = "") -> Picture | None:
    """Draw the peaks of free vibrations with their fits; None without any."""
    if not series:
        return None
    described = [f"{one.title}: {int(one.used.sum())} of {count(one.used.size, 'peak')} used." for one in series]
    title = "Energy of successive peaks against the impact number, with the fitted line"
    return Picture(peak_decay(series, block), identity, title, " ".join(described), note)


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


@styled()
def impact_restitution(series: Sequence[ImpactSeries], *, level: EstimateRow, rigid: float) -> Figure:
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


def draw_impacts(panels: Sequence[Axes], series: Sequence[ImpactSeries], level: EstimateRow) -> None:
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


def _draw_errors(axes: Axes, place: Array, series: Sequence[ImpactSeries], level: EstimateRow) -> None:
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


def draw_level(axes: Axes, level: EstimateRow) -> None:
    """Draw a value of e, if it is known, over the whole panel, with its interval."""
    if not np.isfinite(level.value):
        return
    if np.isfinite(level.low) and np.isfinite(level.high):
        axes.axhspan(level.low, level.high, color=FIT["color"], alpha=0.18, linewidth=0, gid=f"{level.name}, interval")
    axes.axhline(level.value, label=level.name, **FIT)


def draw_rigid(axes: Axes, rigid: float, *, is_across: bool = False) -> None:
    """Draw the rigid-body value if the axis of e reaches it, else write it at the edge that is nearer."""
    low, high = axes.get_xlim() if is_across else axes.get_ylim()
    share, told = float(np.clip((rigid - low) / (high - low), 0.0, 1.0)), f" rigid body {rigid:.4f} "
    if 0 < share < 1:
        (axes.axvline if is_across else axes.axhline)(rigid, label="rigid body", **LIMIT)
        if not is_across:  # its name is in the legend: beside the line are points
            return
    else:
        told = f"{'←' if is_across else '↓'}{told}" if share == 0 else f"{told}{'→' if is_across else '↑'}"
    place = (share, 0.0) if is_across else (0.995, share)
    side = "left" if is_across and share < 0.5 else "right"
    height, shift = ("bottom", 3) if is_across or share < 0.5 else ("top", -3)
    note(axes, told, place, (0, shift), xycoords="axes fraction", ha=side, va=height, color=SOFT)


def _limits(series: Sequence[ImpactSeries], level: EstimateRow) -> tuple[float, float]:
    """Return the range that shows nearly all impacts, and the interval of the level."""
    values = np.concatenate([one.restitution[np.isfinite(one.restitution)] for one in series])
    bounds = [value for value in (level.value, level.low, level.high) if np.isfinite(value)]
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


def impact_series(one: OfTest) -> ImpactSeries | None:
    """Return e of each impact of a free vibration, or None without impacts."""
    names = ("velocity", "restitution", "restitution_standard_error", "used")
    velocity, restitution, error, used = _columns(one, *(f"impact_{name}" for name in names))
    if not restitution.size:
        return None
    return ImpactSeries(shortened(one.test.id, LONGEST_NAME), velocity, restitution, error, used == 1)


def impacts(
    identity: str, series: Sequence[ImpactSeries], level: EstimateRow, rigid: float, note: str = ""
) -> Picture | None:
    """Draw e of each impact against its speed, with the value and interval identified from all; None without any."""
    if not series:
        return None
    used, total = sum(int(one.used.sum()) for one in series), sum(one.used.size for one in series)
    return Picture(
        impact_restitution(series, level=level, rigid=rigid),
        identity,
        "e of each impact against the angular velocity before it",
        f"{used} of {count(total, 'impact')} used. {level.name}: {number(level.value, 4)}.",
        note,
    )


def level_of(stored: Stored, stage: str, name: str) -> EstimateRow:
    """Return the e that a stage identified, with its interval, as a figure shows it; NaN if it is not known."""
    value, low, high = (stored.value(stage, f"restitution{end}") for end in ("", "_low", "_high"))
    return EstimateRow(name, value, low, high)


def _columns(one: OfTest, *names: str) -> list[Array]:
    return [one.stored.array(STAGE, name) for name in names]
