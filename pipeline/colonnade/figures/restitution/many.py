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
    """Draw the energy of peaks against the impact number: median and middle 90 % of all, and lines of some records."""
    figure, (axes,) = stacked_panels([HEIGHT])
    lines = [_energies(one, block) for one in series]
    number, energy = (np.concatenate(each) for each in zip(*lines, strict=True))
    _draw_few(axes, lines)
    middle = middle_of(number, energy, np.arange(0.5, number.max(initial=1.0) + 1.0))
    colour, name = MEASURED["color"], f"middle {MIDDLE_SHARE} of all"
    axes.fill_between(middle.place, middle.low, middle.high, color=colour, alpha=0.15, linewidth=0, label=name)
    axes.plot(middle.place, middle.median, color=colour, linewidth=1.2, label="median of all")
    axes.set_yscale("log")
    if energy.size:
        axes.set(xlim=(0, number.max() + 1), ylim=(0.8 * energy.min(), 1.2 * energy.max()))
        label_energies(axes)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    axes.set(xlabel="impact number n", ylabel="energy / barrier")
    legend_above(figure, [axes])
    return figure


@styled()
def impacts_of_many(series: Sequence[ImpactSeries], *, level: Level, rigid: float) -> Figure:
    """Draw e of the used impacts against their speed: median and middle 90 % by class of speed."""
    figure, (axes,) = stacked_panels([HEIGHT])
    velocity, restitution = (
        np.concatenate([getattr(one, name)[one.used] for one in series]) for name in ("velocity", "restitution")
    )
    known = np.isfinite(velocity) & np.isfinite(restitution)
    fastest = float(velocity[known].max(initial=0.0)) or 1.0
    middle = middle_of(velocity[known], restitution[known], np.linspace(0.0, fastest, BINS + 1))
    axes.errorbar(
        middle.place,
        middle.median,
        yerr=[middle.median - middle.low, middle.high - middle.median],
        fmt="o",
        markersize=3.0,
        color=MEASURED["color"],
        ecolor=FAINT,
        elinewidth=0.8,
        label=f"median of a class of speed, and its middle {MIDDLE_SHARE}",
    )
    draw_level(axes, level)
    axes.set_xlim(0, 1.05 * fastest)
    if middle.place.size:
        # Classes of the slowest impacts scatter without end: the others set the scale.
        wide = np.sort(middle.high - middle.low)[: -(-3 * middle.place.size // 4)].max()
        centre = float(np.median(middle.median))
        reach = max(2.0 * float(wide), 1.2 * float(np.ptp(middle.median)), 1e-3)
        axes.set_ylim(centre - reach, centre + reach)
    draw_rigid(axes, rigid)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    axes.set(xlabel="angular velocity before the impact (rad/s)", ylabel="e of each impact")
    legend_above(figure, [axes])
    return figure


def middle_of(place: Array, values: Array, edges: Array) -> Middle:
    """Return median and middle 90 % of values by class of their places, where it has at least `FEWEST` values."""
    owner = np.clip(np.digitize(place, edges) - 1, 0, edges.size - 2)
    chosen = [index for index in range(edges.size - 1) if (owner == index).sum() >= FEWEST]
    found = np.array([np.quantile(values[owner == index], MIDDLE) for index in chosen]).reshape(-1, 3)
    return Middle(((edges[:-1] + edges[1:]) / 2)[chosen], *found.T)


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
    paths = [np.column_stack(known[index]) for index in chosen]
    axes.add_collection(LineCollection(paths, colors=FAINT, linewidths=0.4, alpha=0.6, label=name))
