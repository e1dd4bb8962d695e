"""Peaks of free vibrations with the fit that gives the restitution: Housner's relation is a straight line here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.figures.panels.curve import draw_band
from colonnade.figures.panels.layout import legend_outside, plain_decades
from colonnade.figures.style import FAINT, FIT, MEASURED, blank_figure, styled
from colonnade.identification.restitution.peaks import released_energy
from colonnade.units.text import PERCENT


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
    band : ndarray, optional
        Half-width of the band of confidence about the fitted line, of ln energy (`confidence_band`).
    """

    title: str
    angle: Array
    standard_error: Array
    fitted_angle: Array
    used: Mask
    band: Array | None = None


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
        if peaks.band is not None and np.isfinite(peaks.band[fitted]).any():
            wide = np.exp(peaks.band[fitted])
            name = f"95{PERCENT} band"
            draw_band(axes, number[fitted], line / wide, line * wide, color=FIT["color"], alpha=0.18, label=name)
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
