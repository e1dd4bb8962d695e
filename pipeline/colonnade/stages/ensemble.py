"""Ensemble: recorded base motion, specimen and uncertain inputs -> bands of a model, in the plane or on contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.channel import ALONG
from colonnade.campaign.settings import ContactEnsembleSettings, PlaneEnsembleSettings
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.ensemble import ContactPlan, Range
from colonnade.dynamics.contact.simulate import plane_block
from colonnade.dynamics.ensemble import Plan, PlanePlan
from colonnade.dynamics.models import CONTACT
from colonnade.dynamics.uncertainty import INPUTS
from colonnade.stages.contact import assembly_law, body_of, law_of, refusals
from colonnade.stages.parts.beginning import RECORDED, begin
from colonnade.stages.parts.rank import MeasurementInputs, describe_bands, measurement_errors
from colonnade.stages.parts.transducers import transducers
from colonnade.stages.predict import PredictInputs, sides
from colonnade.stages.specimen import centre, spread_of
from colonnade.store.provenance import Inputs

if TYPE_CHECKING:
    import xarray as xr


class EnsembleInputs(Inputs):
    """
    What `ensemble` reads of the campaign for one test and model.

    Attributes
    ----------
    prediction : PredictInputs
    settings : PlaneEnsembleSettings
    table : tuple of str
        Accelerometers of the table along x, by the names of their variables.
    measurement : MeasurementInputs
    """

    prediction: PredictInputs
    settings: PlaneEnsembleSettings
    table: tuple[str, ...]
    measurement: MeasurementInputs

    @classmethod
    def of(cls, campaign: Campaign, test: Test, model: str) -> EnsembleInputs:
        """Gather what `ensemble` reads for one test and model."""
        along = transducers(campaign.channels(test)).accelerations
        return cls(
            prediction=PredictInputs.of(campaign, test, model),
            settings=campaign.ensemble_settings(test.specimen),
            table=tuple(name for name, direction in along.items() if abs(direction[0]) >= ALONG),
            measurement=MeasurementInputs.of(campaign, test),
        )


def ensemble(
    conditioned: xr.Dataset,
    rocking: xr.Dataset,
    specimen: xr.Dataset,
    inputs: EnsembleInputs,
    identified: xr.Dataset | None = None,
) -> xr.Dataset:
    """
    Run a model many times on the base motion that was recorded, over what is not exactly known.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: noise of the table's accelerometers, cut-offs of all channels.
    rocking, specimen : xr.Dataset
        As of `predict`.
    inputs : EnsembleInputs
    identified : xr.Dataset, optional
        As of `predict`.

    Returns
    -------
    bands : xr.Dataset
        `rocking_angle_band` by `quantile` on the record's clock, from where the prediction starts; the
        `overturning_probability` with its interval; `member_peak_ratio` (NaN if it overturns) and
        `member_overturning_time`; by `input` its standard deviation and `peak_sensitivity`; what `describe_bands` adds.

    Raises
    ------
    StageError
        As `predict`.
    """
    block, settings = centre(specimen, inputs.prediction.block), inputs.settings
    beginning = begin(rocking, inputs.prediction, identified, block)
    errors = measurement_errors(conditioned, rocking, beginning, inputs.measurement)
    is_driven = beginning.driven_by == RECORDED
    noise, cutoff = _base_noise(conditioned, inputs.table) if is_driven else (0.0, None)
    plan = PlanePlan(
        block=block,
        motion=beginning.motion,
        restitution=sides(specimen),
        uncertainty=replace(
            spread_of(specimen, settings),
            gain=settings.gain if is_driven else 0.0,
            clock=settings.clock,
            noise=noise,
            cutoff=cutoff,
            filter=0.0 if cutoff is None else settings.filter,
            filter_order=inputs.measurement.filter_order,
            theta0=errors.start_deviation,
        ),
        count=settings.members,
        model=inputs.prediction.model,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        rest_angle=inputs.prediction.rest_angle,
    )
    found = plan.run()
    deviations = dict(zip(INPUTS, plan.uncertainty.deviations.tolist(), strict=True))
    starts = found.inputs[:, INPUTS.index("theta0")]
    bands = describe_bands(rocking, beginning, found, deviations, starts, errors, inputs.measurement)
    return bands.assign_attrs(model=plan.model, members=plan.count, noise=noise, cutoff_hz=cutoff, warnings=[])


def _base_noise(conditioned: xr.Dataset, table: tuple[str, ...]) -> tuple[float, float | None]:
    """Noise (m/s²) and cut-off (Hz) of the mean of the table's accelerometers; 0 and None without one."""
    used = [conditioned[name].attrs for name in table if name in conditioned]
    if not used:
        return 0.0, None
    noise = np.array([float(given.get("noise", 0.0)) for given in used])
    cutoff = min((float(given["cutoff_hz"]) for given in used if "cutoff_hz" in given), default=None)
    return float(np.sqrt(np.sum(noise**2))) / noise.size, cutoff


