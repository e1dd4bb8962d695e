"""The stability map: computed regions and limits over Ω and A, with the measured points on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from colonnade.arrays import Array
from colonnade.dynamics.maps import StabilityMap
from colonnade.figures.maps.measured_map import LOGARITHMIC, draw_points, label_logarithmic, name_axes
from colonnade.figures.style import (
    BASE,
    SMALL_TEXT,
    SOFT,
    LineStyle,
    blank_figure,
    fitting,
    is_narrow,
    model_style,
    styled,
    width,
)
from colonnade.identification.response.boundaries import MapPoint
from colonnade.units import from_si

NARROW_LINE = 62
"""Letters of a line above the map in a single column."""

OVERTURNED_COLOUR = "#eec9b4"
SHADE = LinearSegmentedColormap.from_list("overturning", ["#ffffff", OVERTURNED_COLOUR])
"""Of the share of a cell that overturns; light, so that points and lines stand out."""


@styled()
def stability_map(
    charts: StabilityMap | Sequence[StabilityMap],
    points: Sequence[MapPoint] = (),
    *,
    linked: bool = False,
    axes: Axes | None = None,
) -> Figure:
    """
    Draw a stability map.

    Parameters
    ----------
    charts : StabilityMap or sequence of StabilityMap
        Maps of one block, one for each model. The first is shaded by the share of each cell that overturns; of each
        the limits are drawn.
    points : sequence of MapPoint, optional
        Measured sine tests.
    linked : bool, optional
        Whether each of them leads to its test, see `output.link_to`.
    axes : Axes, optional
        To draw into; a new figure with its legend and with the options of the first map otherwise.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no map.

    Notes
    -----
    The lower limit is the full line, the upper one the thin one; where a limit is absent up to the largest A its line
    breaks. Each model has the colour and dash that it has in every figure.
    """
    charts = [charts] if isinstance(charts, StabilityMap) else list(charts)
    if not charts:
        raise ValueError("no map was given; at least one was expected")
    own = axes is None
    if axes is None:
        axes = blank_figure(4.4).subplots()
    first = charts[0]
    scale_axes(axes, first.frequency_ratio, first.amplitude_ratio, points)
    axes.grid(False)
    axes.pcolormesh(
        first.frequency_ratio,
        first.amplitude_ratio,
        first.overturning_fraction.T,
        cmap=SHADE,
        vmin=0.0,
        vmax=1.0,
        shading="nearest",
        rasterized=True,
        zorder=0,
        gid="share of the cell that overturns",
    )
    for chart in charts:
        _limits(axes, chart)
    draw_points(axes, points, prefix="measured: ", linked=linked)
    figure = cast(Figure, axes.get_figure(root=True))
    if own:
        words, most = _words(charts), 3
        handles, labels = axes.get_legend_handles_labels()
        shade = Patch(facecolor=SHADE(1.0), label=f"overturned, share of cell ({first.options['model']})")
        labels = [str(shade.get_label()), *labels]
        if is_narrow():
            words, most = fill(words, NARROW_LINE), fitting(labels, inches=width(), points=7.0, most=3)
        axes.set_title(words, fontsize=SMALL_TEXT["legend.fontsize"] if is_narrow() else 8, color=SOFT)
        figure.legend(
            handles=[shade, *handles],
            labels=labels,
            loc="outside lower center",
            ncols=most,
            fontsize=SMALL_TEXT["legend.fontsize"] if is_narrow() else 8,
            columnspacing=1.4,
            handletextpad=0.6,
        )
    return figure


def _limits(axes: Axes, chart: StabilityMap) -> None:
    model = str(chart.options["model"])
    style = model_style(model)
    onset: LineStyle = {**BASE, "linestyle": style["linestyle"]}
    lower: LineStyle = {**style, "linewidth": 1.6}
    upper: LineStyle = {**style, "linewidth": 0.8}
    begins = f"{model}: rocking begins, A = {_range(chart.no_rocking)}"
    axes.plot(chart.frequency_ratio, chart.no_rocking, label=begins, zorder=2, **onset)
    axes.plot(chart.frequency_ratio, chart.lower, label=f"{model}: lower limit", zorder=3, **lower)
    axes.plot(chart.frequency_ratio, chart.upper, label=f"{model}: upper limit", zorder=3, **upper)


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
