"""Many free vibrations in one panel: what all of them show, and the lines of a few; each is whole on its own page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.figures.panels.layout import legend_above, stacked_panels
from colonnade.figures.restitution.impacts import HEIGHT, ImpactSeries, Level, draw_level, draw_rigid
from colonnade.figures.restitution.peaks import PeakSeries, label_energies
from colonnade.figures.style import FAINT, MEASURED, styled
from colonnade.identification.restitution.peaks import released_energy
from colonnade.units.text import format_percent

LINES = 40
"""Records that have a line of their own, spread evenly over all."""

BINS = 24
"""Classes of the speed of impact."""

MIDDLE = (0.05, 0.5, 0.95)
"""Quantiles: the median, and the ends of the middle 90 %."""

MIDDLE_SHARE = format_percent(MIDDLE[-1] - MIDDLE[0])

FEWEST = 3
"""Values below which a class has no median."""


class Middle(NamedTuple):
    """Median of values by class, at its place, with the ends of their middle 90 %; all of shape (n,)."""

    place: Array
    low: Array
    median: Array
    high: Array


@styled()
def peaks_of_many(series: Sequence[PeakSeries], block: Block) -> Figure:
    """
    Draw the energy of successive peaks of many free vibrations against the impact number, in one panel.

    Parameters
    ----------
    series : sequence of PeakSeries
    block : Block
        Its critical angles scale the energy.

    Returns
    -------
    figure : Figure
        Median and middle 90 % over all records, and `LINES` records as lines.

    Raises
    ------
    ValueError
        If there is no series.
    """
    if not series:
        raise ValueError("no free vibration was given; at least one series of peaks was expected")
    figure, (axes,) = stacked_panels([HEIGHT])
    lines = [_energies(one, block) for one in series]
    number, energy = np.concatenate([line[0] for line in lines]), np.concatenate([line[1] for line in lines])
    _draw_few(axes, lines)
    _draw_middle(axes, middle_of(number, energy, np.arange(0.5, number.max(initial=1.0) + 1.0)))
    axes.set_yscale("log")
    if energy.size:
        axes.set(xlim=(0, number.max() + 1), ylim=(0.8 * energy.min(), 1.2 * energy.max()))
        label_energies(axes)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    axes.set(xlabel="impact number n", ylabel="energy / barrier")
    legend_above(figure, [axes])
    return figure


@styled()
def impacts_of_many(series: Sequence[ImpactSeries], *, level: Level | None, rigid: float | None) -> Figure:
    """
    Draw e of the impacts of many free vibrations against their speed: median and middle 90 % by class of speed.

    Parameters
    ----------
    series : sequence of ImpactSeries
        Their used impacts are drawn.
    level : Level or None
        The value taken as constant.
    rigid : float or None
        Rigid-body value.

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
    figure, (axes,) = stacked_panels([HEIGHT])
    velocity, restitution = (
        np.concatenate([getattr(one, name)[one.used] for one in series]) for name in ("velocity", "restitution")
    )
    known = np.isfinite(velocity) & np.isfinite(restitution)
    fastest = float(velocity[known].max(initial=0.0)) or 1.0
    middle = middle_of(velocity[known], restitution[known], np.linspace(0.0, fastest, BINS + 1))
    _draw_middle(axes, middle, joined=False)
    if level is not None and np.isfinite(level.value):
        draw_level(axes, level)
    axes.set_xlim(0, 1.05 * fastest)
    if middle.place.size:
        # Classes of the slowest impacts scatter without end: the others set the scale.
        wide = np.sort(middle.high - middle.low)[: -(-3 * middle.place.size // 4)].max()
        centre = float(np.median(middle.median))
        reach = max(2.0 * float(wide), 1.2 * float(np.ptp(middle.median)), 1e-3)
        axes.set_ylim(centre - reach, centre + reach)
    if rigid is not None:
        draw_rigid(axes, rigid)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    axes.set(xlabel="angular velocity before the impact (rad/s)", ylabel="e of each impact")
    legend_above(figure, [axes])
    return figure


def middle_of(place: Array, values: Array, edges: Array) -> Middle:
    """
    Return the median and the middle 90 % of values in each class of their places.

    Parameters
    ----------
    place, values : ndarray, shape (n,)
    edges : ndarray, shape (m + 1,)
        Of the classes, rising.

    Returns
    -------
    middle : Middle
        Of the classes with at least `FEWEST` values, at their centres.
    """
    owner = np.digitize(place, edges) - 1
    order = np.argsort(owner, kind="stable")
    parts = np.split(values[order], np.searchsorted(owner[order], np.arange(1, edges.size - 1)))
    chosen = [(index, np.quantile(part, MIDDLE)) for index, part in enumerate(parts) if part.size >= FEWEST]
    found = np.array([quantiles for _, quantiles in chosen]).reshape(-1, 3)
    index = np.array([index for index, _ in chosen], dtype=int)
    return Middle((edges[index] + edges[index + 1]) / 2, *found.T)


def _energies(peaks: PeakSeries, block: Block) -> tuple[Array, Array]:
    """Return number and energy of the peaks that were used."""
    critical = block.critical_angle_at(peaks.angle)
    shown = peaks.used & np.isfinite(peaks.angle) & (np.abs(peaks.angle) < critical) & (peaks.angle != 0)
    number = 1.0 + np.flatnonzero(shown).astype(np.float64)
    return number, np.asarray(released_energy(np.abs(peaks.angle[shown]), critical[shown]))


def _draw_few(axes: Axes, lines: Sequence[tuple[Array, Array]]) -> None:
    known = [line for line in lines if line[0].size > 1]
    chosen = np.unique(np.linspace(0, max(len(known) - 1, 0), min(LINES, len(known))).round().astype(int)).tolist()
    name = f"{len(chosen)} of {len(lines)} records" if len(chosen) < len(lines) else "each record"
    axes.add_collection(
        LineCollection(
            [np.column_stack(known[index]) for index in chosen], colors=FAINT, linewidths=0.4, alpha=0.6, label=name
        )
    )


def _draw_middle(axes: Axes, middle: Middle, *, joined: bool = True) -> None:
    colour = MEASURED["color"]
    if joined:
        axes.fill_between(
            middle.place,
            middle.low,
            middle.high,
            color=colour,
            alpha=0.15,
            linewidth=0,
            label=f"middle {MIDDLE_SHARE} of all",
        )
        axes.plot(middle.place, middle.median, color=colour, linewidth=1.2, label="median of all")
        return
    axes.errorbar(
        middle.place,
        middle.median,
        yerr=[middle.median - middle.low, middle.high - middle.median],
        fmt="o",
        markersize=3.0,
        color=colour,
        ecolor=FAINT,
        elinewidth=0.8,
        label=f"median of a class of speed, and its middle {MIDDLE_SHARE}",
    )
