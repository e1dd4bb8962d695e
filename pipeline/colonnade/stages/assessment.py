"""Assessment: the outcomes of a real column on scaled ground motions -> how probably it overturns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from colonnade.arrays import Array, Dataset, dataset
from colonnade.assessment.cases import (
    AXES,
    COMPONENTS,
    FALLS_AWAY,
    NOT_RUN,
    CaseOutcomes,
    components,
    friction_needed,
)
from colonnade.assessment.criteria import CRITERIA, Demands, agreement, spectral_velocity
from colonnade.assessment.fragility import Fragility
from colonnade.assessment.ground import Ground
from colonnade.assessment.hazard import LARGEST_SHARE
from colonnade.assessment.intervals import Interval, Resampling
from colonnade.assessment.real_column import UNCERTAIN
from colonnade.assessment.study import Study, counted_draws, judge
from colonnade.campaign.forms.assessed import (
    UNCORRECTED,
    AssessmentSummary,
    DecidingRecord,
    Estimate,
    JudgedCriterion,
    JudgedMeasure,
    RecordLeftOut,
    RecordUsed,
    Variant,
)
from colonnade.dynamics.spectra import response_spectrum
from colonnade.errors import StageError
from colonnade.findings import warning
from colonnade.stages.assessment_plan import ASSUMED, Plan
from colonnade.units.text import format_percent

CURVE = 101
"""Points at which the lognormal curve is stored, over the levels and half as far beyond either end."""


PERIODS = np.geomspace(0.05, 5.0, 41)
"""s, of the response spectra of the records."""


def assessment(plan: Plan, outcomes: Mapping[str, CaseOutcomes]) -> Dataset:
    """
    Judge the histories of an assessment.

    Parameters
    ----------
    plan : Plan
    outcomes : mapping of str to CaseOutcomes
        Of each of its studies.

    Returns
    -------
    result : Dataset
        Outcomes over the axes `AXES`, the drawn columns, the friction needed, and the curves over the measure; the
        attribute `answer` is an `AssessmentSummary` as JSON.

    Raises
    ------
    StageError
        If the outcomes allow no answer.
    """
    about = {each.name: each for each in plan.records.records}
    asked, found = plan.inputs.asked, {}
    resampling = Resampling(asked.resamples, asked.seed)
    try:
        for name, study in plan.studies.items():
            magnitude, distance = (
                np.array([getattr(about[record], key) for record in study.names], dtype=np.float64)
                for key in ("magnitude", "distance")
            )
            known: dict[str, Any] = {"hazard": plan.hazard, "magnitude": magnitude, "distance": distance}
            found[name] = judge(study, outcomes[name], resampling, overturned=asked.overturned, **known)
    except ValueError as error:
        raise StageError(str(error)) from error
    needed = None if plan.inputs.several else friction_needed(plan.studies[ASSUMED].cases)
    said = _answer(plan, outcomes[ASSUMED], found, _sliding(plan, outcomes[ASSUMED], needed))
    result = _dataset(plan, outcomes[ASSUMED], needed, found[ASSUMED])
    return result.assign_attrs(
        answer=said.model_dump_json(),
        measure_asked=f"{said.measure} [{said.unit}]",
        warnings=[warning("assessment", text) for text in said.warnings],
    )


def _sliding(plan: Plan, outcomes: CaseOutcomes, needed: Array | None) -> float | None:
    """Share of the histories that need more friction than there is; None if none is given, or bodies do slide."""
    cases = plan.studies[ASSUMED].cases
    if cases.column.friction is None or needed is None:
        return None
    drawn = counted_draws(cases.shape[2])
    run, friction = outcomes.is_run[:, :, drawn], cases.drawn("friction")[:, drawn]
    slides = ~(needed[:, :, None] <= friction[:, None, :, None, None])
    return float((slides & run).sum() / run.sum())


def _dataset(plan: Plan, outcomes: CaseOutcomes, needed: Array | None, fragility: Fragility) -> Dataset:
    study, isotonic = plan.studies[ASSUMED], fragility.isotonic
    reach = np.sqrt(study.levels[-1] / study.levels[0])
    over = np.geomspace(study.levels[0] / reach, study.levels[-1] * reach, CURVE)
    # Pseudo-acceleration of the components as recorded, m/s².
    spectra = np.full((len(study.names), len(COMPONENTS), PERIODS.size), np.nan)
    for record, place, along in components(study.cases.motions):
        spectra[record, place] = response_spectrum(along.acceleration, along.dt, PERIODS)
    lognormal = fragility.lognormal.probability(over)
    variables: dict[str, Any] = {f"drawn_{name}": (("record", "draw"), study.cases.drawn(name)) for name in UNCERTAIN}
    for end, of_lognormal, of_isotonic in zip(("", "_low", "_high"), lognormal, isotonic.probability, strict=True):
        variables[f"lognormal_probability{end}"] = "curve", of_lognormal
        variables[f"isotonic_probability{end}"] = "stripe", of_isotonic
    if needed is not None:
        variables["case_friction"] = (("record", "level", "sign", "component"), needed)
    return dataset(
        {
            "case_outcome": (AXES, outcomes.outcome),
            "case_overturned": (AXES, outcomes.exceeds(plan.inputs.asked.overturned).astype(np.int8)),
            "case_peak_ratio": (AXES, outcomes.peak_ratio),
            "case_factor": (("record", "level", "component"), study.cases.factors),
            "curve_intensity": ("curve", over),
            "stripe_intensity": ("stripe", isotonic.intensity),
            "record_spectrum": (("record", "component", "period"), spectra),
            **variables,
        },
        coords={
            "record": np.array(study.names, dtype=object),
            "level_intensity": ("level", study.levels),
            "component": np.array(COMPONENTS, dtype=object),
            "spectrum_period": ("period", PERIODS),
        },
    )


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


def _answer(
    plan: Plan, outcomes: CaseOutcomes, fragilities: Mapping[str, Fragility], sliding: float | None
) -> AssessmentSummary:
    """Gather the answer: outcomes of the study as assumed, fragility of each, share that would slide."""
    study, found, column = plan.studies[ASSUMED], fragilities[ASSUMED], plan.studies[ASSUMED].cases.column
    rate, asked = found.rate, plan.inputs.asked
    one = plan.inputs.several is None
    low, high = column.restitution_range or (None, None)
    left_out, misfits = _left_out(plan), f"the lognormal curve does not fit (p = {found.misfit:.2g})"
    return AssessmentSummary(
        status="done",
        warnings=tuple(_doubts(plan, outcomes, found, sliding, left_out)),
        specimen=plan.inputs.specimen,
        measure=study.measure.id,
        unit=study.measure.unit,
        critical_angle=column.block.critical_angle,
        critical_angle_range=column.critical_angle_range,
        p=column.block.p,
        p_range=column.p_range,
        restitution=Estimate(value=column.central[0], low=low, high=high) if one else Estimate(),
        restitution_source=plan.restitution_source if one else None,
        displaced=asked.displaced,
        friction=column.friction,
        friction_range=column.friction_range,
        uplift_acceleration=column.block.uplift_acceleration,
        baseline=asked.baseline,
        uplift=_estimate(found.uplift.median),
        median=_estimate(found.lognormal.median),
        dispersion=_estimate(found.lognormal.beta),
        dispersion_records=found.betas.records,
        dispersion_parameters=found.betas.parameters,
        five_percent=_estimate(found.reaches(0.05)),
        fifty_percent=_estimate(found.reaches(0.5)),
        curve=found.taken,
        curve_reason=None if found.taken == "lognormal" else NO_CURVE.get(found.lognormal.reason, misfits),
        misfit=found.misfit,
        resurrected=found.resurrected,
        sliding=sliding,
        annual_rate=_estimate(None if rate is None else rate.rate),
        probability_50_years=_estimate(None if rate is None else rate.in_50_years),
        annual_rate_isotonic=None if rate is None else rate.isotonic,
        rate_outside=None if rate is None else rate.outside_hazard,
        variants=tuple(_variants(plan, fragilities)),
        measures=tuple(JudgedMeasure(**vars(each)) for each in found.measures),
        criteria=_judged_criteria(study, outcomes, drift=asked.drift, overturned=asked.overturned),
        deciding=_deciding(found),
        records_used=_used(plan),
        records_left_out=left_out,
        notes=tuple(plan.records.notes),
    )


def _estimate(interval: Interval | None) -> Estimate:
    if interval is None:
        return Estimate()
    # 0 and infinity stand for what lies beyond the levels.
    value, low, high = (float(each) if 0.0 < each < np.inf else None for each in interval)
    beyond: Literal["below", "above"] | None = None
    if value is None and not np.isnan(interval.value):
        beyond = "below" if interval.value == 0.0 else "above"
    return Estimate(value=value, low=low, high=high, beyond=beyond)


def _variants(plan: Plan, fragilities: Mapping[str, Fragility]) -> Iterator[Variant]:
    """Give the answer under each other assumption; of the records without their correction at least the reason."""
    for name, found in list(fragilities.items())[1:]:
        fit, e = found.lognormal, plan.studies[name].cases.column.central[0]
        common: dict[str, Any] = {"name": name, "restitution": e, "records": len(found.outcomes.records)}
        if fit.reason:
            yield Variant(**common, reason=NO_CURVE[fit.reason])
        else:
            yield Variant(**common, median=_estimate(fit.median), five_percent=_estimate(fit.reaches(0.05)))
    if plan.without_correction:
        e = plan.studies[ASSUMED].cases.column.central[0]
        yield Variant(name=UNCORRECTED, restitution=e, reason=plan.without_correction)


def _deciding(found: Fragility) -> tuple[DecidingRecord, ...]:
    if found.lognormal.reason:
        return ()
    return tuple(
        DecidingRecord(record=each.record, median=each.median, annual_rate=each.rate)
        for each in found.influence[:MOST_DECIDING]
    )


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
    """Name the files, records and components that are not used, with the reason."""
    reasons = [*plan.records.left_out.items(), *plan.studies[ASSUMED].left_out.items()]
    return tuple(RecordLeftOut(record=name, reason=reason) for name, reason in reasons)


def _doubts(
    plan: Plan,
    outcomes: CaseOutcomes,
    found: Fragility,
    sliding: float | None,
    left_out: Sequence[RecordLeftOut],
) -> Iterator[str]:
    """Say what is doubtful, the gravest first."""
    rate = found.rate
    if plan.inputs.prototype.restitution == "identified" and plan.restitution_source == "rigid-body":
        yield "No e is identified on the model. That of a rigid body is assumed."
    if sliding:
        yield (
            f"In {format_percent(sliding)} of the histories the column would slide: it needs more friction than there "
            "is. There the answer does not hold."
        )
    if (falling := float((outcomes.outcome == FALLS_AWAY).sum() / (outcomes.outcome != NOT_RUN).sum())) > 0.0:
        yield (
            f"{format_percent(falling)} of the histories are not run, and do not count: their base falls faster than "
            "the column. Their levels are too high."
        )
    if left_out:
        first, others = left_out[0], "" if len(left_out) == 1 else f" and {len(left_out) - 1} more"
        yield f"Left out: {first.record}{others}. {first.record}: {first.reason.splitlines()[0]}"
    if found.lognormal.no_interval:
        yield found.lognormal.no_interval
    if rate is not None and max(rate.outside_hazard, rate.outside_levels) > LARGEST_SHARE:
        yield (
            f"{format_percent(rate.outside_hazard)} of the annual rate is from outside the hazard curve, and "
            f"{format_percent(rate.outside_levels)} from outside the levels."
        )


def _judged_criteria(
    study: Study, outcomes: CaseOutcomes, *, drift: float, overturned: float
) -> tuple[JudgedCriterion, ...]:
    """
    Compare what each criterion says of every scaled motion with what the column does, nothing varied.

    `drift` is that up to which a record has a velocity; `overturned` as of `judge`.
    """
    run = np.asarray(outcomes.is_run[:, :, 0].any(axis=2))
    happened = {
        # However little: what is called rocking elsewhere begins at a thousandth of α.
        "rocking": np.asarray(outcomes.exceeds(np.finfo(np.float64).tiny)[:, :, 0].any(axis=2))[run],
        "overturning": np.asarray(outcomes.exceeds(overturned)[:, :, 0].any(axis=2))[run],
    }
    recorded = np.full((3, len(study.names), len(COMPONENTS)), np.nan)
    for record, place, along in components(study.cases.motions):
        ground = Ground(along.acceleration, along.dt)
        velocity = float(np.abs(ground.velocity).max()) if ground.drift <= drift else np.nan
        recorded[:, record, place] = along.peak, velocity, spectral_velocity(along.acceleration, along.dt)
    demands = Demands(*((each[:, None, :] * study.cases.factors)[run] for each in recorded))
    block = study.cases.column.block
    return tuple(
        JudgedCriterion(
            criterion=criterion.id, **agreement(criterion.ratio(block, demands), happened[criterion.predicts])
        )
        for criterion in CRITERIA
    )
