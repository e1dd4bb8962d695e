"""Assessment: the outcomes of a real column on scaled ground motions -> how probably it overturns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.cases import (
    AXES,
    COMPONENTS,
    FALLS_AWAY,
    NOT_RUN,
    CaseOutcomes,
    FrictionNeeded,
    friction_needed,
    holds,
    in_plane,
)
from colonnade.assessment.criteria import CRITERIA, Demands, agreement, spectral_velocity
from colonnade.assessment.curves import LognormalFit
from colonnade.assessment.fragility import MISFITS, Fragility
from colonnade.assessment.ground import Ground
from colonnade.assessment.intervals import Interval, Resampling
from colonnade.assessment.measures import measure_of
from colonnade.assessment.real_column import UNCERTAIN, RealColumn
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
from colonnade.dynamics.block import pair
from colonnade.dynamics.spectra import response_spectrum
from colonnade.errors import StageError
from colonnade.findings import warning
from colonnade.stages.assessment_plan import ASSUMED, Plan
from colonnade.units.text import format_percent, with_minus

if TYPE_CHECKING:
    import xarray as xr

CURVE = 101
"""Points at which the lognormal curve is stored, over the levels and half as far beyond either end."""


PERIODS = np.geomspace(0.05, 5.0, 41)
"""s, of the response spectra of the records."""


def assessment(plan: Plan, outcomes: Mapping[str, CaseOutcomes]) -> xr.Dataset:
    """
    Judge the histories of an assessment.

    Parameters
    ----------
    plan : Plan
    outcomes : mapping of str to CaseOutcomes
        Of each of its studies.

    Returns
    -------
    result : xr.Dataset
        Outcomes over the axes `AXES`, the drawn columns, the friction needed, and the curves over the measure; the
        attribute `answer` is an `AssessmentSummary` as JSON.

    Raises
    ------
    StageError
        If the outcomes allow no answer.
    """
    about = {each.name: each for each in plan.records.records}
    names = plan.studies[ASSUMED].names
    magnitude = _known([about[name].magnitude for name in names])
    distance = _known([about[name].distance for name in names])

    def judged(name: str) -> Fragility:
        return judge(
            plan.studies[name],
            outcomes[name],
            Resampling(plan.inputs.asked.resamples, plan.inputs.asked.seed),
            overturned=plan.inputs.asked.overturned,
            hazard=plan.hazard if name == ASSUMED else None,
            magnitude=magnitude if name == ASSUMED else None,
            distance=distance if name == ASSUMED else None,
        )

    try:
        fragilities = {name: judged(name) for name in plan.studies}
    except ValueError as error:
        raise StageError(str(error)) from error
    needed = None if plan.inputs.several else friction_needed(plan.studies[ASSUMED].cases)
    found = answer(plan, outcomes[ASSUMED], fragilities, _sliding(plan, outcomes[ASSUMED], needed))
    result = _dataset(plan, outcomes[ASSUMED], needed, fragilities[ASSUMED])
    return result.assign_attrs(
        answer=found.model_dump_json(),
        measure_asked=f"{found.measure} [{found.unit or '1'}]",
        restitution_source=plan.restitution_source,
        record_files=[file for each in found.records_used for file in each.files],
        record_sha256=[digest for each in found.records_used for digest in each.files.values()],
        warnings=[warning("assessment", said) for said in found.warnings],
    )


def _known(values: list[float | None]) -> Array | None:
    """Values with NaN for those that are missing; None if all are."""
    found = np.array([np.nan if value is None else value for value in values])
    return None if np.isnan(found).all() else found


def _sliding(plan: Plan, outcomes: CaseOutcomes, needed: FrictionNeeded | None) -> float | None:
    """Share of the histories that need more friction than there is; None if none is given, or bodies do slide."""
    cases = plan.studies[ASSUMED].cases
    if cases.column.friction is None or needed is None:
        return None
    drawn = counted_draws(cases.shape[2])
    run = outcomes.is_run[:, :, drawn]
    return float((~holds(needed, cases.drawn("friction")[:, drawn]) & run).sum() / run.sum())


def _spectra(study: Study) -> Array:
    """Pseudo-acceleration of the components as recorded, m/s², shape (records, components, periods)."""
    found = np.full((len(study.names), len(COMPONENTS), PERIODS.size), np.nan)
    for record, motion in enumerate(study.cases.motions):
        for place in range(len(COMPONENTS)):
            if (along := in_plane(motion, place, 1.0)) is not None:
                found[record, place] = response_spectrum(along.acceleration, along.dt, PERIODS).pseudo_acceleration
    return found


def _dataset(plan: Plan, outcomes: CaseOutcomes, needed: FrictionNeeded | None, fragility: Fragility) -> xr.Dataset:
    import xarray as xr

    study = plan.studies[ASSUMED]
    units = [measure_of(name).unit or "1" for name in study.values]
    reach = np.sqrt(study.levels[-1] / study.levels[0])
    over = np.geomspace(study.levels[0] / reach, study.levels[-1] * reach, CURVE)
    lognormal = fragility.lognormal.probability(over)
    isotonic = fragility.isotonic
    drawn = {f"drawn_{name}": (("record", "draw"), study.cases.drawn(name)) for name in UNCERTAIN}
    disaggregated: dict[str, Any] = {}
    if needed is not None:
        disaggregated = {"case_friction": (("record", "level", "sign", "component"), needed.largest)}
    if (rate := fragility.rate) is not None:
        disaggregated |= {"rate_edge": ("edge", rate.edges), "rate_share": ("part", rate.contributions)}
    curves = {
        f"{kind}_probability{end}": (dimension, values)
        for kind, dimension, band in (
            ("lognormal", "curve", lognormal),
            ("isotonic", "stripe", isotonic.probability),
        )
        for end, values in zip(("", "_low", "_high"), band, strict=True)
    }
    return xr.Dataset(
        {
            "case_outcome": (AXES, outcomes.outcome),
            "case_overturned": (AXES, outcomes.exceeds(plan.inputs.asked.overturned).astype(np.int8)),
            "case_peak_ratio": (AXES, outcomes.peak_ratio),
            "case_factor": (("record", "level", "component"), study.cases.factors),
            "curve_intensity": ("curve", over),
            "stripe_intensity": ("stripe", isotonic.intensity),
            **curves,
            **disaggregated,
            **drawn,
            "record_spectrum": (("record", "component", "period"), _spectra(study)),
            "record_measure": (("measure", "record", "component"), np.stack(list(study.values.values()))),
        },
        coords={
            "record": np.array(study.names, dtype=object),
            "level_intensity": ("level", study.levels),
            "component": np.array(COMPONENTS, dtype=object),
            "spectrum_period": ("period", PERIODS),
            "measure": np.array(list(study.values), dtype=object),
            "measure_unit": ("measure", np.array(units, dtype=object)),
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


def answer(
    plan: Plan, outcomes: CaseOutcomes, fragilities: Mapping[str, Fragility], sliding: float | None
) -> AssessmentSummary:
    """
    Gather the answer.

    Parameters
    ----------
    plan : Plan
    outcomes : CaseOutcomes
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
    lognormal = found.lognormal
    five, fifty = (_estimate(found.reaches(share)) for share in (0.05, 0.5))
    rate = found.rate
    variants = [_variant(plan, name, each) for name, each in fragilities.items() if name != ASSUMED]
    return AssessmentSummary(
        status="done",
        warnings=tuple(_doubts(plan, outcomes, found, sliding)),
        specimen=plan.inputs.specimen,
        measure=study.measure.id,
        unit=study.measure.unit,
        **_assumed(plan, study.cases.column),
        baseline=plan.inputs.asked.baseline,
        uplift=Estimate() if found.uplift.curve is None else _estimate(found.uplift.curve.median),
        median=_estimate(lognormal.median),
        dispersion=_estimate(lognormal.beta),
        dispersion_records=found.betas.records,
        dispersion_parameters=found.betas.parameters,
        five_percent=five,
        fifty_percent=fifty,
        curve=found.taken,
        curve_reason=None if found.taken == "lognormal" else _why_not(found),
        misfit=found.misfit.p_value,
        resurrected=found.resurrection.lost,
        sliding=sliding,
        annual_rate=Estimate() if rate is None else _estimate(rate.rate),
        probability_50_years=Estimate() if rate is None else _estimate(rate.in_50_years),
        annual_rate_isotonic=None if rate is None else rate.isotonic,
        rate_outside=None if rate is None else rate.below_hazard + rate.above_hazard,
        variants=(*variants, *_without_correction(plan)),
        measures=_measures(found),
        criteria=_judged_criteria(
            study, outcomes, drift=plan.inputs.asked.drift, overturned=plan.inputs.asked.overturned
        ),
        deciding=_deciding(found),
        records_used=_used(plan),
        records_left_out=_left_out(plan),
        notes=(*plan.records.notes, *_not_compared(plan, found)),
    )


