"""Assessment: the outcomes of a real column on scaled ground motions -> how probably it overturns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.cases import AXES, COMPONENTS, FrictionNeeded, Outcomes, friction_needed, holds, in_plane
from colonnade.assessment.fragility import Fragility
from colonnade.assessment.intervals import Resampling
from colonnade.assessment.measures import measure_of
from colonnade.assessment.prototype import UNCERTAIN
from colonnade.assessment.study import Study, counted_draws, judge
from colonnade.dynamics.spectra import response_spectrum
from colonnade.errors import StageError
from colonnade.findings import warning
from colonnade.stages.assessing.answer import answer
from colonnade.stages.assessing.plan import ASSUMED, Plan

if TYPE_CHECKING:
    import xarray as xr

CURVE = 101
"""Points at which the lognormal curve is stored, over the levels and half as far beyond either end."""


PERIODS = np.geomspace(0.05, 5.0, 41)
"""s, of the response spectra of the records."""


def assessment(plan: Plan, outcomes: Mapping[str, Outcomes]) -> xr.Dataset:
    """
    Judge the histories of an assessment.

    Parameters
    ----------
    plan : Plan
    outcomes : mapping of str to Outcomes
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


def _sliding(plan: Plan, outcomes: Outcomes, needed: FrictionNeeded | None) -> float | None:
    """Share of the histories that need more friction than there is; None if none is given, or bodies do slide."""
    cases = plan.studies[ASSUMED].cases
    if cases.prototype.friction is None or needed is None:
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


def _dataset(plan: Plan, outcomes: Outcomes, needed: FrictionNeeded | None, fragility: Fragility) -> xr.Dataset:
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
