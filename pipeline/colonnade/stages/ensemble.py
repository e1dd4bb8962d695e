"""Ensemble: recorded base motion, specimen and uncertain inputs -> bands of a model, in the plane or on contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import ContactEnsembleSettings, MeasurementSettings, PlaneEnsembleSettings
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.contact.ensemble import ContactPlan
from colonnade.dynamics.ensemble import Plan, PlanePlan
from colonnade.dynamics.models import model_of
from colonnade.identification.response.rank import Measurement
from colonnade.stages.contact import refusals
from colonnade.stages.parts.beginning import RECORDED, Beginning
from colonnade.stages.parts.rank import describe_bands
from colonnade.stages.parts.transducers import along, transducers
from colonnade.stages.predict import PredictInputs, planned
from colonnade.stages.specimen import spread_of
from colonnade.store.provenance import Inputs

if TYPE_CHECKING:
    import xarray as xr


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
    table, specimen : tuple of str
        Accelerometers of the table along x and transducers on the specimen, by the names of their variables.
    """

    prediction: PredictInputs
    plane: PlaneEnsembleSettings | None
    contact: ContactEnsembleSettings | None
    measured: MeasurementSettings
    filter_order: int
    table: tuple[str, ...]
    specimen: tuple[str, ...]

    @classmethod
    def of(cls, campaign: Campaign, test: Test, model: str) -> EnsembleInputs:
        """Gather what `ensemble` reads for one test and model."""
        known, settings = transducers(campaign.channels(test)), campaign.ensemble_settings(test.specimen)
        in_space, members = model_of(model).in_space, {"members": campaign.members(test, model)}
        return cls(
            prediction=PredictInputs.of(campaign, test, model),
            plane=None if in_space else settings,
            contact=settings.contact.model_copy(update=members) if in_space else None,
            measured=settings,
            filter_order=campaign.processing.filter_order,
            table=tuple(along(known.accelerations, 0)),
            specimen=known.on_specimen,
        )


Parts = Sequence[Mapping[str, NDArray[Any]]]
"""What the members of an ensemble gave, in their order."""

Run = Callable[[Plan, Array], Parts]
"""Runs all members of a plan, given its central angle."""


def all_at_once(plan: Plan, central: Array) -> Parts:
    """Run all members here, one after the other."""
    return [plan.members(central, range(plan.count))]


def ensemble(
    conditioned: xr.Dataset,
    rocking: xr.Dataset,
    inputs: EnsembleInputs,
    specimen: xr.Dataset | None = None,
    contact: xr.Dataset | None = None,
    identified: xr.Dataset | None = None,
    run: Run = all_at_once,
) -> xr.Dataset:
    """
    Run a model many times on the base motion that was recorded, over what is not exactly known.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: noise of the table's accelerometers, cut-offs of all channels.
    rocking : xr.Dataset
        As of `predict`.
    inputs : EnsembleInputs
    specimen : xr.Dataset, optional
        As of `predict`; of a model in the plane.
    contact : xr.Dataset, optional
        As of `predict`, of the contact model; several bodies have none.
    identified : xr.Dataset, optional
        As of `predict`.
    run : callable, optional
        Runs the members; their results do not depend on where that is.

    Returns
    -------
    bands : xr.Dataset
        `rocking_angle_band` by `quantile` on the record's clock, from where the prediction starts; the
        `overturning_probability` with its interval; `member_peak_ratio` (NaN if it overturns) and
        `member_overturning_time`; by `input` that varies its `peak_sensitivity`; what `describe_bands` adds. Of an
        assembly by `body` the `body_overturning_probability` and, of the members in which it stands, the quantiles of
        how far it moved for good, `body_moved_band` (m).

    Raises
    ------
    StageError
        As `predict`.
    """
    prediction = inputs.prediction
    beginning, plan = planned(rocking, prediction, specimen, contact, identified)
    errors = measurement_errors(conditioned, rocking, beginning, inputs)
    about: dict[str, Any] = {}
    if isinstance(plan, PlanePlan):
        assert specimen is not None  # which the plan is of
        plan = _varied(plan, conditioned, specimen, beginning, errors, inputs)
        about = {"noise": plan.uncertainty.noise, "cutoff_hz": plan.uncertainty.cutoff}
    else:
        plan = _ranging(plan, inputs)
    with refusals():
        central = plan.central_angle()
        parts = run(plan, central)
    found = plan.gather(central, parts)
    starts = found.inputs[:, found.names.index("theta0")] if "theta0" in found.names else np.zeros(plan.count)
    width = inputs.measured.horizon * prediction.block.critical_angle
    bands = describe_bands(rocking, beginning, found, starts, errors, prediction.block, width)
    if isinstance(plan, ContactPlan) and isinstance(plan.space.body, Assembly):
        bands = bands.assign(_ends(list(plan.space.body.bodies), parts, found.levels))
    return bands.assign_attrs(model=prediction.model, members=plan.count, **about, warnings=[])