def _assumed(plan: Plan, column: RealColumn) -> dict[str, Any]:
    """Give what was assumed of the column."""
    low, high = column.restitution_range or (None, None)
    one = plan.inputs.several is None
    return {
        "critical_angle": column.block.critical_angle,
        "critical_angle_range": column.critical_angle_range,
        "p": column.block.p,
        "p_range": column.p_range,
        "restitution": Estimate(value=float(np.mean(pair(column.restitution))), low=low, high=high)
        if one
        else Estimate(),
        "restitution_source": plan.restitution_source if one else None,
        "displaced": plan.inputs.asked.displaced,
        "friction": column.friction,
        "friction_range": column.friction_range,
        "uplift_acceleration": column.block.uplift_acceleration,
    }


def _estimate(interval: Interval) -> Estimate:
    # 0 and infinity stand for what lies beyond the levels.
    value, low, high = (float(each) if 0.0 < each < np.inf else None for each in interval)
    beyond: Literal["below", "above"] | None = None
    if value is None and not np.isnan(interval.value):
        beyond = "below" if interval.value == 0.0 else "above"
    return Estimate(value=value, low=low, high=high, beyond=beyond)


def _why_not(found: Fragility) -> str:
    """Say why the lognormal curve is not taken."""
    if found.lognormal.reason:
        return NO_CURVE[found.lognormal.reason]
    return f"the lognormal curve does not fit (p = {found.misfit.p_value:.2g})"


