"""Ensemble: recorded base motion, specimen and uncertain inputs -> bands of a model, in the plane or on contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Dataset, dataset
from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import ContactEnsembleSettings, MeasurementSettings, PlaneEnsembleSettings
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.ensemble import ContactPlan
from colonnade.dynamics.ensemble import Ensemble, Plan, PlanePlan
from colonnade.dynamics.history import amplitude, capped
from colonnade.dynamics.models import model_of
from colonnade.identification.response.rank import Measurement, as_measured, distances, rank
from colonnade.stages.contact import refusals
from colonnade.stages.parts.beginning import RECORDED, Beginning
from colonnade.stages.predict import PredictInputs, planned
from colonnade.stages.specimen import spread_of
from colonnade.store.provenance import Inputs


class EnsembleInputs(Inputs):
    """
    What `ensemble` reads of the campaign for one test and model.

    Attributes
    ----------
    prediction : PredictInputs
    plane : PlaneEnsembleSettings or None
        Of a model in the plane.
    contact : ContactEnsembleSettings or None
        Half ranges of the contact model's inputs; `members` is a number.
    measured : MeasurementSettings
        What is known of the measured angle that the runs are compared with.
    filter_order : int
    """

    prediction: PredictInputs
    plane: PlaneEnsembleSettings | None
    contact: ContactEnsembleSettings | None
    measured: MeasurementSettings
    filter_order: int

    @classmethod
    def of(cls, campaign: Campaign, test: Test, model: str) -> EnsembleInputs:
        """Gather what `ensemble` reads for one test and model."""
        settings, in_space = campaign.ensemble_settings(test.specimen), model_of(model).in_space
        members = {"members": campaign.members(test, model)}
        return cls(
            prediction=PredictInputs.of(campaign, test, model),
            plane=None if in_space else settings,
            contact=settings.contact.model_copy(update=members) if in_space else None,
            measured=settings,
            filter_order=campaign.processing.filter_order,
        )


Parts = Sequence[Mapping[str, NDArray[Any]]]
"""What the members of an ensemble gave, in their order."""

Run = Callable[[Plan, Array], Parts]
"""Runs all members of a plan, given its central angle."""


def all_at_once(plan: Plan, central: Array) -> Parts:
    """Run all members here, one after the other."""
    return [plan.members(central, range(plan.count))]


def ensemble(
    rocking: Dataset,
    inputs: EnsembleInputs,
    specimen: Dataset | None = None,
    contact: Dataset | None = None,
    identified: Dataset | None = None,
    run: Run = all_at_once,
) -> Dataset:
    """
    Run a model many times on the base motion that was recorded, over what is not exactly known.

    Parameters
    ----------
    rocking : Dataset
        As of `predict`, with noise and cut-off of the table's accelerometers, and the lowest cut-off of the angle.
    inputs : EnsembleInputs
    specimen : Dataset, optional
        As of `predict`; of a model in the plane.
    contact : Dataset, optional
        As of `predict`, of the contact model; several bodies have none.
    identified : Dataset, optional
        As of `predict`.
    run : callable, optional
        Runs the members; their results do not depend on where that is.

    Returns
    -------
    bands : Dataset
        `rocking_angle_band` by `quantile` on the record's clock, from where the prediction starts; the
        `overturning_probability`; `member_peak_ratio` (NaN if it overturns); the `horizon` (s). If an angle was
        measured, `within_spread`, the share of runs that are closer to their median than it (NaN of too few runs), and
        `peak_rank`, the share of runs whose peak would have been recorded below its own, with half of the equal ones.
        Of an assembly by `body` the `body_overturning_probability` and, of the members in which it stands, the
        quantiles of how far it moved for good, `body_moved_band` (m).

    Raises
    ------
    StageError
        As `predict`.
    """
    prediction = inputs.prediction
    beginning, plan = planned(rocking, prediction, specimen, contact, identified)
    errors = measurement_errors(rocking, beginning, inputs)
    if isinstance(plan, PlanePlan):
        assert specimen is not None  # which the plan is of
        base = rocking["base_acceleration"].attrs if beginning.driven_by == RECORDED else None
        plan = _varied(plan, specimen, base, errors, inputs)
    else:
        plan = _ranging(plan, inputs)
    with refusals():
        central = plan.central_angle()
        parts = run(plan, central)
    found = plan.gather(central, parts)
    time = rocking["elapsed"].to_numpy()
    horizon = found.horizon(inputs.measured.horizon * prediction.block.critical_angle) + float(time[beginning.first])
    variables: dict[str, Any] = {
        "rocking_angle": ("elapsed", found.central),
        "rocking_angle_band": (("quantile", "elapsed"), found.bands),
        "overturning_probability": found.overturning_probability,
        "member_peak_ratio": ("member", found.peak_ratio),
        "horizon": horizon,
    }
    first, stride = beginning.first, round(float(found.time[1] - found.time[0]) / beginning.motion.dt)
    bands = dataset(variables, {"elapsed": time[first::stride], "quantile": found.levels})
    if "rocking_angle" in rocking:
        seen = rocking.isel(elapsed=slice(first, None, stride))
        bands = bands.assign(ranks(seen, beginning, found, errors.thinned(first, stride), prediction.block, horizon))
    if isinstance(plan, ContactPlan) and isinstance(plan.space.body, Assembly):
        bands = bands.assign(_ends(list(plan.space.body.bodies), parts, found.levels))
    return bands.assign_attrs(model=prediction.model, members=plan.count, warnings=[])


SEED = 22
"""Of the measurement errors of the runs; they are the same in every run of the stage."""


def ranks(
    rocking: Dataset, beginning: Beginning, found: Ensemble, errors: Measurement, block: Block, horizon: float
) -> dict[str, float]:
    """Rank the measured angle among the runs, by its distance up to the horizon (s) and by its peak.

    `rocking` and `errors` are on the clock of the bands.
    """
    time = rocking["elapsed"].to_numpy()
    angle = (rocking["rocking_angle"].to_numpy() - beginning.zero_offset) / beginning.angle_gain
    starts = found.inputs[:, found.names.index("theta0")] if "theta0" in found.names else np.zeros(len(found.inputs))
    recorded = as_measured(found.histories, starts[: len(found.histories)], errors, np.random.default_rng(SEED))
    seen = time <= horizon
    measured = capped(time, angle, float(rocking["overturning_time"]), block)
    compared = distances(measured[seen], recorded[:, seen])
    # Peaks within the noise are all the same; what overturns is above all others.
    least = float(rocking["noise_threshold"]) / block.critical_angle
    peak = float(np.nanmax(amplitude(angle, block), initial=least))
    falls = np.isfinite(found.overturning_time[: len(recorded)])
    peaks = np.where(falls, np.inf, np.maximum(amplitude(recorded, block).max(axis=1), least))
    return {
        "within_spread": np.nan if compared is None else rank(*compared),
        "peak_rank": rank(np.inf if rocking.attrs["outcome"] == "overturned" else peak, peaks),
    }


def measurement_errors(rocking: Dataset, beginning: Beginning, inputs: EnsembleInputs) -> Measurement:
    """Gather the errors of a measured angle, and of the one that a free vibration starts from."""
    time = rocking["elapsed"].to_numpy()
    error, drift, cutoff, is_integrated = 0.0, 0.0, None, "angle_deviation" in rocking
    if "rocking_angle" in rocking:
        error, drift = (float(rocking[f"rocking_angle_{each}"]) for each in ("standard_error", "drift"))
        drift, cutoff = drift / np.sqrt(3), rocking["rocking_angle"].attrs.get("cutoff_hz")
    start = beginning.theta0 if inputs.prediction.free_vibration else None
    return Measurement(
        interval=float(time[1] - time[0]),
        gain=inputs.measured.angle_gain,
        zero=max(inputs.measured.angle_zero * inputs.prediction.block.critical_angle, drift),
        noise=0.0 if is_integrated else float(np.sqrt(max(error**2 - drift**2, 0.0))),
        drift=rocking["angle_deviation"].to_numpy() if is_integrated else np.zeros(time.size),
        cutoff_hz=cutoff,
        filter_order=inputs.filter_order,
        start=start,
        start_error=0.0 if start is None else error,
    )


def _varied(
    plan: PlanePlan, specimen: Dataset, base: Mapping[str, Any] | None, errors: Measurement, inputs: EnsembleInputs
) -> PlanePlan:
    """Vary block, e and motion about a prediction in the plane; `base` is known of the motion that drives it."""
    assert inputs.plane is not None  # the inputs of a plane model have them
    settings, known = inputs.plane, base or {}
    cutoff = known.get("cutoff_hz")
    uncertainty = replace(
        spread_of(specimen, settings),
        gain=0.0 if base is None else settings.gain,
        clock=settings.clock,
        noise=known.get("noise", 0.0),
        cutoff=cutoff,
        filter=0.0 if cutoff is None else settings.filter,
        filter_order=inputs.filter_order,
        theta0=errors.start_deviation,
    )
    return replace(plan, uncertainty=uncertainty, count=settings.members)


def _ranging(plan: ContactPlan, inputs: EnsembleInputs) -> ContactPlan:
    """Vary law, tilt and places about a prediction of the contact model."""
    assert inputs.contact is not None  # the inputs of the contact model have them
    settings, law = inputs.contact, plan.space.law
    halves = {
        "friction": (law.friction, settings.friction * law.friction),
        "damping_fraction": (law.damping_fraction, settings.damping_fraction * law.damping_fraction),
    }
    if isinstance(plan.space.body, Assembly):
        halves["penetration"] = law.penetration, settings.penetration * law.penetration
    else:
        halves["out_of_plane"] = plan.ranges["out_of_plane"][0], abs(settings.out_of_plane)
    ranges = {name: (middle - half, middle + half) for name, (middle, half) in halves.items()}
    return replace(plan, ranges=ranges, misplacement=abs(settings.misplacement), count=int(settings.members))


def _ends(bodies: Sequence[str], parts: Parts, levels: Array) -> dict[str, Any]:
    """How probably each body falls, and how far it moves for good where it stands."""
    moved, fell = (np.concatenate([part[name] for part in parts]) for name in ("moved", "fell"))
    standing = [moved[fell[:, place] == 0, place] for place in range(fell.shape[1])]
    bands = [np.quantile(each, levels) if each.size else np.full(levels.size, np.nan) for each in standing]
    return {
        "body": ("body", np.array(bodies, dtype=object)),
        "body_overturning_probability": ("body", fell.mean(axis=0)),
        "body_moved_band": (("quantile", "body"), np.array(bands).T),
    }
