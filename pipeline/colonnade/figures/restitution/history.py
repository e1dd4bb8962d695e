"""A free vibration and the free rocking that was laid through it, with what is left over."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.figures.curve import Curve, envelope
from colonnade.figures.histories import draw_angle, largest_of, limit_of, time_limits
from colonnade.figures.panels import legend_above, stacked_panels
from colonnade.figures.style import MEASURED, model_style, styled

ANGLE_HEIGHT, RESIDUAL_HEIGHT = 2.2, 0.9
"""Heights of the panels, inches."""

SMALLEST_RESIDUAL = 1e-2
"""No axis of residuals is narrower than ± this, in 10⁻³ α: rounding does not look like a finding."""


@styled()
def fitted_history(
    measured: Curve | None, fitted: Curve, residual: Curve, *, model: str, left_out: Sequence[tuple[float, float]] = ()
) -> Figure:
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
    left_out : sequence of (float, float)
        Times (s) between which the record was not fitted: shaded.

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
    axes[0].plot(*envelope(fitted), label=f"fitted, {model} model", **model_style(model))
    _draw_residual(axes[1], residual)
    for start, end in left_out:
        for one in axes:
            one.axvspan(start, end, color="#8a919c", alpha=0.15, linewidth=0, label="not fitted")
    axes[0].set_xlim(*time_limits(shown))
    axes[-1].set_xlabel("time (s)")
    legend_above(figure, axes[:1])
    return figure


def _draw_residual(axes: Axes, residual: Curve) -> None:
    residual = Curve(residual.time, 1e3 * residual.values)
    largest = max(largest_of([residual]), SMALLEST_RESIDUAL)
    axes.plot(*envelope(residual), color=MEASURED["color"], linewidth=0.7)
    axes.axhline(0.0, color="#8a919c", linewidth=0.7)
    axes.set_ylim(-1.12 * largest, 1.12 * largest)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=4, symmetric=True, steps=[1, 2, 5, 10]))
    axes.set_ylabel("measured −\nfitted (10⁻³ α)")
    finite = residual.values[np.isfinite(residual.values)]
    if finite.size:
        root = float(np.sqrt(np.mean(finite**2)))
        axes.annotate(
            f"RMS {root:.2g}·10⁻³ α", (0.995, 0.06), xycoords="axes fraction", ha="right", fontsize=8, color="#30353d"
        )