def _at_lognormal(fit: LognormalFit, share: float) -> Estimate:
    """Intensity at which the lognormal curve reaches a share."""
    return _estimate(Interval(*(float(each[0]) for each in fit.intensity([share]))))


def _variant(plan: Plan, name: str, found: Fragility) -> Variant:
    fit = found.lognormal
    return Variant(
        name=name,
        restitution=float(np.mean(pair(plan.studies[name].cases.column.restitution))),
        median=Estimate() if fit.reason else _estimate(fit.median),
        five_percent=Estimate() if fit.reason else _at_lognormal(fit, 0.05),
        records=len(found.outcomes.records),
        reason=NO_CURVE[fit.reason] if fit.reason else None,
    )


def _without_correction(plan: Plan) -> list[Variant]:
    """Give the reason if the records have no answer without the correction."""
    if not plan.without_correction:
        return []
    e = float(np.mean(pair(plan.studies[ASSUMED].cases.column.restitution)))
    return [Variant(name=UNCORRECTED, restitution=e, reason=plan.without_correction)]


def _not_compared(plan: Plan, found: Fragility) -> list[str]:
    """Say which measures are not compared; nobody asked for those that are compared by default."""
    compared = () if found.measures is None else {each.name for each in found.measures.scores}
    missing = [name for name in plan.studies[ASSUMED].values if name not in compared]
    return [f"Not compared, as not all records have it: {measure_of(name).name}." for name in missing]


