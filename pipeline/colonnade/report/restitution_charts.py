"""The report's pictures of restitution: fitted histories, peaks, impacts, estimators side by side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from colonnade import figures
from colonnade.campaign import Test
from colonnade.dynamics.block import Block
from colonnade.figures import Curve, EstimateGroup, EstimateRow, ImpactSeries, Level, PeakSeries, Region
from colonnade.identification.restitution.decay_band import decay_band
from colonnade.report import charts, restitution, wording
from colonnade.report.results import Results

STAGE = restitution.STAGE

MOST_SIDE_BY_SIDE = 12
"""Free vibrations of a specimen of which each has its estimators drawn; of more, the recommended ones alone."""


def fitted(test: Test, results: Results, block: Block) -> Markup | None:
    """Draw the measured angle, the history fitted to it and what is left over; None where none was fitted."""
    found = results.datasets.get(STAGE)
    if found is None or "fitted_history" not in found or not found.sizes.get("fitted_elapsed", 0):
        return None
    time, angle = found["fitted_elapsed"].to_numpy(), found["fitted_history"].to_numpy()
    critical = np.where(angle < 0, block.negative.critical_angle, block.positive.critical_angle)
    residual = Curve(time, found["history_residual"].to_numpy() / critical)
    model = results.text(STAGE, "history_model")
    figure = figures.fitted_history(
        charts.measured_ratio(results, block, as_recorded=True), Curve(time, angle / critical), residual, model=model
    )
    left = residual.values[np.isfinite(residual.values)]
    rms = float(np.sqrt(np.mean(left**2))) if left.size else np.nan
    return Markup(
        figures.to_svg(
            figure,
            identity=f"fitted-{test.id}",
            title=f"{test.id}: measured free vibration and the {model} model fitted to it",
            description=f"From {time[0]:.2f} s to {time[-1]:.2f} s the two differ by {wording.number(rms)} α RMS.",
        )
    )


def peak_series(test: Test, results: Results, block: Block) -> PeakSeries | None:
    """Return the peaks of a free vibration, None where none were found."""
    found = results.datasets.get(STAGE)
    if found is None or not found.sizes.get("peak", 0):
        return None
    angle, error = found["peak_angle"].to_numpy(), found["peak_angle_standard_error"].to_numpy()
    used = found["peak_used"].to_numpy() == 1
    fit = found["fitted_angle"].to_numpy()
    return PeakSeries(
        _short(test.id), angle, error, fit, used, decay_band(angle, error, used & np.isfinite(fit), block)
    )


def peaks(identity: str, series: Sequence[PeakSeries], block: Block) -> Markup:
    """Draw the peaks of free vibrations with their fits."""
    described = [f"{one.title}: {int(one.used.sum())} of {one.used.size} peaks used." for one in series]
    return Markup(
        figures.to_svg(
            figures.peak_decay(series, block),
            identity=identity,
            title="Energy of successive peaks against the impact number, with the fitted line and its band",
            description=" ".join(described),
        )
    )


def impact_series(test: Test, results: Results) -> ImpactSeries | None:
    """Return e of each impact of a free vibration, None where there is none."""
    found = results.datasets.get(STAGE)
    if found is None or "impact_restitution" not in found or not found.sizes.get("impact", 0):
        return None
    return ImpactSeries(
        _short(test.id),
        found["impact_velocity"].to_numpy(),
        found["impact_restitution"].to_numpy(),
        found["impact_restitution_standard_error"].to_numpy(),
        found["impact_used"].to_numpy() == 1,
    )


def impacts(identity: str, series: Sequence[ImpactSeries], results: Results, stage: str, rigid: float) -> Markup:
    """Draw e of each impact against its speed, with the value and interval that a stage's results give."""
    value, low, high = (
        np.nan if found is None else found
        for found in (results.value(stage, f"restitution{end}") for end in ("", "_low", "_high"))
    )
    name = "e pooled" if stage == "specimen" else "e identified"
    figure = figures.impact_restitution(series, level=Level(value, low, high, name), rigid=rigid)
    used = sum(int(one.used.sum()) for one in series)
    total = sum(one.used.size for one in series)
    return Markup(
        figures.to_svg(
            figure,
            identity=identity,
            title="e of each impact against the angular velocity before it",
            description=f"{used} of {total} impacts used. {name}: {wording.number(value, 4)}.",
        )
    )


def estimators(identity: str, groups: Sequence[EstimateGroup], rigid: float) -> Markup | None:
    """Draw estimators side by side; None where there is no estimate."""
    shown = [group for group in groups if group.rows]
    if not shown:
        return None
    if len(shown) > MOST_SIDE_BY_SIDE:
        chosen = [row._replace(name=group.title) for group in shown for row in group.rows if row.recommended]
        shown = [EstimateGroup("recommended of each", chosen)] if chosen else shown[:MOST_SIDE_BY_SIDE]
    told = [f"{group.title}: {row.name} {wording.number(row.value, 5)}." for group in shown for row in group.rows]
    return Markup(
        figures.to_svg(
            figures.estimators_side_by_side(shown, rigid=rigid),
            identity=identity,
            title="Estimates of e side by side, with their intervals",
            description=" ".join(told),
        )
    )


def pooled_row(pooled: Results) -> EstimateRow | None:
    """Return the pooled value of a specimen as a row; None where it was not identified."""
    value, low, high = (pooled.value("specimen", f"restitution{end}") for end in ("", "_low", "_high"))
    if value is None or low is None or high is None or not np.isfinite(low):
        return None
    return EstimateRow("pooled", value, low, high, recommended=True)


def region(test: Test, results: Results) -> Markup | None:
    """Draw the joint region of e and the critical angle; None where the angle was not freed."""
    names = ("restitution", "critical_angle", "restitution_error", "critical_angle_error", "correlation")
    e, ratio, e_error, ratio_error, correlation = (
        np.nan if found is None else found for found in (results.value(STAGE, f"region_{name}") for name in names)
    )
    both = correlation * e_error * ratio_error
    covariance = np.array([[e_error**2, both], [both, ratio_error**2]])
    if not (np.isfinite(covariance).all() and np.linalg.eigvalsh(covariance).min() > 0):
        return None
    value, low, high = (results.value(STAGE, f"restitution{end}") for end in ("", "_low", "_high"))
    fixed = (value, low, high) if value is not None and low is not None and high is not None else None
    fixed = fixed if fixed is not None and np.isfinite(fixed).all() else None
    drawn = figures.joint_region([Region(test.id, np.array([e, ratio]), covariance)], fixed=fixed)
    return Markup(
        figures.to_svg(
            drawn,
            identity=f"region-{test.id}",
            title=f"{test.id}: joint region of e and the critical angle",
            description=f"With the critical angle freed: e = {e:.4f}, α {ratio:.4f} times that given.",
        )
    )


def _short(name: str, longest: int = 26) -> str:
    return name if len(name) <= longest else f"{name[: longest - 1]}…"
