"""The overturning spectrum of a pulse and the rocking spectrum of a motion."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.dynamics.pulses import OverturningSpectrum
from colonnade.dynamics.spectra import RockingSpectrum
from colonnade.figures.maps.stability_map import (
    LOGARITHMIC,
    OVERTURNED_COLOUR,
    draw_limits,
    label_logarithmic,
    name_axes,
    words_of_restitution,
)
from colonnade.figures.panels.layout import caption, legend_outside
from colonnade.figures.style import LIMIT, SOFT, LineStyle, blank_figure, styled


@styled()
def overturning_spectrum(spectrum: OverturningSpectrum) -> Figure:
    """Draw an overturning spectrum with its legend, and what the limits depend on."""
    figure = blank_figure(3.8)
    axes = figure.subplots()
    draw_overturning(axes, spectrum)
    caption(axes, _words_of(spectrum))
    legend_outside(figure, [axes], below=True)
    return figure


def draw_overturning(axes: Axes, spectrum: OverturningSpectrum) -> None:
    """Shade every amplitude that overturns, islands too, and draw both limits; an absent limit breaks its line."""
    ratios, largest = spectrum.frequency_ratio, spectrum.options["largest"]
    half = 0.5 * np.diff(ratios, prepend=ratios[:1], append=ratios[-1:])
    starts, ends, places = spectrum.interval_start, spectrum.interval_end, spectrum.interval_frequency_ratio
    own = np.searchsorted(ratios, places)
    axes.bar(
        places - half[own],
        ends - starts,
        half[own] + half[own + 1],
        starts,
        align="edge",
        color=OVERTURNED_COLOUR,
        linewidth=0.0,
        label="overturns",
        zorder=0,
    )
    edges, name = np.concatenate([starts, ends]), "edges of the intervals that overturn"
    axes.plot(np.tile(places, 2), edges, ".", markersize=1.2, color=SOFT, zorder=1, gid=name)
    draw_limits(axes, spectrum, spectrum.model)
    axes.grid(False)
    axes.set_xlim(float(ratios.min()), float(ratios.max()))
    lowest = float(starts.min(initial=1.0))
    if largest / lowest > LOGARITHMIC:
        label_logarithmic(axes)
    axes.set_ylim(0.8 * lowest, largest)
    name_axes(axes)


def _words_of(spectrum: OverturningSpectrum) -> str:
    options = spectrum.options
    shape = f", γ = {options['cycles']:g}, ν = {options['phase']:.3g} rad" if "cycles" in options else ""
    wide = f"limits at least {options['width']:.2g} wide"
    return f"{spectrum.pulse}{shape}; {spectrum.model} model; {words_of_restitution(options)}; {wide}"


CURVES: tuple[LineStyle, ...] = (
    {"color": "#0b6bb0", "linestyle": "-", "linewidth": 1.4},
    {"color": "#d1490f", "linestyle": (0, (5.0, 1.5)), "linewidth": 1.4},
    {"color": "#8a3fa8", "linestyle": (0, (1.5, 1.2)), "linewidth": 1.4},
    {"color": "#3d6b35", "linestyle": (0, (5.0, 1.2, 1.2, 1.2)), "linewidth": 1.4},
)
"""Of one slenderness after the other; they begin again after the last."""

STEP = 0.045
"""Distance of the rows of overturned blocks above each other, in |θ|/α."""


@styled()
def rocking_spectrum(spectrum: RockingSpectrum, *, period: float, title: str) -> Figure:
    """Draw a rocking spectrum with its title and legend; `period` is the 2π/p (s) of a column that is marked."""
    figure = blank_figure(3.4)
    axes = figure.subplots()
    draw_rocking(axes, spectrum, period)
    caption(axes, title)
    legend_outside(figure, [axes], below=True)
    return figure


def draw_rocking(axes: Axes, spectrum: RockingSpectrum, period: float | None = None) -> None:
    """Draw largest angles over size; blocks that overturn have none: the curve breaks, and crosses above show them."""
    highest = float(np.nanmax(spectrum.peak_ratio, initial=0.0))
    top = max(1.0, 1.05 * highest) + 2 * STEP
    for number, (angle, peak, fell) in enumerate(
        zip(spectrum.critical_angle, spectrum.peak_ratio, spectrum.overturned, strict=True)
    ):
        style, name = CURVES[number % len(CURVES)], f"α = {angle:.4g} rad"
        # With dots: a single size that stands between others that overturn has no line.
        axes.plot(spectrum.period, peak, label=name, zorder=3, marker=".", markersize=3.0, **style)
        if fell.any():
            row, colour = np.full(int(fell.sum()), top + number * STEP), style["color"]
            named = f"{name}: overturned"
            axes.plot(spectrum.period[fell], row, "x", markersize=3.5, color=colour, label=named, zorder=3)
    if period is not None:
        axes.axvline(period, label=f"the column, 2π/p = {period:.3g} s", zorder=1, **LIMIT)
    axes.axhline(1.0, color=SOFT, linewidth=0.6, zorder=1, gid="critical angle")
    axes.set_xlim(float(spectrum.period.min()), float(spectrum.period.max()))
    axes.set_ylim(0.0, top + max(1, len(spectrum.critical_angle)) * STEP)
    axes.set(xlabel="size 2π/p (s)", ylabel="largest |θ|/α")
