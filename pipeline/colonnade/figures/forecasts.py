"""Whether forecasts are calibrated: reliability of the probability of overturning, and PIT of the amplitude."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import scipy
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.arrays import Array
from colonnade.figures.panels.layout import legend_outside, note
from colonnade.figures.style import LIMIT, SOFT, blank_figure, is_narrow, model_style, styled
from colonnade.identification.calibration import FEW, Reliability

FEW_BINS, BINS = 5, 10
"""Bins of the PIT histogram of fewer than `FEW` tests, and of more."""


class Calibration(NamedTuple):
    """Of the scored forecasts of a model: their reliability diagram, and the PIT of each, shape (n,)."""

    reliability: Reliability
    pit: Array


@styled()
def reliability_and_pit(models: Mapping[str, Calibration]) -> Figure:
    """
    Draw the reliability diagram of overturning and the PIT histogram of the amplitude.

    Parameters
    ----------
    models : mapping of str to Calibration

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no model.

    Notes
    -----
    Grey in the histogram: 95 % of the shares if the forecasts are right and the tests share no error.
    """
    figure = blank_figure(6.0 if is_narrow() else 3.3)
    left, right = figure.subplots(2, 1) if is_narrow() else figure.subplots(1, 2)
    left.plot([0, 1], [0, 1], **LIMIT)
    for place, (model, each) in enumerate(models.items()):
        _draw_reliability(left, model, each.reliability, aside=0.012 * (place - (len(models) - 1) / 2))
    left.set(
        xlim=(-0.03, 1.03),
        ylim=(-0.03, 1.03),
        xlabel="forecast probability of overturning",
        ylabel="share of the tests that overturned",
    )
    _draw_pit(right, models)
    legend_outside(figure, [left])
    return figure


def _draw_reliability(axes: Axes, model: str, diagram: Reliability, *, aside: float) -> None:
    style, across = model_style(model), diagram.probability + aside
    bars = axes.vlines(across, diagram.low, diagram.high, color=style["color"], linewidth=4.0, alpha=0.3)
    bars.set_gid(f"{model}, consistency bar")
    axes.plot(
        across,
        diagram.frequency,
        color=style["color"],
        linestyle="none",
        marker="o",
        markersize=4,
        markerfacecolor="white",
        label=f"{model} model",
    )
    shift, side = ((5.0, 2.0), "left") if aside >= 0 else ((-5.0, 2.0), "right")
    for place, frequency, tests in zip(across, diagram.frequency, diagram.tests, strict=True):
        note(axes, str(tests), (place, frequency), shift, ha=side, fontsize=7, color=SOFT)


def _draw_pit(axes: Axes, models: Mapping[str, Calibration]) -> None:
    tests = max(each.pit.size for each in models.values())
    count = FEW_BINS if tests < FEW else BINS
    edges = np.linspace(0.0, 1.0, count + 1)
    low, high = (scipy.stats.binom.ppf(level, tests, 1 / count) / tests for level in (0.025, 0.975))
    axes.axhspan(low, high, color=SOFT, alpha=0.15, linewidth=0)
    axes.axhline(1 / count, **LIMIT)
    for model, each in models.items():
        shares = np.histogram(each.pit, edges)[0] / each.pit.size
        axes.stairs(shares, edges, label=f"{model} model", baseline=None, **model_style(model))
    axes.set(xlim=(0, 1), xlabel="PIT of the measured amplitude", ylabel="share of the tests")
    axes.set_ylim(0, max(axes.get_ylim()[1], 1.15 * high))
