"""The rocking angle over time, measured and predicted, in a panel of any figure; the ranges of its axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from colonnade.figures.curve import INTERVALS, Curve, envelope
from colonnade.figures.style import LIMIT, MEASURED, LineStyle, model_style

SMALLEST_RATIO = 0.02
"""No θ/α axis is narrower than ± this, so that the noise of a block at rest does not look like rocking."""

LARGEST_RATIO = 1.35
"""Nor wider than ± this: an overturning leaves the axis."""

ANGLE_LABEL = "θ / α"


def draw_angle(
    axes: Axes,
    measured: Curve | None,
    predicted: Mapping[str, Curve],
    limit: float,
    *,
    intervals: int = INTERVALS,
    thinness: float = 1.0,
    limit_name: str = "α",
) -> None:
    """
    Draw the rocking angle over the critical angle, measured and by each model, into a panel.

    Parameters
    ----------
    axes : Axes
    measured : Curve or None
        θ/α over time (s); None where the angle was not measured.
    predicted : mapping of str to Curve
        θ/α by model.
    limit : float
        Half range of the θ/α axis (see `limit_of`).
    intervals : int, optional
        Of each curve's envelope.
    thinness : float, optional
        Factor on the width of the models' lines, where the measured one would be hidden below them.
    limit_name : str, optional
        Written beside the line of the critical angle, which is drawn where the axis reaches it.
    """
    lines: list[tuple[Curve | None, str, LineStyle]] = [(measured, "measured", MEASURED)]
    lines += [(curve, f"{model} model", model_style(model, thinness)) for model, curve in predicted.items()]
    for curve, label, style in lines:
        if curve is not None:
            # Clipped well outside the axis: a fallen block's ±π/2 would only lengthen the file.
            time, values = envelope(curve, intervals=intervals)
            axes.plot(time, np.clip(values, -2 * limit, 2 * limit), label=label, **style)
    if limit > 1.0:
        draw_limit(axes, 1.0, limit_name)
    axes.set_ylim(-limit, limit)
    axes.set_ylabel(ANGLE_LABEL)
    if measured is None and not predicted:
        axes.text(
            0.5, 0.5, "no rocking angle, measured or predicted", transform=axes.transAxes, ha="center", va="center"
        )


def limit_of(curves: Sequence[Curve]) -> float:
    """Return the half range of a θ/α axis that shows these curves up to, and a little beyond, overturning."""
    largest = largest_of(curves)
    return LARGEST_RATIO if largest > 1.0 else min(max(1.12 * largest, SMALLEST_RATIO), LARGEST_RATIO)


def time_limits(curves: Sequence[Curve]) -> tuple[float, float]:
    """Return the first and last time (s) of all curves; 0 and 1 where there are none."""
    spans = [(float(curve.time[0]), float(curve.time[-1])) for curve in curves if curve.time.size > 1]
    if not spans:
        return 0.0, 1.0
    return min(first for first, _ in spans), max(last for _, last in spans)


def draw_limit(axes: Axes, level: float, name: str) -> None:
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


def largest_of(curves: Sequence[Curve]) -> float:
    """Return the largest finite magnitude, 0 where there is none."""
    return max(
        (float(np.abs(curve.values[np.isfinite(curve.values)]).max(initial=0.0)) for curve in curves), default=0.0
    )
