"""Estimates of e side by side; the fitted free rocking with its residual, and the joint region of e and α."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import draw_angle, largest_of, limit_of, scale_symmetric, time_limits
from colonnade.figures.panels.curve import Curve, draw_curve
from colonnade.figures.panels.layout import add_panel, legend_above, legend_outside, note, stacked_panels
from colonnade.figures.restitution.decay import SMALLEST_RANGE, STAGE, EstimateRow, draw_rigid, level_of
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import FAINT, FIT, INK, LIMIT, MEASURED, SOFT, model_style, one_panel, styled, width
from colonnade.store.records.stored import Stored
from colonnade.units.text import format_percent, number

ROW, GROUP = 0.21, 0.26
"""Heights of an estimate's row, and of a group's title or the rigid-body value; inches."""

LEFT, RIGHT, TOP, BOTTOM = 2.05, 1.6, 0.12, 0.46
"""Room for names, for values in figures, and for the axis; inches."""

BEYOND = 8.0
"""Median widths of an interval about the median estimate that the axis shows; what is beyond has an arrow."""


Groups = Mapping[str, Sequence[EstimateRow]]
"""Estimates by what they are of: a free vibration, or all together."""

LABELS = {"history": "whole history", "peaks": "peaks, a cross-check"}
"""Of the two values of e."""


def estimate_rows(stored: Stored) -> list[EstimateRow]:
    """Return what each estimator gives of a free vibration, in the order in which they are stored."""
    values, low, high = (stored.by("estimator", STAGE, f"estimate{end}") for end in ("", "_low", "_high"))
    recommended = stored.text(STAGE, "recommended")
    reasons = stored.texts(STAGE, "estimate_reasons")
    return [
        EstimateRow(LABELS[name], values[name], low[name], high[name], name == recommended, reason)
        for name, reason in zip(values, reasons, strict=True)
    ]


def estimators(identity: str, groups: Groups, rigid: float, note: str = "") -> Picture | None:
    """Draw estimates side by side, by what they are of; None without any."""
    shown = {title: rows for title, rows in groups.items() if rows}
    if not shown:
        return None
    said = [f"{of}: {row.name} {number(row.value, 5)}." for of, rows in shown.items() for row in rows]
    title = "Estimates of e side by side, with their intervals"
    return Picture(estimators_side_by_side(shown, rigid=rigid), identity, title, " ".join(said), note)


@styled()
def estimators_side_by_side(groups: Groups, *, rigid: float) -> Figure:
    """Draw points with intervals, a row an estimate, groups below each other; `rigid` is the rigid-body value."""
    rows = [row for group in groups.values() for row in group]
    titles = sum(map(bool, groups))
    body = len(rows) * ROW + titles * GROUP + GROUP
    height = TOP + body + BOTTOM
    figure = Figure(figsize=(width(), height))
    axes = add_panel(figure, LEFT, TOP, width() - LEFT - RIGHT, body)
    axes.set(xlim=_limits(rows), ylim=(body, 0))
    axes.tick_params(axis="y", left=False, labelleft=False)
    axes.grid(visible=False, axis="y")
    place = 0.05
    for title, group in groups.items():
        if title:
            _write(axes, place + GROUP / 2, title, -LEFT + 0.1, weight="bold")
            place += GROUP
        for row in group:
            _draw_row(axes, place + ROW / 2, row, title)
            place += ROW
    if any(np.isfinite(row.value) for row in rows):
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
        draw_rigid(axes, rigid, is_across=True)
    else:
        axes.set_xticks([])
    axes.set_xlabel("coefficient of restitution e")
    return figure


def _draw_row(axes: Axes, place: float, row: EstimateRow, title: str) -> None:
    mark, size, thickness, weight = ("D", 5.0, 2.0, "bold") if row.recommended else ("o", 4.0, 1.1, "normal")
    _write(axes, place, row.name, -LEFT + 0.15, colour=FIT["color"] if row.recommended else INK)
    if not np.isfinite(row.value):
        middle = axes.get_yaxis_transform()
        note(axes, "none", (0.5, place), xycoords=middle, ha="center", va="center", color=SOFT)
        return
    colour = FIT["color"] if row.recommended else MEASURED["color"]
    label = f"{title}, {row.name}" if title else row.name
    draw_estimate(axes, row, place, label, mark=mark, size=size, thickness=thickness, colour=colour)
    low, high = axes.get_xlim()
    if not low <= row.value <= high:
        edge, arrow = (0.0, "<") if row.value < low else (1.0, ">")
        beside = axes.get_yaxis_transform()
        axes.plot([edge], [place], arrow, color=colour, markersize=size, clip_on=False, transform=beside)
    _write(axes, place, row.text, width() - LEFT - RIGHT + 0.12, weight=weight)


def draw_estimate(
    axes: Axes,
    known: EstimateRow,
    place: float,
    label: str,
    *,
    mark: str,
    size: float = 4.0,
    thickness: float = 1.1,
    colour: str = MEASURED["color"],
) -> None:
    """Draw a value with its interval along the axis of e, at a height."""
    ends = np.maximum([[known.value - known.low], [known.high - known.value]], 0.0)
    axes.errorbar(
        [known.value], [place], xerr=ends, fmt=mark, color=colour, markersize=size, elinewidth=thickness, label=label
    )


def _write(axes: Axes, place: float, text: str, left: float, *, weight: str = "normal", colour: str = INK) -> None:
    """Write at a height, `left` inches from the left edge of the panel."""
    at = (left / (width() - LEFT - RIGHT), place)
    note(axes, text, at, xycoords=axes.get_yaxis_transform(), va="center", fontweight=weight, color=colour)


def _limits(rows: Sequence[EstimateRow]) -> tuple[float, float]:
    values = np.array([row.value for row in rows if np.isfinite(row.value)])
    if not values.size:
        return 0.0, 1.0
    widths = np.array([row.high - row.low for row in rows if np.isfinite(row.high - row.low)])
    middle = float(np.median(values))
    reach = BEYOND * max(float(np.median(widths)) if widths.size else 0.0, SMALLEST_RANGE / 2)
    ends = [each for row in rows for each in (row.low, row.value, row.high) if np.isfinite(each)]
    low = max(min(ends), middle - reach)
    high = min(max(ends), middle + reach)
    margin = 0.08 * max(high - low, SMALLEST_RANGE)
    return low - margin, high + margin


ANGLE_HEIGHT, RESIDUAL_HEIGHT = 2.2, 0.9
"""Heights of the panels, inches."""

SMALLEST_RESIDUAL = 1e-2
"""No axis of residuals is narrower than ± this, in 10⁻³ α: rounding does not look like a finding."""


def fitted(one: OfTest) -> Picture | None:
    """
    Free vibration, fitted history and residual.

    Measured rocking angle and the free rocking fitted to the whole history. Lower panel: measured minus fitted.
    """
    stored = one.stored
    time, angle = (stored.array(STAGE, name) for name in ("fitted_elapsed", "fitted_history"))
    if not time.size or not angle.size:
        return None
    critical = one.block.critical_angle_at(angle)
    residual = Curve(time, stored.array(STAGE, "history_residual") / critical)
    measured = one.measured_ratio(as_recorded=True)
    rms = float(np.sqrt(np.nanmean(residual.values**2))) if np.isfinite(residual.values).any() else np.nan
    return Picture(
        fitted_history(measured, Curve(time, angle / critical), residual, rms),
        f"fitted-{one.test.id}",
        f"{one.test.id}: measured free vibration and the nonlinear model fitted to it",
        f"From {time[0]:.2f} s to {time[-1]:.2f} s the two differ by {number(rms)} α RMS.",
    )


@styled()
def fitted_history(measured: Curve | None, fitted: Curve, residual: Curve, rms: float) -> Figure:
    """Draw θ/α measured and fitted by the nonlinear model, and measured minus fitted below, where it was fitted."""
    figure, (above, below) = stacked_panels([ANGLE_HEIGHT, RESIDUAL_HEIGHT])
    shown = [curve for curve in (measured, fitted) if curve is not None]
    draw_angle(above, {} if measured is None else {"measured": measured}, limit_of(shown))
    draw_curve(above, fitted, label="fitted, nonlinear model", **model_style("nonlinear"))
    residual = Curve(residual.time, 1e3 * residual.values)
    draw_curve(below, residual, label="measured − fitted", color=MEASURED["color"], linewidth=0.7)
    below.axhline(0.0, color=FAINT, linewidth=0.7)
    scale_symmetric(below, max(largest_of([residual.values]), SMALLEST_RESIDUAL))
    below.set_ylabel("measured −\nfitted (10⁻³ α)")
    note(below, f"RMS {1e3 * rms:.2g}·10⁻³ α", (0.995, 0.06), xycoords="axes fraction", ha="right")
    above.set_xlim(*time_limits(shown))
    below.set_xlabel("time (s)")
    legend_above(figure, [above])
    return figure


POINTS = 181
"""Of an ellipse."""


def region(one: OfTest) -> Picture | None:
    """
    Joint region of e and the critical angle.

    e and critical angle as the record and what was known of the block show them together: joint regions of 50 % and
    95 %.
    """
    mean, covariance = (one.stored.array(STAGE, f"joint_{name}") for name in ("mean", "covariance"))
    if not mean.size:
        return None
    e, ratio = centre = np.exp(mean[:2])
    covariance = covariance[:2, :2] * np.outer(centre, centre)
    if not np.linalg.eigvalsh(covariance).min() > 0:
        return None
    return Picture(
        joint_region(one.test.id, centre, covariance, fixed=level_of(one.stored, STAGE, "")),
        f"region-{one.test.id}",
        f"{one.test.id}: joint region of e and the critical angle",
        f"Together: e = {e:.4f}, α {ratio:.4f} times that given.",
    )


@styled()
def joint_region(title: str, centre: Array, covariance: Array, *, fixed: EstimateRow) -> Figure:
    """
    Draw the ellipses inside which e and α together lie with a confidence of 50 and of 95 %.

    `centre` is e and the critical angle over the one given, `covariance` that of both, positive definite; `fixed` is e
    from the fit with the given α: drawn at 1 if it is known with its interval.
    """
    figure, axes = one_panel(3.0)
    for level in (0.5, 0.95):
        outline = _ellipse(centre, covariance, level)
        axes.plot(*outline, label=format_percent(level), color=FIT["color"], linewidth=0.6 + 0.8 * level)
        axes.fill(*outline, color=FIT["color"], alpha=0.1, linewidth=0)
    axes.plot(*centre, "o", color=FIT["color"], markersize=4)
    note(axes, title, (float(centre[0]), float(centre[1])), (5, 4))
    axes.margins(0.06)
    axes.autoscale_view()
    axes.axhline(1.0, label="α as given", **LIMIT)
    if np.isfinite((fixed.value, fixed.low, fixed.high)).all():
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
