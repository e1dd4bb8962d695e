"""Rocking histories: measured and predicted, alone or with the base motion below."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.figures.curve import Curve, envelope
from colonnade.figures.style import BASE, LIMIT, MEASURED, LineStyle, blank_figure, model_style, styled

SMALLEST_RATIO = 0.02
"""No θ/α axis is narrower than ± this, so that the noise of a block at rest does not look like rocking."""

LARGEST_RATIO = 1.35
"""Nor wider than ± this: an overturning leaves the axis."""

ANGLE_LABEL = "θ / α"


def rocking_history(
    measured: Curve | None,
    predicted: Mapping[str, Curve],
    *,
    axes: Axes | None = None,
    ratio_limit: float | None = None,
) -> Figure:
    """
    Draw the rocking angle over the critical angle, measured and by each model.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s); None where the angle was not measured.
    predicted : mapping of str to Curve
        θ/α by model.
    axes : Axes, optional
        To draw into; a new figure with its legend otherwise.
    ratio_limit : float, optional
        Half range of the θ/α axis; default: from the curves (see `limit_of`).

    Returns
    -------
    figure : Figure
    """
    with styled():
        if axes is None:
            figure = blank_figure(2.5)
            axes = figure.subplots()
            _draw_angle(axes, measured, predicted, ratio_limit)
            axes.set_xlabel("time (s)")
            add_legend(figure, [axes])
            return figure
        _draw_angle(axes, measured, predicted, ratio_limit)
        return cast(Figure, axes.get_figure(root=True))


def history_with_base(
    measured: Curve | None,
    predicted: Mapping[str, Curve],
    base: Curve,
    *,
    base_label: str = "acceleration\nof base (m/s²)",
    uplift: float | None = None,
    axes: tuple[Axes, Axes] | None = None,
) -> Figure:
    """
    Draw the rocking history with the base motion below, on one time axis.

    Parameters
    ----------
    measured, predicted
        As in `rocking_history`.
    base : Curve
        Base motion over time (s), in the unit that `base_label` gives.
    base_label : str, optional
    uplift : float, optional
        Base acceleration g tan α that starts rocking, drawn as two lines where it lies within the range of the motion.
    axes : pair of Axes, optional
        Upper and lower, to draw into; a new figure with its legend otherwise.

    Returns
    -------
    figure : Figure
    """
    with styled():
        figure = blank_figure(3.8) if axes is None else cast(Figure, axes[0].get_figure(root=True))
        upper, lower = figure.subplots(2, sharex=True, height_ratios=(1.7, 1.0)) if axes is None else axes
        _draw_angle(upper, measured, predicted, None)
        lower.plot(*envelope(base), **BASE)
        largest = _largest([base]) or 1.0
        lower.set_ylim(-1.12 * largest, 1.12 * largest)
        if uplift is not None and uplift < 1.12 * largest:
            _draw_limit(lower, uplift, "g tan α")
        lower.set_ylabel(base_label)
        lower.set_xlabel("time (s)")
        lower.set_xlim(*time_limits([curve for curve in (measured, base, *predicted.values()) if curve is not None]))
        figure.align_ylabels([upper, lower])
        if axes is None:
            add_legend(figure, [upper, lower])
        return figure


def limit_of(curves: Sequence[Curve]) -> float:
    """Return the half range of a θ/α axis that shows these curves up to, and a little beyond, overturning."""
    largest = _largest(curves)
    return LARGEST_RATIO if largest > 1.0 else min(max(1.12 * largest, SMALLEST_RATIO), LARGEST_RATIO)


def time_limits(curves: Sequence[Curve]) -> tuple[float, float]:
    """Return the first and last time (s) of all curves; 0 and 1 where there are none."""
    spans = [(float(curve.time[0]), float(curve.time[-1])) for curve in curves if curve.time.size > 1]
    if not spans:
        return 0.0, 1.0
    return min(first for first, _ in spans), max(last for _, last in spans)


def add_legend(figure: Figure, axes: Sequence[Axes]) -> None:
    """Put one legend above all panels, each line named once, where it cannot cover a curve."""
    named: dict[str, Artist] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            named.setdefault(str(label), handle)
    if named:
        figure.legend(list(named.values()), list(named), loc="outside upper left", ncols=len(named), borderaxespad=0.2)


def _draw_angle(axes: Axes, measured: Curve | None, predicted: Mapping[str, Curve], ratio_limit: float | None) -> None:
    curves = [curve for curve in (measured, *predicted.values()) if curve is not None]
    limit = limit_of(curves) if ratio_limit is None else ratio_limit
    lines: list[tuple[Curve | None, str, LineStyle]] = [(measured, "measured", MEASURED)]
    lines += [(curve, f"{model} model", model_style(model)) for model, curve in predicted.items()]
    for curve, label, style in lines:
        if curve is not None:
            # Clipped well outside the axis: a fallen block's ±π/2 would only lengthen the file.
            time, values = envelope(curve)
            axes.plot(time, np.clip(values, -2 * limit, 2 * limit), label=label, **style)
    if limit > 1.0:
        _draw_limit(axes, 1.0, "α")
    axes.set_ylim(-limit, limit)
    axes.set_xlim(*time_limits(curves))
    axes.set_ylabel(ANGLE_LABEL)
    if not curves:
        axes.text(
            0.5, 0.5, "no rocking angle, measured or predicted", transform=axes.transAxes, ha="center", va="center"
        )


def _draw_limit(axes: Axes, level: float, name: str) -> None:
    """Draw lines at ± a limit and name the upper one beside the axis."""
    for value in (-level, level):
        axes.axhline(value, **LIMIT)
    axes.annotate(
        name,
        (1.0, level),
        xycoords=axes.get_yaxis_transform(),
        xytext=(3, 0),
        textcoords="offset points",
        va="center",
        fontsize=8,
        color="#30353d",
        annotation_clip=False,
    )


def _largest(curves: Sequence[Curve]) -> float:
    """Return the largest finite magnitude, 0 where there is none."""
    return max(
        (float(np.abs(curve.values[np.isfinite(curve.values)]).max(initial=0.0)) for curve in curves), default=0.0
    )
