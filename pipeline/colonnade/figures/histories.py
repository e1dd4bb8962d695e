"""The rocking angle over time, measured and predicted, in a panel of any figure; the bands that a model leaves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.figures.panels.curve import Curve, draw_band, draw_curve
from colonnade.figures.panels.layout import note, stacked_panels
from colonnade.figures.style import INK, LIMIT, is_narrow, model_style, name_of, style_of, styled
from colonnade.units.text import format_percent

SMALLEST_RATIO = 0.02
"""No θ/α axis is narrower than ± this, so that the noise of a block at rest does not look like rocking."""

LARGEST_RATIO = 1.35
"""Nor wider than ± this: an overturning leaves the axis."""

ANGLE_LABEL = "θ / α"

SMALLEST = 1e-3
"""Nor the axis of any other panel than ± this, in its unit."""

SHADES = (0.18, 0.3)
"""Opacity of the widest band and of those inside it."""


class Spread(NamedTuple):
    """
    What an ensemble of one model says over time.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s.
    levels : ndarray, shape (q,)
        Between 0 and 1, increasing, the same distance from 0 and from 1.
    bands : ndarray, shape (q, n)
        θ/α at these quantiles; NaN if missing.
    overturning_probability : float
    horizon : float
        s, up to which the angle is predicted.
    """

    time: Array
    levels: Array
    bands: Array
    overturning_probability: float
    horizon: float

    def share(self, index: int) -> float:
        """Return the share of the runs within band `index`, the widest being number 0."""
        return float(1.0 - 2.0 * self.levels[index])


class Panel(NamedTuple):
    """
    Curves over time in a panel of their own.

    `title` says what they are, `label` the same beside an axis; `curves` are those that were "measured" and by each
    model, or without a name what was recorded beside; `level` is marked at ± with its name, where the curves reach it.
    """

    title: str
    label: str
    unit: str
    curves: Mapping[str, Curve]
    level: float | None = None
    level_name: str = ""


def draw_panel(axes: Axes, panel: Panel) -> None:
    """Draw a panel, scaled to its curves."""
    draw_curves(axes, panel.curves)
    largest = max(largest_of(curve.values for curve in panel.curves.values()), SMALLEST)
    scale_symmetric(axes, largest)
    if panel.level is not None and panel.level < 1.12 * largest:
        draw_limit(axes, panel.level, panel.level_name)
    axes.set_ylabel(f"{panel.label}\n({panel.unit})" if panel.unit else panel.label)


def draw_curves(axes: Axes, curves: Mapping[str, Curve], thinness: float = 1.0) -> None:
    """Draw what was measured, and by each model with lines of this thinness."""
    for who, curve in curves.items():
        draw_curve(axes, curve, label=name_of(who), **style_of(who, thinness))


def draw_angle(
    axes: Axes,
    curves: Mapping[str, Curve],
    limit: float,
    *,
    spreads: Mapping[str, Spread] | None = None,
    thinness: float = 1.0,
    limit_name: str = "α",
) -> None:
    """
    Draw the rocking angle over the critical angle, measured and by each model, into a panel.

    Parameters
    ----------
    axes : Axes
    curves : mapping of str to Curve
        θ/α over time (s): "measured", and by model.
    limit : float
        Half range of the θ/α axis (see `limit_of`).
    spreads : mapping of str to Spread, optional
        The widest band of each model's ensemble, shaded below the lines, and its horizon.
    thinness : float, optional
        Factor on the width of the models' lines, where the measured one would be hidden below them.
    limit_name : str, optional
        Written beside the line of the critical angle, which is drawn where the axis reaches it.
    """
    for model, spread in (spreads or {}).items():
        shade(axes, spread, 1, model_style(model)["color"], f"{model} ")
    draw_curves(axes, curves, thinness)
    if limit > 1.0:
        draw_limit(axes, 1.0, limit_name)
    axes.set(ylim=(-limit, limit), ylabel=ANGLE_LABEL)
    if not curves:
        said = "no rocking angle, measured or predicted"
        axes.text(0.5, 0.5, said, transform=axes.transAxes, ha="center", va="center")


def shade(axes: Axes, spread: Spread, count: int, colour: str, prefix: str = "") -> None:
    """Shade the widest bands of an ensemble; mark the model's horizon, unless it is the end of the record."""
    for index in range(count):
        label = f"{prefix}{format_percent(spread.share(index))} band"
        opacity = SHADES[min(index, len(SHADES) - 1)]
        low, high = spread.bands[index], spread.bands[-1 - index]
        draw_band(axes, spread.time, low, high, color=colour, alpha=opacity, label=label, zorder=0.5)
    if spread.horizon < spread.time[-1]:
        axes.axvline(spread.horizon, color=colour, linewidth=0.9, linestyle=(0, (1, 1.5)))
        is_late = spread.horizon > 0.5 * (spread.time[0] + spread.time[-1])
        aside, side = (-3.0, "right") if is_late else (3.0, "left")
        place = axes.get_xaxis_transform()
        note(
            axes,
            "horizon",
            (spread.horizon, 0.98),
            (aside, 0.0),
            xycoords=place,
            ha=side,
            va="top",
            fontsize=7,
            color=colour,
        )


