"""The pictures of the atlas: the same curves without the fault and with it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from colonnade.figures.panels import curve as panel
from colonnade.figures.style import MEASURED, blank_figure, styled
from faults.fault import Curve, Picture

SECOND: Any = {"color": "#d1490f", "linestyle": (0, (4.0, 1.5)), "linewidth": 1.1}
INTERVALS = 300
"""Of an envelope: the panels are half a page wide."""


@styled()
def draw(picture: Picture, sound: Path, faulty: Path) -> Figure:
    """Draw what a picture shows of two campaigns, side by side on one scale."""
    figure = blank_figure(2.3)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, folder, title in zip(panels, (sound, faulty), ("without the fault", "with the fault"), strict=True):
        for curve, line in zip(picture.curves(folder), (MEASURED, SECOND), strict=False):
            x, y = _within(curve, picture.window)
            axes.plot(x, y, label=curve.label, **line)
        axes.set_title(title)
        axes.set_xlabel(picture.across)
        axes.locator_params(axis="x", nbins=5)
    panels[0].set_xlim(*picture.window)
    panels[0].set_ylabel(picture.up)
    handles, labels = panels[0].get_legend_handles_labels()
    if len(labels) > 1:
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
    return figure


def _within(curve: Curve, window: tuple[float, float]) -> panel.Curve:
    inside = (curve.x >= window[0]) & (curve.x <= window[1])
    return panel.envelope(panel.Curve(curve.x[inside], np.asarray(curve.y[inside])), intervals=INTERVALS)
