"""All that is known of one test over time: angle, misfit, other motions of the specimen, base motion, on one axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.arrays import Array
from colonnade.figures.histories import (
    Spread,
    draw_angle,
    draw_limit,
    largest_of,
    limit_of,
    scale_symmetric,
    time_limits,
)
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import legend_above, stacked_panels
from colonnade.figures.panels.long import draw_curve
from colonnade.figures.style import BASE, MEASURED, model_style, styled

ANGLE_HEIGHT, OTHER_HEIGHT = 2.0, 0.8
"""Heights of the panels, inches."""

AFTER = 0.05
"""Share of the time up to an overturning that the axis shows after it."""


class Quantity(NamedTuple):
    """A quantity in a panel of its own: label with unit, curve, and a level to mark at ± with its name."""

    label: str
    curve: Curve
    level: float | None = None
    level_name: str = ""


class Peak(NamedTuple):
    """Time (s) and θ/α of the largest measured angle."""

    time: float
    ratio: float


@styled()
def whole_record(
    measured: Curve | None,
    predicted: Mapping[str, Curve],
    *,
    misfits: Mapping[str, Curve] | None = None,
    motions: Sequence[Quantity] = (),
    base: Sequence[Quantity] = (),
    impacts: Array | None = None,
    peak: Peak | None = None,
    spreads: Mapping[str, Spread] | None = None,
    until: float | None = None,
) -> Figure:
    """
    Draw one test: measured and predicted angle above, then what else moved, and the base motion at the bottom.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s); None if the angle was not measured.
    predicted : mapping of str to Curve
        θ/α by model.
    misfits : mapping of str to Curve, optional
        Predicted minus measured θ/α by model.
    motions, base : sequence of Quantity, optional
        A panel each, in this order.
    impacts : ndarray, optional
        Times (s) of the measured impacts, marked along the foot of the uppermost panel.
    peak : Peak, optional
        Marked with a ring; of an overturned test the overturning.
    spreads : mapping of str to Spread, optional
        Ensembles by model: the widest band of each is shaded.
    until : float, optional
        When all has overturned, s: the time axis ends shortly after.

    Returns
    -------
    figure : Figure
    """
    misfits = {model: curve for model, curve in (misfits or {}).items() if np.isfinite(curve.values).any()}
    others = [*motions, *base]
    heights = [ANGLE_HEIGHT, *([OTHER_HEIGHT] * (bool(misfits) + len(others)))]
    figure, axes = stacked_panels(heights)
    limit = limit_of([curve for curve in (measured, *predicted.values()) if curve is not None])
    draw_angle(axes[0], measured, predicted, limit, spreads=spreads)
    if impacts is not None and impacts.size:
        _mark_impacts(axes[0], impacts)
    if peak is not None and np.isfinite(peak).all() and abs(peak.ratio) < limit:
        axes[0].plot(
            [peak.time],
            [peak.ratio],
            "o",
            color=MEASURED["color"],
            markersize=5,
            markerfacecolor="none",
            gid="largest measured",
        )
    if misfits:
        _draw_misfits(axes[1], misfits)
    for one, quantity in zip(axes[1 + bool(misfits) :], others, strict=True):
        _draw_quantity(one, quantity)
    curves = [measured, *predicted.values(), *(quantity.curve for quantity in others)]
    first, last = time_limits([curve for curve in curves if curve is not None])
    axes[0].set_xlim(first, last if until is None else min(last, until + AFTER * (until - first)))
    axes[-1].set_xlabel("time (s)")
    legend_above(figure, axes[:1])
    return figure


def _mark_impacts(axes: Axes, impacts: Array) -> None:
    gaps = np.full(impacts.size, np.nan)
    axes.plot(
        np.column_stack((impacts, impacts, gaps)).ravel(),
        np.column_stack((np.zeros_like(impacts), np.full_like(impacts, 0.035), gaps)).ravel(),
        transform=axes.get_xaxis_transform(),
        color=MEASURED["color"],
        linewidth=0.6,
        gid="measured impact",
    )


def _draw_misfits(axes: Axes, misfits: Mapping[str, Curve]) -> None:
    largest = max(largest_of(list(misfits.values())), 1e-3)
    for model, curve in misfits.items():
        draw_curve(axes, curve, label=f"{model} model", **model_style(model))
    scale_symmetric(axes, largest)
    axes.set_ylabel("predicted −\nmeasured, / α")


def _draw_quantity(axes: Axes, quantity: Quantity) -> None:
    draw_curve(axes, quantity.curve, **BASE)
    largest = largest_of([quantity.curve]) or 1.0
    scale_symmetric(axes, largest)
    if quantity.level is not None and quantity.level < 1.12 * largest:
        draw_limit(axes, quantity.level, quantity.level_name)
    axes.set_ylabel(quantity.label)