def measurement_errors(
    conditioned: xr.Dataset, rocking: xr.Dataset, beginning: Beginning, inputs: EnsembleInputs
) -> Measurement:
    """Gather the errors of a measured angle, and of the one that a free vibration starts from."""
    time = rocking["elapsed"].to_numpy()
    error = float(rocking["rocking_angle_standard_error"]) if "rocking_angle" in rocking else 0.0
    drift = float(rocking["rocking_angle_drift"]) / np.sqrt(3) if "rocking_angle" in rocking else 0.0
    is_integrated = "angle_deviation" in rocking
    cutoffs = [conditioned[name].attrs.get("cutoff_hz") for name in inputs.specimen if name in conditioned]
    start = beginning.theta0 if inputs.prediction.free_vibration else None
    return Measurement(
        interval=float(time[1] - time[0]),
        gain=inputs.measured.angle_gain,
        zero=max(inputs.measured.angle_zero * inputs.prediction.block.critical_angle, drift),
        noise=0.0 if is_integrated else float(np.sqrt(max(error**2 - drift**2, 0.0))),
        drift=rocking["angle_deviation"].to_numpy() if is_integrated else np.zeros(time.size),
        cutoff_hz=min((float(each) for each in cutoffs if each is not None), default=None),
        filter_order=inputs.filter_order,
        start=start,
        start_error=0.0 if start is None else error,
    )


def _varied(
    plan: PlanePlan,
    conditioned: xr.Dataset,
    specimen: xr.Dataset,
    beginning: Beginning,
    errors: Measurement,
    inputs: EnsembleInputs,
) -> PlanePlan:
    """Vary block, e and motion about a prediction in the plane."""
    assert inputs.plane is not None  # the inputs of a plane model have them
    settings, is_driven = inputs.plane, beginning.driven_by == RECORDED
    noise, cutoff = _base_noise(conditioned, inputs.table) if is_driven else (0.0, None)
    uncertainty = replace(
        spread_of(specimen, settings),
        gain=settings.gain if is_driven else 0.0,
        clock=settings.clock,
        noise=noise,
        cutoff=cutoff,
        filter=0.0 if cutoff is None else settings.filter,
        filter_order=inputs.filter_order,
        theta0=errors.start_deviation,
    )
    return replace(plan, uncertainty=uncertainty, count=settings.members)


def _base_noise(conditioned: xr.Dataset, table: tuple[str, ...]) -> tuple[float, float | None]:
    """Noise (m/s²) and cut-off (Hz) of the mean of the table's accelerometers; 0 and None without one."""
    used = [conditioned[name].attrs for name in table if name in conditioned]
    if not used:
        return 0.0, None
    noise = np.array([float(given.get("noise", 0.0)) for given in used])
    cutoff = min((float(given["cutoff_hz"]) for given in used if "cutoff_hz" in given), default=None)
    return float(np.sqrt(np.sum(noise**2))) / noise.size, cutoff


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
