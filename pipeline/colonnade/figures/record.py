"""The whole record of a test over time, measured and predicted; and earthquake tests of rising Span side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.arrays import Array
from colonnade.figures.histories import (
    ANGLE_LABEL,
    Spread,
    draw_angle,
    draw_limit,
    largest_of,
    limit_of,
    scale_symmetric,
    time_limits,
)
from colonnade.figures.panels.curve import Curve, draw_curve, envelope
from colonnade.figures.panels.layout import COLUMNS, legend_above, side_by_side, stacked_panels
from colonnade.figures.style import BASE, MEASURED, is_narrow, model_style, styled

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


MODEL_HEIGHT, BASE_HEIGHT = 1.35, 0.8
"""Heights of the panels, inches."""

THINNESS = 0.6
"""Of the models' lines beside their usual width."""


class SpanPanel(NamedTuple):
    """One test: its title, θ/α over time (s) as measured (None if it was not) and by each model; base in m/s²."""

    title: str
    measured: Curve | None
    predicted: Mapping[str, Curve]
    base: Curve | None = None

    def thinned(self) -> SpanPanel:
        """Return the same panel with curves of a few hundred points, so that many fit into memory."""
        measured, base = (None if curve is None else envelope(curve) for curve in (self.measured, self.base))
        return SpanPanel(self.title, measured, {name: envelope(curve) for name, curve in self.predicted.items()}, base)


@styled()
def spans_side_by_side(panels: Sequence[SpanPanel]) -> Figure:
    """
    Draw earthquake tests side by side, a row of panels for each model, all with the same scales.

    Parameters
    ----------
    panels : sequence of SpanPanel
        In the order in which they are drawn, from the left.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no panel.
    """
    if not panels:
        raise ValueError("no test was given; at least one panel was expected")
    models = list(dict.fromkeys(model for panel in panels for model in panel.predicted))
    curves = [curve for panel in panels for curve in (panel.measured, *panel.predicted.values()) if curve is not None]
    bases = [panel.base for panel in panels if panel.base is not None]
    limit, largest = limit_of(curves), largest_of(bases) or 1.0
    rows = max(len(models), 1)
    figure, grid = side_by_side(len(panels), [MODEL_HEIGHT] * rows + [BASE_HEIGHT] * bool(bases))
    for column, panel in zip(grid, panels, strict=True):
        for one, model in zip(column, models or [""], strict=False):
            predicted = {model: panel.predicted[model]} if model in panel.predicted else {}
            draw_angle(one, panel.measured, predicted, limit, thinness=THINNESS, limit_name="")
            one.set_ylabel("")
        column[0].set_title(panel.title)
        if bases:
            if panel.base is not None:
                draw_curve(column[-1], panel.base, **BASE)
            scale_symmetric(column[-1], largest)
        column[-1].set_xlabel("time (s)")
        column[0].set_xlim(*time_limits([*curves, *bases]))
    for column in grid[:: 1 if is_narrow() else COLUMNS]:
        for one in column[:rows]:
            one.set_ylabel(ANGLE_LABEL)
        if bases:
            column[-1].set_ylabel("base\n(m/s²)")
    legend_above(figure, [one for column in grid for one in column[:rows]])
    return figure
