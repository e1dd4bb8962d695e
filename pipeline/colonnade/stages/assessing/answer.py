"""The answer about a real column, from the curves of its outcomes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from colonnade.assessment.cases.cases import FALLS_AWAY, Outcomes
from colonnade.assessment.fragility.lognormal import LognormalFit
from colonnade.assessment.fragility.resampling import Interval
from colonnade.assessment.fragility.summary import Fragility
from colonnade.campaign.assessing.assessed import (
    AssessmentSummary,
    DecidingRecord,
    Estimate,
    JudgedMeasure,
    RecordLeftOut,
    RecordUsed,
    Variant,
)
from colonnade.dynamics.block import pair
from colonnade.stages.assessing.criteria import judged_criteria
from colonnade.stages.assessing.plan import ASSUMED, Plan
from colonnade.units import format_percent

MISFITS = 0.05
"""p-value below which the lognormal curve is not taken."""

MOST_DECIDING = 5
"""Records that are named as those that decide."""

NO_CURVE = {
    "separated": "no record overturns at a level at which another stands, so that the levels show a step and no spread",
    "falling": "fewer histories overturn at higher levels",
    "never": "nothing overturns at any level",
    "always": "everything overturns at every level",
    "one intensity": "there is one level only",
}
"""Why there is no lognormal curve, by the fit's own reason."""


def answer(
    plan: Plan, outcomes: Outcomes, fragilities: Mapping[str, Fragility], sliding: float | None
) -> AssessmentSummary:
    """
    Gather the answer.

    Parameters
    ----------
    plan : Plan
    outcomes : Outcomes
        Of the study as assumed.
    fragilities : mapping of str to Fragility
        Of each study.
    sliding : float or None
        Share of the histories that need more friction than there is.

    Returns
    -------
    answer : AssessmentSummary
    """
    study, found = plan.studies[ASSUMED], fragilities[ASSUMED]
    column, lognormal = study.cases.prototype, found.lognormal
    why = _why_not(found)
    five, fifty = (
        _estimate(found.isotonic.reaches(share)) if why else _at_lognormal(lognormal, share) for share in (0.05, 0.5)
    )
    limits = column.restitution_range or (None, None)
    rate = found.rate
    return AssessmentSummary(
        status="done",
        warnings=tuple(_warnings(plan, outcomes, found, sliding)),
        specimen=plan.inputs.specimen,
        measure=study.measure.id,
        unit=study.measure.unit,
        critical_angle=column.block.critical_angle,
        p=column.block.p,
        restitution=Estimate(value=float(np.mean(pair(column.restitution))), low=limits[0], high=limits[1]),
        restitution_source=plan.restitution_source,
        uplift_acceleration=column.block.uplift_acceleration,
        uplift=Estimate() if found.uplift.curve is None else _estimate(found.uplift.curve.median),
        median=_estimate(lognormal.median),
        dispersion=_estimate(lognormal.beta),
        dispersion_records=found.betas.records.value,
        dispersion_parameters=found.betas.parameters.value,
        five_percent=five,
        fifty_percent=fifty,
        curve="isotonic" if why else "lognormal",
        curve_reason=why or None,
        misfit=found.misfit.p_value,
        resurrected=found.resurrection.lost,
        sliding=sliding,
        annual_rate=Estimate() if rate is None else _estimate(rate.rate),
        probability_50_years=Estimate() if rate is None else _estimate(rate.in_50_years),
        rate_outside=None if rate is None else rate.below_hazard + rate.above_hazard,
        variants=tuple(_variant(plan, name, each) for name, each in fragilities.items() if name != ASSUMED),
        measures=_measures(found),
        criteria=judged_criteria(
            study, outcomes, drift=plan.inputs.asked.drift, overturned=plan.inputs.asked.overturned
        ),
        deciding=_deciding(found),
        records_used=_used(plan),
        records_left_out=_left_out(plan),
    )


def _estimate(interval: Interval) -> Estimate:
    # 0 and infinity stand for what lies beyond the levels.
    value, low, high = (float(each) if 0.0 < each < np.inf else None for each in interval)
    return Estimate(value=value, low=low, high=high)


