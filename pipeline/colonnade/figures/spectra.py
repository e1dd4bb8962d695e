"""The overturning spectrum of a pulse and the rocking spectrum of a motion."""

from __future__ import annotations

from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.dynamics.pulses import OverturningSpectrum
from colonnade.dynamics.spectra import RockingSpectrum
from colonnade.figures.maps.measured_map import LOGARITHMIC, label_logarithmic, name_axes
from colonnade.figures.maps.stability_map import OVERTURNED_COLOUR, words_of_restitution
from colonnade.figures.style import LIMIT, SMALL_TEXT, SOFT, LineStyle, blank_figure, is_narrow, model_style, styled


@styled()
def overturning_spectrum(spectrum: OverturningSpectrum, *, title: str = "", axes: Axes | None = None) -> Figure:
    """
    Draw an overturning spectrum.

    Parameters
    ----------
    spectrum : OverturningSpectrum
        Of two frequencies at least.
    title : str, optional
        By default the pulse and what the limits depend on.
    axes : Axes, optional
        To draw into; a new figure with its title and legend otherwise.

    Returns
    -------
    figure : Figure

    Notes
    -----
    Every amplitude that overturns is shaded, islands too. The lower limit is the full line, the upper one the thin
    one; where a limit is absent up to the largest A its line breaks.
    """
    own = axes is None
    if axes is None:
        axes = blank_figure(3.8).subplots()
    ratios, largest = spectrum.frequency_ratio, spectrum.options["largest"]
    half = 0.5 * np.diff(ratios, prepend=ratios[:1], append=ratios[-1:])
    left, right = dict(zip(ratios, half[:-1], strict=True)), dict(zip(ratios, half[1:], strict=True))
    starts, ends, places = spectrum.interval_start, spectrum.interval_end, spectrum.interval_frequency_ratio
    axes.bar(
        [place - left[place] for place in places],
        ends - starts,
        [left[place] + right[place] for place in places],
        starts,
        align="edge",
        color=OVERTURNED_COLOUR,
        linewidth=0.0,
        label="overturns",
        zorder=0,
    )
    axes.plot(
        np.tile(places, 2),
        np.concatenate([starts, ends]),
        linestyle="none",
        marker=".",
        markersize=1.2,
        color=SOFT,
        zorder=1,
        gid="edges of the intervals that overturn",
    )
    style = model_style(spectrum.model)
    axes.plot(ratios, spectrum.lower, label="lower limit", zorder=3, **style | {"linewidth": 1.6})
    axes.plot(ratios, spectrum.upper, label="upper limit", zorder=3, **style | {"linewidth": 0.8})
    axes.grid(False)
    axes.set_xlim(float(ratios.min()), float(ratios.max()))
    lowest = float(starts.min(initial=1.0))
    if largest / lowest > LOGARITHMIC:
        label_logarithmic(axes)
    axes.set_ylim(0.8 * lowest, largest)
    name_axes(axes)
    figure = cast(Figure, axes.get_figure(root=True))
    if own:
        small = SMALL_TEXT["legend.fontsize"] if is_narrow() else 8
        axes.set_title(title or words_of(spectrum), fontsize=small, color=SOFT)
        figure.legend(loc="outside lower center", ncols=3, fontsize=small)
    return figure


def words_of(spectrum: OverturningSpectrum) -> str:
    """Return in words what the limits depend on."""
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
def rocking_spectrum(
    spectrum: RockingSpectrum, *, period: float | None = None, title: str = "", axes: Axes | None = None
) -> Figure:
    """
    Draw a rocking spectrum.

    Parameters
    ----------
    spectrum : RockingSpectrum
    period : float, optional
        2π/p of a column, s, that is marked.
    title : str, optional
    axes : Axes, optional
        To draw into; a new figure with its title and legend otherwise.

    Returns
    -------
    figure : Figure

    Notes
    -----
    Blocks that overturn have no largest angle: the curve breaks there, and crosses above show them.
    """
    own = axes is None
    if axes is None:
        axes = blank_figure(3.4).subplots()
    highest = float(np.nanmax(spectrum.peak_ratio, initial=0.0))
    top = max(1.0, 1.05 * highest) + 2 * STEP
    for number, (angle, peak, fell) in enumerate(
        zip(spectrum.critical_angle, spectrum.peak_ratio, spectrum.overturned, strict=True)
    ):
        style, name = CURVES[number % len(CURVES)], f"α = {angle:.4g} rad"
        # With dots: a single size that stands between others that overturn has no line.
        axes.plot(spectrum.period, peak, label=name, zorder=3, marker=".", markersize=3.0, **style)
        if fell.any():
            axes.plot(
                spectrum.period[fell],
                np.full(int(fell.sum()), top + number * STEP),
                linestyle="none",
                marker="x",
                markersize=3.5,
                color=style["color"],
                label=f"{name}: overturned",
                zorder=3,
            )
    if period is not None:
        axes.axvline(period, label=f"the column, 2π/p = {period:.3g} s", zorder=1, **LIMIT)
    axes.axhline(1.0, color=SOFT, linewidth=0.6, zorder=1, gid="critical angle")
    axes.set_xlim(float(spectrum.period.min()), float(spectrum.period.max()))
    axes.set_ylim(0.0, top + max(1, len(spectrum.critical_angle)) * STEP)
    axes.set(xlabel="size 2π/p (s)", ylabel="largest |θ|/α")
    figure = cast(Figure, axes.get_figure(root=True))
    if own:
        small = SMALL_TEXT["legend.fontsize"] if is_narrow() else 8
        axes.set_title(title, fontsize=small, color=SOFT)
        figure.legend(loc="outside lower center", ncols=2 if is_narrow() else 3, fontsize=small)
    return figure
