"""A free vibration, the fitted free rocking, the residual, and the joint region of e and α that it leaves."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.figures.histories import draw_angle, largest_of, limit_of, scale_symmetric, time_limits
from colonnade.figures.panels.curve import Curve, draw_curve
from colonnade.figures.panels.layout import legend_above, legend_outside, note, stacked_panels
from colonnade.figures.restitution.estimators import draw_estimate
from colonnade.figures.restitution.impacts import Level
from colonnade.figures.style import FAINT, FIT, LIMIT, MEASURED, blank_figure, model_style, styled
from colonnade.units.text import format_percent

ANGLE_HEIGHT, RESIDUAL_HEIGHT = 2.2, 0.9
"""Heights of the panels, inches."""

SMALLEST_RESIDUAL = 1e-2
"""No axis of residuals is narrower than ± this, in 10⁻³ α: rounding does not look like a finding."""


@styled()
def fitted_history(measured: Curve | None, fitted: Curve, residual: Curve, *, model: str) -> Figure:
    """Draw θ/α measured and fitted by a model, and measured minus fitted below, over the part that was fitted."""
    figure, (above, below) = stacked_panels([ANGLE_HEIGHT, RESIDUAL_HEIGHT])
    shown = [curve for curve in (measured, fitted) if curve is not None]
    draw_angle(above, {} if measured is None else {"measured": measured}, limit_of(shown))
    draw_curve(above, fitted, label=f"fitted, {model} model", **model_style(model))
    residual = Curve(residual.time, 1e3 * residual.values)
    draw_curve(below, residual, label="measured − fitted", color=MEASURED["color"], linewidth=0.7)
    below.axhline(0.0, color=FAINT, linewidth=0.7)
    scale_symmetric(below, max(largest_of([residual]), SMALLEST_RESIDUAL))
    below.set_ylabel("measured −\nfitted (10⁻³ α)")
    if np.isfinite(residual.values).any():
        root = float(np.sqrt(np.nanmean(residual.values**2)))
        note(below, f"RMS {root:.2g}·10⁻³ α", (0.995, 0.06), xycoords="axes fraction", ha="right")
    above.set_xlim(*time_limits(shown))
    below.set_xlabel("time (s)")
    legend_above(figure, [above])
    return figure


POINTS = 181
"""Of an ellipse."""


@styled()
def joint_region(title: str, centre: Array, covariance: Array, *, fixed: Level) -> Figure:
    """
    Draw the ellipses inside which e and α together lie with a confidence of 50 and of 95 %.

    `centre` is e and the critical angle over the one given, `covariance` that of both, positive definite; `fixed` is e
    from the fit with the given α: drawn at 1 if it is known with its interval.
    """
    figure = blank_figure(3.0)
    axes = figure.subplots()
    for level in (0.5, 0.95):
        outline = _ellipse(centre, covariance, level)
        axes.plot(*outline, label=format_percent(level), color=FIT["color"], linewidth=0.6 + 0.8 * level)
        axes.fill(*outline, color=FIT["color"], alpha=0.1, linewidth=0)
    axes.plot(*centre, "o", color=FIT["color"], markersize=4)
    note(axes, title, (float(centre[0]), float(centre[1])), (5, 4))
    axes.margins(0.06)
    axes.autoscale_view()
    axes.axhline(1.0, label="α as given", **LIMIT)
    if np.isfinite(fixed[:3]).all():
        draw_estimate(axes, fixed, 1.0, "e with α as given", mark="D")
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6))
    axes.set(xlabel="coefficient of restitution e", ylabel="α fitted / α given")
    legend_outside(figure, [axes])
    return figure


def _ellipse(centre: Array, covariance: Array, level: float) -> Array:
    """Outline inside which χ² of two degrees of freedom has a probability of `level`."""
    turn = np.linspace(0, 2 * np.pi, POINTS)
    radius = np.sqrt(-2 * np.log(1 - level))
    values, vectors = np.linalg.eigh(covariance)
    circle = np.array([np.cos(turn), np.sin(turn)])
    return np.asarray(centre[:, None] + radius * (vectors * np.sqrt(values)) @ circle)