def _why_not(found: Fragility) -> str:
    """Say why the lognormal curve is not taken; empty if it is."""
    if found.lognormal.reason:
        return NO_CURVE[found.lognormal.reason]
    if found.misfit.p_value < MISFITS:
        return f"the lognormal curve does not fit (p = {found.misfit.p_value:.2g})"
    return ""


def _at_lognormal(fit: LognormalFit, share: float) -> Estimate:
    """Intensity at which the lognormal curve reaches a share."""
    return _estimate(Interval(*(float(each[0]) for each in fit.intensity([share]))))


def _variant(plan: Plan, name: str, found: Fragility) -> Variant:
    fit = found.lognormal
    return Variant(
        name=name,
        restitution=float(np.mean(pair(plan.studies[name].cases.prototype.restitution))),
        median=Estimate() if fit.reason else _estimate(fit.median),
        five_percent=Estimate() if fit.reason else _at_lognormal(fit, 0.05),
        reason=NO_CURVE[fit.reason] if fit.reason else None,
    )


def _measures(found: Fragility) -> tuple[JudgedMeasure, ...]:
    if found.measures is None:
        return ()
    return tuple(
        JudgedMeasure(
            measure=each.name,
            deviance=each.deviance,
            auc=each.auc,
            scatter=each.scatter,
            best=each.best_deviance,
            magnitude=None if each.on_magnitude is None else each.on_magnitude.p_value,
            distance=None if each.on_log_distance is None else each.on_log_distance.p_value,
        )
        for each in found.measures.scores
    )


def _deciding(found: Fragility) -> tuple[DecidingRecord, ...]:
    if found.lognormal.reason:
        return ()
    without = found.influence
    rates = [None] * len(without.records) if without.rate is None else without.rate.tolist()
    rows = zip(without.records, without.median.tolist(), rates, strict=True)
    return tuple(DecidingRecord(record=name, median=median, annual_rate=rate) for name, median, rate in rows)[
        :MOST_DECIDING
    ]


def _used(plan: Plan) -> tuple[RecordUsed, ...]:
    study, known = plan.studies[ASSUMED], {each.name: each for each in plan.records.records}
    return tuple(
        RecordUsed(
            record=name,
            files=dict(known[name].files),
            components=known[name].components,
            drift=float(study.drift[row]),
            measures={each: float(values[row, 0]) for each, values in study.values.items()},
        )
        for row, name in enumerate(study.names)
    )


def _left_out(plan: Plan) -> tuple[RecordLeftOut, ...]:
    named = [(each.name, each.reason.removeprefix(f"{each.name}: ")) for each in plan.records.left_out]
    return tuple(
        RecordLeftOut(record=name, reason=reason) for name, reason in (*named, *plan.studies[ASSUMED].left_out.items())
    )


def _warnings(plan: Plan, outcomes: Outcomes, found: Fragility, sliding: float | None) -> list[str]:
    """Say what is doubtful, the gravest first."""
    said, left_out = [], _left_out(plan)
    if sliding:
        said.append(
            f"In {format_percent(sliding)} of the histories the column would slide: it needs more friction than there "
            "is. There the answer does not hold."
        )
    if left_out:
        first = left_out[0]
        others = "" if len(left_out) == 1 else f" and {len(left_out) - 1} more"
        said.append(f"Left out: {first.record}{others}. {first.record}: {first.reason.splitlines()[0]}")
    if (falling := int((outcomes.outcome == FALLS_AWAY).sum())) > 0:
        said.append(
            f"{falling} histories are not run: their base falls faster than the column. Their levels are too high."
        )
    rate = found.rate
    if rate is not None and rate.is_extrapolated:
        said.append(
            f"{format_percent(rate.below_hazard + rate.above_hazard)} of the annual rate is from outside the hazard "
            f"curve, and {format_percent(rate.below_levels + rate.above_levels)} from outside the levels."
        )
    if plan.hazard is not None and rate is None:
        said.append("There is a hazard, and no annual rate: that needs a lognormal curve.")
    if found.lognormal.degenerate > 0.05:
        said.append(
            f"{format_percent(found.lognormal.degenerate)} of the resamples of records have no curve: the intervals "
            "are of the others. More records would help."
        )
    return said
