"""The stability map: computed regions and limits over Ω and A, with the measured points on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from colonnade.arrays import Array
from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.pulses import OverturningSpectrum
from colonnade.figures.maps.measured_map import LOGARITHMIC, draw_points, label_logarithmic, name_axes
from colonnade.figures.panels.layout import caption, legend_outside
from colonnade.figures.style import BASE, LineStyle, blank_figure, model_style, styled
from colonnade.identification.response.boundaries import MapPoint
from colonnade.units import from_si

OVERTURNED_COLOUR = "#eec9b4"
SHADE = LinearSegmentedColormap.from_list("overturning", ["#ffffff", OVERTURNED_COLOUR])
"""Of the share of a cell that overturns; light, so that points and lines stand out."""


@styled()
def stability_map(charts: Sequence[StabilityMap], points: Sequence[MapPoint] = (), *, linked: bool = False) -> Figure:
    """
    Draw stability maps of one block, one for each model, with its sine tests, as links if `linked`.

    The first is shaded by the share of each cell that overturns; of each the limits are drawn.
    """
    figure, first = blank_figure(4.4), charts[0]
    axes = figure.subplots()
    draw_map(axes, first, points)
    for chart in charts[1:]:
        _draw_model(axes, chart)
    draw_points(axes, points, prefix="measured: ", linked=linked)
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
    axes.set_xlim(float(frequency_ratio[0]), float(frequency_ratio[-1]))
    if high / low > LOGARITHMIC:
        label_logarithmic(axes)
    axes.set_ylim(low, high)
    name_axes(axes)


def _words(charts: Sequence[StabilityMap]) -> str:
    """Return in words what the limits depend on; of several maps, how finely each was scanned is left to its own."""
    options = charts[0].options
    motion = "recorded table motion, stretched"
    if options["base_motion"] == "sine":
        motion = f"{options['cycles']:g} cycles, {words_of_sine(options)}"
    e = words_of_restitution(options)
    widths = " | ".join(dict.fromkeys(f"{chart.options['width']:.2g}" for chart in charts))
    scanned = f", scanned in steps of {options['scan_step']:.2g}" if len(charts) == 1 else ""
    return f"{motion}; {e}; limits at least {widths} wide{scanned}"


def words_of_sine(options: Mapping[str, Any]) -> str:
    """Return in words the ramps and the phase of the sine of a map or of steady responses."""
    ramp = f"linear ramps of {options['ramp']:g}" if options["ramp"] else "no ramp"
    return f"{ramp}, phase {from_si(options['phase'], 'deg'):.3g}°"


def words_of_restitution(options: Mapping[str, Any]) -> str:
    """Return in words the e of a map or of steady responses."""
    if "restitution_values" in options:
        values = options["restitution_values"]
        return f"e = {values[0]:.4g} … {values[-1]:.4g} over the speed of the impact"
    negative, positive = options["restitution_negative"], options["restitution_positive"]
    return f"e = {negative:.4g}" if negative == positive else f"e = {negative:.4g} | {positive:.4g}"