class ContactEnsembleInputs(Inputs):
    """
    What `contact_ensemble` reads of the campaign for one test.

    Attributes
    ----------
    prediction : PredictInputs
    settings : ContactEnsembleSettings
        Half ranges of the inputs; `members` is a number.
    measurement : MeasurementInputs
    """

    prediction: PredictInputs
    settings: ContactEnsembleSettings
    measurement: MeasurementInputs

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> ContactEnsembleInputs:
        """Gather what `contact_ensemble` reads for one test."""
        members = {"members": campaign.members(test, CONTACT.name)}
        return cls(
            prediction=PredictInputs.of(campaign, test, CONTACT.name),
            settings=campaign.processing.predict.ensemble.contact.model_copy(update=members),
            measurement=MeasurementInputs.of(campaign, test),
        )


Parts = Sequence[Mapping[str, NDArray[Any]]]
"""What the members of an ensemble gave, in their order."""

Run = Callable[[Plan, Array], Parts]
"""Runs all members of a plan, given its central angle."""


def all_at_once(plan: Plan, central: Array) -> Parts:
    """Run all members here, one after the other."""
    return [plan.members(central, range(plan.count))]


def contact_ensemble(
    conditioned: xr.Dataset,
    rocking: xr.Dataset,
    inputs: ContactEnsembleInputs,
    contact: xr.Dataset | None = None,
    identified: xr.Dataset | None = None,
    run: Run = all_at_once,
) -> xr.Dataset:
    """
    Run the contact model many times on the base motion that was recorded, over what is not known of it.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: cut-offs of the channels on the specimen.
    rocking : xr.Dataset
        As of `predict`.
    inputs : ContactEnsembleInputs
    contact : xr.Dataset, optional
        As of `predict`; several bodies have none.
    identified : xr.Dataset, optional
        As of `predict`.
    run : callable, optional
        Runs the members; their results do not depend on where that is.

    Returns
    -------
    bands : xr.Dataset
        As of `ensemble`. By `input` it has the standard deviation of values that are equally likely in their range; of
        an assembly by `body` the `body_overturning_probability` and, of the members in which it stands, the quantiles
        of how far it moved for good, `body_moved_band` (m).

    Raises
    ------
    StageError
        As `predict`.
    """
    beginning = begin(rocking, inputs.prediction, identified)
    space, ranges, assembled = inputs.prediction.space, inputs.settings, inputs.prediction.assembly
    assert space is not None  # the contact model's inputs have it
    law = assembly_law(space.settings) if contact is None else law_of(contact)
    varied = {
        "friction": _about(law.friction, ranges.friction * law.friction),
        "damping_fraction": _about(law.damping_fraction, ranges.damping_fraction * law.damping_fraction),
    }
    body: ContactBody | Assembly
    if assembled is not None:
        body, block = assembled.assembly, space.block
        varied["penetration"] = _about(law.penetration, ranges.penetration * law.penetration)
    else:
        body = body_of(space, law)
        block = plane_block(body, space.block.gravity)
        varied["out_of_plane"] = _about(space.settings.out_of_plane, abs(ranges.out_of_plane))
    plan = ContactPlan(
        block=block,
        motion=beginning.motion,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        count=int(ranges.members),
        body=body,
        law=law,
        ranges=varied,
        misplacement=abs(ranges.misplacement),
        step=space.settings.step,
    )
    with refusals():
        central = plan.central_angle()
        parts = run(plan, central)
    found = plan.gather(central, parts)
    middles = {name: getattr(law, name, 1.0) or 1.0 for name in varied}
    deviations = {name: np.ptp(varied[name]) / np.sqrt(12.0) / middles[name] for name in varied}
    errors = measurement_errors(conditioned, rocking, beginning, inputs.measurement)
    starts = np.zeros(plan.count)
    bands = describe_bands(rocking, beginning, found, deviations, starts, errors, inputs.measurement)
    if isinstance(body, Assembly):
        bands = bands.assign(_ends(list(body.bodies), parts, found.levels))
    return bands.assign_attrs(model=CONTACT.name, members=plan.count, warnings=[])


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


def _about(middle: float, half: float) -> Range:
    return middle - half, middle + half
