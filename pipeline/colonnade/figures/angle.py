"""The rocking angle over time alone, measured and predicted: what a paper shows of a test."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.figure import Figure

from colonnade.figures.histories import draw_angle, limit_of, time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import legend_above, side_by_side
from colonnade.figures.style import is_narrow, styled

HEIGHT, LOWER = 2.4, 1.7
"""Of the panel, and of that in a single column, inches."""


@styled()
def rocking_angle(measured: Curve | None, predicted: Mapping[str, Curve], *, title: str = "") -> Figure:
    """
    Draw the rocking angle over the critical angle, measured and by each model.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s); None if it was not measured.
    predicted : mapping of str to Curve
        θ/α by model.
    title : str, optional
        Above the panel.

    Returns
    -------
    figure : Figure
    """
    figure, ((axes,),) = side_by_side(1, [LOWER if is_narrow() else HEIGHT])
    curves = [curve for curve in (measured, *predicted.values()) if curve is not None]
    draw_angle(axes, measured, predicted, limit_of(curves), thinness=0.8)
    axes.set_title(title)
    axes.set_xlim(*time_limits(curves))
    axes.set_xlabel("time (s)")
    legend_above(figure, [axes])
    return figure
