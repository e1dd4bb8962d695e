"""A free vibration, the free rocking that was fitted to it, and the residual."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from colonnade.figures.histories import draw_angle, largest_of, limit_of, scale_symmetric, time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import legend_above, stacked_panels
from colonnade.figures.panels.long import draw_curve
from colonnade.figures.style import FAINT, INK, MEASURED, model_style, styled

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
