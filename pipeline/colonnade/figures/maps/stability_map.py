"""Maps and spectra: sine tests by outcome with bracketed boundaries, computed regions and limits, rocking spectra."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from colonnade.arrays import Array
from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.pulses import OverturningSpectrum
from colonnade.dynamics.spectra import RockingSpectrum
from colonnade.figures.files.output import link_to
from colonnade.figures.panels.layout import caption, legend_outside, note, plain_decades
from colonnade.figures.style import (
    BASE,
    FIT,
    LIMIT,
    MEASURED,
    SOFT,
    LineStyle,
    is_narrow,
    model_style,
    one_panel,
    styled,
)
from colonnade.identification.response.boundaries import Boundaries, Bracket, MapPoint, bracket_boundaries
from colonnade.units import from_si

MARKERS: dict[str, dict[str, Any]] = {
    "no-rocking": {"marker": "o", "facecolors": "white", "edgecolors": MEASURED["color"]},
    "rocking": {"marker": "D", "facecolors": "#0b6bb0", "edgecolors": "#0b6bb0"},
    "overturned": {"marker": "X", "facecolors": "#d1490f", "edgecolors": "#d1490f"},
}
"""Told apart by shape on a grey print, and by colour to colour-blind readers."""

BOUNDARIES: tuple[tuple[str, str, LineStyle], ...] = (
    ("rocking", "rocking begins", {"color": SOFT, "linestyle": (0, (4.0, 2.0)), "linewidth": 0.9}),
    ("overturning", "overturning begins", {**FIT, "linewidth": 0.9}),
)

LOGARITHMIC = 6.0
"""Amplitudes that span more than this factor are drawn on a logarithmic axis."""


@styled()
def measured_map(points: Sequence[MapPoint]) -> Figure:
    """
    Draw the sine tests of a specimen by outcome.

    A bar spans the tests between which a boundary, met going up in A, lies; a line joins the middles of the bars of
    neighbouring frequencies. A sub-harmonic response is labelled by its order.
    """
    figure, axes = one_panel(3.6)
    amplitudes = [point.amplitude_ratio for point in points]
    low, high = min([*amplitudes, 1.0]), max([*amplitudes, 1.0])
    is_logarithmic = _name_axes(axes, low, high)
    axes.set_ylim((low / 1.15, high * 1.15) if is_logarithmic else (0.0, 1.1 * high))
    axes.set_xlim(0.0, 1.08 * max(point.frequency_ratio for point in points))
    axes.axhline(1.0, **LIMIT)
    for name, label, style in BOUNDARIES:
        _draw_boundary(axes, bracket_boundaries(points), name, label, style)
    draw_points(axes, points)
    legend_outside(figure, [axes])
    return figure


def draw_points(axes: Axes, points: Sequence[MapPoint], *, prefix: str = "") -> None:
    """Draw sine tests by outcome, each as a link to its page, a sub-harmonic response with its order."""
    for outcome, look in MARKERS.items():
        chosen = [point for point in points if point.outcome == outcome]
        if chosen:
            places = axes.scatter(
                [point.frequency_ratio for point in chosen],
                [point.amplitude_ratio for point in chosen],
                s=12 if is_narrow() else 26,
                linewidths=0.9,
                label=f"{prefix}{outcome.replace('-', ' ')}",
                zorder=4,
                **look,
            )
            places.set_urls([link_to(point.test) for point in chosen])
    for point in points:
        if isinstance(point.order, int) and point.order > 1:
            at, clear = (point.frequency_ratio, point.amplitude_ratio), [withStroke(linewidth=2.5, foreground="white")]
            note(axes, f"1/{point.order}", at, (6, 0), va="center", fontsize=7, path_effects=clear)


def _name_axes(axes: Axes, low: float, high: float) -> bool:
    """Label the axes of a map, that of A as a logarithmic one if it spans much; return whether it does."""
    axes.set(xlabel="Ω = ω / p", ylabel="A = a / (g tan α)")
    is_logarithmic = low > 0 and high / low > LOGARITHMIC
    if is_logarithmic:
        axes.set_yscale("log")
        plain_decades(axes.yaxis, subs=(1.0, 1.5, 2.0, 3.0, 5.0, 7.0))
    return is_logarithmic


def _draw_boundary(axes: Axes, boundaries: Sequence[Boundaries], name: str, label: str, style: LineStyle) -> None:
    brackets: list[Bracket] = [getattr(each, name) for each in boundaries]
    ratios = np.array([each.frequency_ratio for each in boundaries])
    # Where a frequency has no bracket the line breaks: nothing is known there.
    ends = [(each.below, each.middle, each.above) for each in brackets]
    below, middles, above = np.array(ends, dtype=np.float64).T
    known = np.isfinite(middles)
    if known.any():
        axes.plot(ratios, middles, label=label, zorder=2, **style)
        bars = axes.vlines(ratios[known], below[known], above[known], color=style["color"], linewidth=4.0, alpha=0.45)
        bars.set(zorder=1, gid=f"{label}, between")


OVERTURNED_COLOUR = "#eec9b4"
SHADE = LinearSegmentedColormap.from_list("overturning", ["#ffffff", OVERTURNED_COLOUR])
"""Of the share of a cell that overturns; light, so that points and lines stand out."""


@styled()
def stability_map(charts: Sequence[StabilityMap], points: Sequence[MapPoint] = ()) -> Figure:
    """
    Draw stability maps of one block, one for each model, with its sine tests.

    The first is shaded by the share of each cell that overturns; of each the limits are drawn.
    """
    (figure, axes), first = one_panel(4.4), charts[0]
    draw_map(axes, first, points)
    for chart in charts[1:]:
        _draw_model(axes, chart)
    draw_points(axes, points, prefix="measured: ")
    caption(axes, _words(charts))
    shade = Patch(facecolor=SHADE(1.0), label=f"overturned, share of cell ({first.options['model']})")
    legend_outside(figure, [axes], below=True, patches=[shade])
    return figure


def draw_map(axes: Axes, chart: StabilityMap, points: Sequence[MapPoint] = ()) -> None:
    """Draw regions and limits of a map on axes that hold the points; an absent limit breaks its line."""
    scale_axes(axes, chart.frequency_ratio, chart.amplitude_ratio, points)
    axes.grid(False)
    axes.pcolormesh(
        chart.frequency_ratio,
        chart.amplitude_ratio,
        chart.overturning_fraction.T,
        cmap=SHADE,
        vmin=0.0,
        vmax=1.0,
        shading="nearest",
        rasterized=True,
        zorder=0,
        gid="share of the cell that overturns",
    )
    _draw_model(axes, chart)


def _draw_model(axes: Axes, chart: StabilityMap) -> None:
    model = str(chart.options["model"])
    onset: LineStyle = {**BASE, "linestyle": model_style(model)["linestyle"]}
    begins = f"{model}: rocking begins, A = {_range(chart.no_rocking)}"
    axes.plot(chart.frequency_ratio, chart.no_rocking, label=begins, zorder=2, **onset)
    draw_limits(axes, chart, model, prefix=f"{model}: ")


def draw_limits(axes: Axes, found: StabilityMap | OverturningSpectrum, model: str, *, prefix: str = "") -> None:
    """Draw the lower limit as the full line, the upper one as the thin one, in the look of the model."""
    for name, limit, wide in (("lower", found.lower, 1.6), ("upper", found.upper, 0.8)):
        look: LineStyle = {**model_style(model), "linewidth": wide}
        axes.plot(found.frequency_ratio, limit, label=f"{prefix}{name} limit", zorder=3, **look)


def _range(limit: Array) -> str:
    """Give the lowest and highest value of a limit, once if they are the same to three decimals."""
    known = limit[np.isfinite(limit)]
    return " to ".join(dict.fromkeys(f"{end:.3f}" for end in (known.min(), known.max()))) if known.size else "–"


def scale_axes(axes: Axes, frequency_ratio: Array, amplitude_ratio: Array, points: Sequence[MapPoint]) -> None:
    """Scale and label the axes of a map so that they hold its Ω and A, and the measured points."""
    amplitudes = [point.amplitude_ratio for point in points]
    low = min([float(amplitude_ratio[0]), *amplitudes])
    high = max([float(amplitude_ratio[-1]), *amplitudes])
    _name_axes(axes, low, high)
    axes.set(xlim=(float(frequency_ratio[0]), float(frequency_ratio[-1])), ylim=(low, high))


def _words(charts: Sequence[StabilityMap]) -> str:
    """Return in words what the limits depend on; of several maps, how finely each was scanned is left to its own."""
    options = charts[0].options
    motion, e = f"{options['cycles']:g} cycles, {words_of_sine(options)}", words_of_restitution(options)
    widths = " | ".join(dict.fromkeys(f"{chart.options['width']:.2g}" for chart in charts))
    scanned = f", scanned in steps of {options['scan_step']:.2g}" if len(charts) == 1 else ""
    return f"{motion}; {e}; limits at least {widths} wide{scanned}"


def words_of_sine(options: Mapping[str, Any]) -> str:
    """Return in words the ramps and the phase of the sine of a map or of steady responses."""
    ramp = f"linear ramps of {options['ramp']:g}" if options["ramp"] else "no ramp"
    return f"{ramp}, phase {from_si(options['phase'], 'deg'):.3g}°"


def words_of_restitution(options: Mapping[str, Any]) -> str:
    """Return in words the e of a map or of steady responses."""
    negative, positive = options["restitution_negative"], options["restitution_positive"]
    return f"e = {negative:.4g}" if negative == positive else f"e = {negative:.4g} | {positive:.4g}"


@styled()
def overturning_spectrum(spectrum: OverturningSpectrum) -> Figure:
    """Draw an overturning spectrum with its legend, and what the limits depend on."""
    figure, axes = one_panel(3.8)
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
    draw_limits(axes, spectrum, str(spectrum.options["model"]))
    axes.grid(False)
    axes.set_xlim(float(ratios.min()), float(ratios.max()))
    lowest = float(starts.min(initial=1.0))
    _name_axes(axes, lowest, largest)
    axes.set_ylim(0.8 * lowest, largest)


def _words_of(spectrum: OverturningSpectrum) -> str:
    options = spectrum.options
    shape = f", γ = {options['cycles']:g}, ν = {options['phase']:.3g} rad" if "cycles" in options else ""
    wide = f"limits at least {options['width']:.2g} wide"
    return f"{spectrum.pulse}{shape}; {options['model']} model; {words_of_restitution(options)}; {wide}"


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
    figure, axes = one_panel(3.4)
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
