"""Earthquake tests of rising intensity together, on the same scales."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.figures.curve import Curve
from colonnade.figures.histories import add_legend, limit_of, rocking_history, time_limits
from colonnade.figures.style import blank_figure, styled


class SpanPanel(NamedTuple):
    """One test: its title, and θ/α over time (s) as measured (None where it was not) and by each model."""

    title: str
    measured: Curve | None
    predicted: Mapping[str, Curve]


def spans_together(panels: Sequence[SpanPanel], *, axes: Sequence[Axes] | None = None) -> Figure:
    """
    Draw earthquake tests one below the other, all with the same θ/α and time axes.

    Parameters
    ----------
    panels : sequence of SpanPanel
        In the order in which they are drawn, from the top.
    axes : sequence of Axes, optional
        To draw into, one a panel; a new figure with its legend otherwise.

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
    curves = [curve for panel in panels for curve in (panel.measured, *panel.predicted.values()) if curve is not None]
    limit, times = limit_of(curves), time_limits(curves)
    with styled():
        own = axes is None
        if axes is None:
            figure = blank_figure(0.6 + 1.6 * len(panels))
            axes = list(np.atleast_1d(figure.subplots(len(panels), sharex=True, sharey=True)))
        for one, panel in zip(axes, panels, strict=True):
            figure = rocking_history(panel.measured, panel.predicted, axes=one, ratio_limit=limit)
            one.set_title(panel.title)
            one.set_xlim(*times)
        axes[-1].set_xlabel("time (s)")
        if own:
            add_legend(figure, axes)
    return figure