def _measures(found: Fragility) -> tuple[JudgedMeasure, ...]:
    if found.measures is None:
        return ()
    return tuple(
        JudgedMeasure(
            measure=each.name,
            deviance=each.deviance,
            auc=each.auc,
            scatter=each.scatter,
            best=each.best,
            magnitude=each.on_magnitude,
            distance=each.on_log_distance,
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


def _doubts(plan: Plan, outcomes: CaseOutcomes, found: Fragility, sliding: float | None) -> list[str]:
    """Say what is doubtful, the gravest first; arguments as of `answer`, with the study as assumed."""
    said = [*_of_the_column(plan), *_of_the_histories(outcomes, sliding), *_of_the_records(plan, found)]
    return said + _of_the_rate(plan, found)


def _left_out(plan: Plan) -> tuple[RecordLeftOut, ...]:
    """Name the files, records and components that are not used, with the reason."""
    named = [(each.name, each.reason.removeprefix(f"{each.name}: ")) for each in plan.records.left_out]
    return tuple(
        RecordLeftOut(record=name, reason=reason) for name, reason in (*named, *plan.studies[ASSUMED].left_out.items())
    )


def _of_the_column(plan: Plan) -> list[str]:
    column, said = plan.studies[ASSUMED].cases.column, []
    if plan.inputs.prototype.restitution == "identified" and plan.restitution_source == "rigid-body":
        said.append("No e is identified on the model. That of a rigid body is assumed.")
    rows = zip(("e", "α (rad)", "p (rad/s)"), column.central, column.ranges, strict=False)
    return said + [
        f"{name} is {value:.4g}, outside the limits {limits[0]:.4g} and {limits[1]:.4g} between which it is drawn."
        for name, value, limits in rows
        if limits is not None and not limits[0] <= value <= limits[1]
    ]


def _of_the_histories(outcomes: CaseOutcomes, sliding: float | None) -> list[str]:
    said = []
    if sliding:
        said.append(
            f"In {format_percent(sliding)} of the histories the column would slide: it needs more friction than there "
            "is. There the answer does not hold."
        )
    if (falling := float((outcomes.outcome == FALLS_AWAY).sum() / (outcomes.outcome != NOT_RUN).sum())) > 0.0:
        said.append(
            f"{format_percent(falling)} of the histories are not run, and do not count: their base falls faster than "
            "the column. Their levels are too high."
        )
    return said


def _of_the_records(plan: Plan, found: Fragility) -> list[str]:
    said, missing = [], _left_out(plan)
    if missing:
        first = missing[0]
        others = "" if len(missing) == 1 else f" and {len(missing) - 1} more"
        said.append(f"Left out: {first.record}{others}. {first.record}: {first.reason.splitlines()[0]}")
    return [*said, found.lognormal.no_interval] if found.lognormal.no_interval else said


def _of_the_rate(plan: Plan, found: Fragility) -> list[str]:
    rate, said = found.rate, []
    if rate is not None and rate.is_extrapolated:
        said.append(
            f"{format_percent(rate.below_hazard + rate.above_hazard)} of the annual rate is from outside the hazard "
            f"curve, and {format_percent(rate.below_levels + rate.above_levels)} from outside the levels."
        )
    if rate is not None and found.misfit.p_value < MISFITS:
        said.append(
            "The annual rate is by the lognormal curve, which does not fit. By the curve that only rises it is "
            f"{with_minus(f'{rate.isotonic:.2g}')} a year."
        )
    if plan.hazard is not None and rate is None:
        said.append("There is a hazard, and no annual rate: that needs a lognormal curve.")
    return said


def _judged_criteria(
    study: Study, outcomes: CaseOutcomes, *, drift: float, overturned: float
) -> tuple[JudgedCriterion, ...]:
    """
    Compare what each criterion says of every scaled motion with what the column does, nothing varied.

    Parameters
    ----------
    study : Study
    outcomes : CaseOutcomes
        Of its cases; the first draw has nothing varied.
    drift : float
        Up to which a record has a velocity.
    overturned : float
        As of `judge`.
    """
    run = np.asarray(outcomes.is_run[:, :, 0].any(axis=2))
    happened = {
        # However little: what is called rocking elsewhere begins at a thousandth of α.
        "rocking": np.asarray(outcomes.exceeds(np.finfo(np.float64).tiny)[:, :, 0].any(axis=2))[run],
        "overturning": np.asarray(outcomes.exceeds(overturned)[:, :, 0].any(axis=2))[run],
    }
    recorded = _recorded(study, drift)
    demands = Demands(*((each[:, None, :] * study.cases.factors)[run] for each in recorded))
    block = study.cases.column.block
    return tuple(
        JudgedCriterion(
            criterion=criterion.id, **agreement(criterion.ratio(block, demands), happened[criterion.predicts])
        )
        for criterion in CRITERIA
    )


def _recorded(study: Study, drift: float) -> tuple[Array, Array, Array]:
    """Peak acceleration, peak velocity and level of the velocity spectrum of each record and component."""
    found = np.full((3, *study.cases.factors.shape[::2]), np.nan)
    for record, motion in enumerate(study.cases.motions):
        for place in range(found.shape[2]):
            along = in_plane(motion, place, 1.0)
            if along is None:
                continue
            ground = Ground(along.acceleration, along.dt)
            velocity = float(np.abs(ground.velocity).max()) if ground.drift <= drift else np.nan
            found[:, record, place] = along.peak, velocity, spectral_velocity(along.acceleration, along.dt)
    return found[0], found[1], found[2]
