"""Pictures of restitution: fitted history, peaks, e of each impact, estimators side by side, region of e and α."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.errors import count
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.curve import Curve
from colonnade.figures.restitution.estimators import (
    EstimateGroup,
    EstimateRow,
    estimators_side_by_side,
    fitted_history,
    joint_region,
)
from colonnade.figures.restitution.impacts import ImpactSeries, Level, impact_restitution
from colonnade.figures.restitution.peaks import PeakSeries, peak_decay
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import shortened
from colonnade.identification.restitution.peaks import confidence_band
from colonnade.store.records.stored import Stored
from colonnade.units.text import number

STAGE = "restitution"

LABELS = {"history": "whole history", "peaks": "peaks, a cross-check"}
"""Of the two values of e."""

LONGEST_NAME = 26
"""Letters of a test's name above a panel."""


def estimate_rows(stored: Stored) -> list[EstimateRow]:
    """Return what each estimator gives of a free vibration, in the order in which they are stored."""
    values, low, high = (stored.by("estimator", STAGE, f"estimate{end}") for end in ("", "_low", "_high"))
    recommended = stored.text(STAGE, "recommended")
    assumptions, reasons = (stored.texts(STAGE, f"estimate_{each}") for each in ("assumptions", "reasons"))
    return [
        EstimateRow(LABELS[name], values[name], low[name], high[name], name == recommended, *texts)
        for name, *texts in zip(values, assumptions, reasons, strict=True)
    ]


def fitted(one: OfTest) -> Picture | None:
    """Draw the measured angle, the history fitted to it and the residual; None if none was fitted."""
    stored = one.stored
    time, angle = (stored.array(STAGE, name) for name in ("fitted_elapsed", "fitted_history"))
    if not time.size or not angle.size:
        return None
    critical = one.block.critical_angle_at(angle)
    residual = Curve(time, stored.array(STAGE, "history_residual") / critical)
    model = stored.text(STAGE, "history_model")
    measured = one.measured_ratio(as_recorded=True)
    rms = float(np.sqrt(np.nanmean(residual.values**2))) if np.isfinite(residual.values).any() else np.nan
    return Picture(
        fitted_history(measured, Curve(time, angle / critical), residual, model=model),
        f"fitted-{one.test.id}",
        f"{one.test.id}: measured free vibration and the {model} model fitted to it",
        f"From {time[0]:.2f} s to {time[-1]:.2f} s the two differ by {number(rms)} α RMS.",
    )


def peak_series(one: OfTest) -> PeakSeries | None:
    """Return the peaks of a free vibration, None if none were found."""
    angle, error, fit, used = _columns(one, "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
    if not angle.size:
        return None
    used = used == 1
    band = confidence_band(angle, error, used & np.isfinite(fit), one.block)
    return PeakSeries(shortened(one.test.id, LONGEST_NAME), angle, error, fit, used, band)


def peaks(identity: str, series: Sequence[PeakSeries], block: Block, note: str = "") -> Picture | None:
    """Draw the peaks of free vibrations with their fits; None without any."""
    if not series:
        return None
    described = [f"{one.title}: {int(one.used.sum())} of {count(one.used.size, 'peak')} used." for one in series]
    title = "Energy of successive peaks against the impact number, with the fitted line and its band"
    return Picture(peak_decay(series, block), identity, title, " ".join(described), note)


def impact_series(one: OfTest) -> ImpactSeries | None:
    """Return e of each impact of a free vibration, or None without impacts."""
    names = ("velocity", "restitution", "restitution_standard_error", "used")
    velocity, restitution, error, used = _columns(one, *(f"impact_{name}" for name in names))
    if not restitution.size:
        return None
    return ImpactSeries(shortened(one.test.id, LONGEST_NAME), velocity, restitution, error, used == 1)


def impacts(
    identity: str, series: Sequence[ImpactSeries], level: Level, rigid: float, note: str = ""
) -> Picture | None:
    """Draw e of each impact against its speed, with the value and interval identified from all; None without any."""
    if not series:
        return None
    used, total = sum(int(one.used.sum()) for one in series), sum(one.used.size for one in series)
    return Picture(
        impact_restitution(series, level=level, rigid=rigid),
        identity,
        "e of each impact against the angular velocity before it",
        f"{used} of {count(total, 'impact')} used. {level.name}: {number(level.value, 4)}.",
        note,
    )


def estimators(identity: str, groups: Sequence[EstimateGroup], rigid: float, note: str = "") -> Picture | None:
    """Draw estimators side by side; None without any estimate."""
    shown = [group for group in groups if group.rows]
    if not shown:
        return None
    said = [f"{group.title}: {row.name} {number(row.value, 5)}." for group in shown for row in group.rows]
    title = "Estimates of e side by side, with their intervals"
    return Picture(estimators_side_by_side(shown, rigid=rigid), identity, title, " ".join(said), note)


def region(one: OfTest) -> Picture | None:
    """Draw the joint region of e and the critical angle; None if the angle was not freed."""
    names = ("restitution", "critical_angle", "restitution_error", "critical_angle_error", "correlation")
    e, ratio, e_error, ratio_error, correlation = (one.stored.value(STAGE, f"region_{name}") for name in names)
    both = correlation * e_error * ratio_error
    covariance = np.array([[e_error**2, both], [both, ratio_error**2]])
    if not (np.isfinite(covariance).all() and np.linalg.eigvalsh(covariance).min() > 0):
        return None
    return Picture(
        joint_region(one.test.id, np.array([e, ratio]), covariance, fixed=level_of(one.stored, STAGE, "")),
        f"region-{one.test.id}",
        f"{one.test.id}: joint region of e and the critical angle",
        f"Together: e = {e:.4f}, α {ratio:.4f} times that given.",
    )


def level_of(stored: Stored, stage: str, name: str) -> Level:
    """Return the e that a stage identified, with its interval, as a figure shows it; NaN if it is not known."""
    value, low, high = (stored.value(stage, f"restitution{end}") for end in ("", "_low", "_high"))
    return Level(value, low, high, name)


def _columns(one: OfTest, *names: str) -> list[Array]:
    return [one.stored.array(STAGE, name) for name in names]
