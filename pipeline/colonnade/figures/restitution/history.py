"""A free vibration, the fitted free rocking, the residual, and the joint region of e and α that it leaves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.figures.histories import draw_angle, largest_of, limit_of, scale_symmetric, time_limits
from colonnade.figures.panels.curve import Curve, draw_curve
from colonnade.figures.panels.layout import legend_above, legend_outside, stacked_panels
from colonnade.figures.style import FAINT, FIT, INK, LIMIT, MEASURED, blank_figure, model_style, styled
from colonnade.units.text import format_percent

ANGLE_HEIGHT, RESIDUAL_HEIGHT = 2.2, 0.9
"""Heights of the panels, inches."""

SMALLEST_RESIDUAL = 1e-2
"""No axis of residuals is narrower than ± this, in 10⁻³ α: rounding does not look like a finding."""


@styled()
def fitted_history(measured: Curve | None, fitted: Curve, residual: Curve, *, model: str) -> Figure:
    """
    Draw measured and fitted angle, and measured minus fitted below.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s), the whole record.
    fitted, residual : Curve
        θ/α of the fit, and measured minus fitted, over the part that was fitted.
    model : str
        Of the fit: its colour and dash.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If the fit has no sample.
    """
    if not fitted.time.size:
        raise ValueError("the fitted history has no sample; at least one was expected")
    figure, axes = stacked_panels([ANGLE_HEIGHT, RESIDUAL_HEIGHT])
    shown = [curve for curve in (measured, fitted) if curve is not None]
    draw_angle(axes[0], measured, {}, limit_of(shown))
    draw_curve(axes[0], fitted, label=f"fitted, {model} model", **model_style(model))
    _draw_residual(axes[1], residual)
    axes[0].set_xlim(*time_limits(shown))
    axes[-1].set_xlabel("time (s)")
    legend_above(figure, axes[:1])
    return figure


def _draw_residual(axes: Axes, residual: Curve) -> None:
    residual = Curve(residual.time, 1e3 * residual.values)
    largest = max(largest_of([residual]), SMALLEST_RESIDUAL)
    draw_curve(axes, residual, label="measured − fitted", color=MEASURED["color"], linewidth=0.7)
    axes.axhline(0.0, color=FAINT, linewidth=0.7)
    scale_symmetric(axes, largest)
    axes.set_ylabel("measured −\nfitted (10⁻³ α)")
    finite = residual.values[np.isfinite(residual.values)]
    if finite.size:
        root = float(np.sqrt(np.mean(finite**2)))
        axes.annotate(
            f"RMS {root:.2g}·10⁻³ α", (0.995, 0.06), xycoords="axes fraction", ha="right", fontsize=8, color=INK
        )


POINTS = 181
"""Of an ellipse."""


class Region(NamedTuple):
    """
    Two quantities of one fit.

    Attributes
    ----------
    title : str
    centre : ndarray, shape (2,)
        e, and the critical angle over the one given.
    covariance : ndarray, shape (2, 2)
    """

    title: str
    centre: Array
    covariance: Array


@styled()
def joint_region(regions: Sequence[Region], *, fixed: tuple[float, float, float] | None = None) -> Figure:
    """
    Draw the ellipses inside which e and α together lie with a confidence of 50 and of 95 %.

    Parameters
    ----------
    regions : sequence of Region
        One a free vibration.
    fixed : (float, float, float), optional
        e with its interval from the fit with the given α: drawn at 1.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no region, or a covariance is not positive definite.
    """
    if not regions:
        raise ValueError("no fit was given; at least one with the critical angle freed was expected")
    figure = blank_figure(3.0)
    axes = figure.subplots()
    for region in regions:
        for level in (0.5, 0.95):
            outline = _ellipse(region, level)
            axes.plot(*outline, label=format_percent(level), color=FIT["color"], linewidth=0.6 + 0.8 * level)
            axes.fill(*outline, color=FIT["color"], alpha=0.1, linewidth=0)
        axes.plot(*region.centre, "o", color=FIT["color"], markersize=4)
        axes.annotate(
            region.title,
            (float(region.centre[0]), float(region.centre[1])),
            xytext=(5, 4),
            textcoords="offset points",
            fontsize=8,
        )
    axes.margins(0.06)
    axes.autoscale_view()
    axes.axhline(1.0, label="α as given", **LIMIT)
    if fixed is not None:
        value, low, high = fixed
        axes.errorbar(
            [value],
            [1.0],
            xerr=[[value - low], [high - value]],
            fmt="D",
            color=MEASURED["color"],
            markersize=4,
            elinewidth=1.1,
            label="e with α as given",
        )
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6))
    axes.set(xlabel="coefficient of restitution e", ylabel="α fitted / α given")
    legend_outside(figure, [axes])
    return figure


def _ellipse(region: Region, level: float) -> tuple[Array, Array]:
    """Outline inside which χ² of two degrees of freedom has a probability of `level`."""
    covariance = np.asarray(region.covariance, dtype=np.float64)
    values, vectors = np.linalg.eigh(covariance)
    if covariance.shape != (2, 2) or not values.min() > 0:
        raise ValueError(f"{region.title}: the covariance {covariance.tolist()} is not positive definite")
    turn = np.linspace(0, 2 * np.pi, POINTS)
    radius = np.sqrt(-2 * np.log(1 - level))
    x, y = region.centre[:, None] + radius * (vectors * np.sqrt(values)) @ np.array([np.cos(turn), np.sin(turn)])
    return np.asarray(x), np.asarray(y)
