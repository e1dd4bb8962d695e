"""Earthquake tests of rising intensity side by side: each model on the measured angle, above the base motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from colonnade.figures.histories import ANGLE_LABEL, draw_angle, largest_of, limit_of, scale_symmetric, time_limits
from colonnade.figures.panels.curve import Curve, envelope
from colonnade.figures.panels.layout import COLUMNS, legend_above, side_by_side
from colonnade.figures.panels.long import draw_curve
from colonnade.figures.style import BASE, styled

ANGLE_HEIGHT, BASE_HEIGHT = 1.35, 0.8
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
    figure, grid = side_by_side(len(panels), [ANGLE_HEIGHT] * rows + [BASE_HEIGHT] * bool(bases))
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
    for column in grid[::COLUMNS]:
        for one in column[:rows]:
            one.set_ylabel(ANGLE_LABEL)
        if bases:
            column[-1].set_ylabel("base\n(m/s²)")
    legend_above(figure, [one for column in grid for one in column[:rows]])
    return figure