def limit_of(curves: Iterable[Curve]) -> float:
    """Return the half range of a θ/α axis that shows these curves up to, and a little beyond, overturning."""
    largest = largest_of(curve.values for curve in curves)
    return LARGEST_RATIO if largest > 1.0 else min(max(1.12 * largest, SMALLEST_RATIO), LARGEST_RATIO)


def time_limits(curves: Iterable[Curve]) -> tuple[float, float]:
    """Return the first and last time (s) of all curves; 0 and 1 without curves."""
    spans = [(float(curve.time[0]), float(curve.time[-1])) for curve in curves if curve.time.size > 1]
    if not spans:
        return 0.0, 1.0
    return min(first for first, _ in spans), max(last for _, last in spans)


def scale_symmetric(axes: Axes, largest: float) -> None:
    """Let an axis reach a little beyond ± the largest value, with few numbers."""
    axes.set_ylim(-1.12 * largest, 1.12 * largest)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=4, symmetric=True, steps=[1, 2, 5, 10]))


def draw_limit(axes: Axes, level: float, name: str) -> None:
    """Draw lines at ± a limit and name the upper one beside the axis."""
    for value in (-level, level):
        axes.axhline(value, **LIMIT)
    note(axes, name, (1.0, level), (3, 0), xycoords=axes.get_yaxis_transform(), va="center", annotation_clip=False)


def largest_of(parts: Iterable[Array]) -> float:
    """Return the largest finite magnitude, 0 without a finite value."""
    return max((float(np.abs(values[np.isfinite(values)]).max(initial=0.0)) for values in parts), default=0.0)


HEIGHT = 1.9
"""Of a model's panel, inches."""


@styled()
def bands_over_time(measured: Mapping[str, Curve], spreads: Mapping[str, Spread]) -> Figure:
    """Draw the "measured" θ/α, if there is any, over the bands of each model, one panel a model, which says whose."""
    figure, axes = stacked_panels([HEIGHT] * len(spreads))
    curves = [Curve(spread.time, band) for spread in spreads.values() for band in spread.bands]
    curves += measured.values()
    limit = limit_of(curves)
    for panel, (model, spread) in zip(axes, spreads.items(), strict=True):
        count = int((spread.levels < 0.5).sum())
        shade(panel, spread, count, model_style(model)["color"], f"{model} ")
        draw_angle(panel, measured, limit)
        shares = " and ".join(format_percent(spread.share(index)) for index in range(count))
        said = f"measured, and bands of {shares} of the {model} model's runs"
        if is_narrow():
            said = f"{model} model: {shares} of its runs"
        if spread.overturning_probability > 0:
            said += f"; {format_percent(spread.overturning_probability)} overturn"
        panel.set_title(said, loc="right", fontsize=7 if is_narrow() else 8, color=INK, pad=1.5)
    axes[-1].set(xlim=time_limits(curves), xlabel="time (s)")
    return figure
