"""The measured angle over the band that a model's own uncertainty leaves: is the misfit within its spread?"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from colonnade.figures.histories import ANGLE_LABEL, Spread, draw_angle, limit_of, mark_horizon, shade, time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import stacked_panels
from colonnade.figures.style import INK, model_style, styled
from colonnade.units.text import format_percent

HEIGHT = 1.9
"""Of a model's panel, inches."""


@styled()
def bands_over_time(measured: Curve | None, spreads: Mapping[str, Spread]) -> Figure:
    """
    Draw the measured angle over the bands of each model, one panel a model; the panel says whose bands they are.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s); None if it was not measured.
    spreads : mapping of str to Spread
        By model.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no model, or levels are not paired about the median.
    """
    if not spreads:
        raise ValueError("no ensemble was given; that of at least one model was expected")
    for model, spread in spreads.items():
        if not np.allclose(spread.levels + spread.levels[::-1], 1.0):
            raise ValueError(f"{model}: the levels {spread.levels.tolist()} are not paired about 0.5")
    figure, axes = stacked_panels([HEIGHT] * len(spreads))
    curves = [Curve(spread.time, band) for spread in spreads.values() for band in spread.bands]
    curves += [measured] if measured is not None else []
    limit = limit_of(curves)
    for panel, (model, spread) in zip(axes, spreads.items(), strict=True):
        colour = model_style(model)["color"]
        for index in range(int((spread.levels < 0.5).sum())):
            shade(panel, spread, index, colour, label=f"{model} {format_percent(spread.share(index))} band")
        mark_horizon(panel, spread, colour)
        draw_angle(panel, measured, {}, limit)
        panel.set_ylabel(ANGLE_LABEL)
        shares = " and ".join(format_percent(spread.share(index)) for index in range(int((spread.levels < 0.5).sum())))
        said = f"line: measured; bands: {shares} of the {model} model's runs"
        if spread.overturning_probability > 0:
            said += f"; {format_percent(spread.overturning_probability)} overturn"
        panel.annotate(said, (0.995, 0.04), xycoords="axes fraction", ha="right", fontsize=8, color=INK)
    axes[-1].set_xlim(*time_limits(curves))
    axes[-1].set_xlabel("time (s)")
    return figure
