"""Ensemble of the contact model: over friction, damping and the rotation out of the plane at the start."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import ContactEnsembleSettings
from colonnade.dynamics.ensembles.contact import INPUTS, ContactPlan, Range, gather, run_member
from colonnade.dynamics.models.contact import CONTACT
from colonnade.errors import StageError
from colonnade.stages.contact import ContactInputs, body_of, law_of
from colonnade.stages.parts.beginning import begin
from colonnade.stages.parts.inputs import Inputs
from colonnade.stages.parts.rank import MeasurementInputs, describe_bands, measurement_errors, rank_measured
from colonnade.stages.predict import PredictInputs

if TYPE_CHECKING:
    import xarray as xr


class ContactEnsembleInputs(Inputs):
    """
    What `contact_ensemble` reads of the campaign for one test.

    Attributes
    ----------
    prediction : PredictInputs
    settings : ContactEnsembleSettings
        Half ranges of the inputs.
    measurement : MeasurementInputs
    """

    prediction: PredictInputs
    space: ContactInputs
    settings: ContactEnsembleSettings
    measurement: MeasurementInputs

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> ContactEnsembleInputs:
        """Gather what `contact_ensemble` reads for one test."""
        return cls(
            prediction=PredictInputs.of(campaign, test, CONTACT.name),
            space=ContactInputs.of(campaign, test.specimen),
            settings=campaign.processing.predict.ensemble.contact,
            measurement=MeasurementInputs.of(campaign, test),
        )


def contact_ensemble(
    conditioned: xr.Dataset,
    rocking: xr.Dataset,
    contact: xr.Dataset,
    inputs: ContactEnsembleInputs,
    identified: xr.Dataset | None = None,
) -> xr.Dataset:
    """
    Run the contact model many times on the base motion that was recorded, over what is not known of it.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: cut-offs of the channels on the specimen.
    rocking, contact : xr.Dataset
        As of `predict`.
    inputs : ContactEnsembleInputs
    identified : xr.Dataset, optional
        As of `predict`.

    Returns
    -------
    bands : xr.Dataset
        As of `ensemble`. By `input` it has the standard deviation of values that are equally likely in their range.

    Raises
    ------
    StageError
        As `predict`.
    """
    beginning = begin(rocking, inputs.prediction, identified)
    space, ranges, law = inputs.space, inputs.settings, law_of(contact)
    plan = ContactPlan(
        body_of(space, law),
        law,
        friction=_about(law.friction, ranges.friction * law.friction),
        damping_fraction=_about(law.damping_fraction, ranges.damping_fraction * law.damping_fraction),
        out_of_plane=_about(space.settings.out_of_plane, abs(ranges.out_of_plane)),
        motion=beginning.motion,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        gravity=space.block.gravity,
        step=space.settings.step,
        count=ranges.members,
    )
    try:
        found = gather(plan, [run_member(plan, member) for member in range(plan.count)])
    except ValueError as error:
        raise StageError(f"processing.predict.contact: {error}") from error
    middles = dict(zip(INPUTS, (law.friction, law.damping_fraction, 1.0), strict=True))
    deviations = {name: np.ptp(getattr(plan, name)) / np.sqrt(12.0) / (middles[name] or 1.0) for name in INPUTS}
    start = beginning.theta0 if inputs.prediction.free_vibration else None
    errors = measurement_errors(conditioned, rocking, start, inputs.measurement)
    ranked = rank_measured(rocking, beginning, found, np.zeros(plan.count), errors, inputs.measurement)
    bands = describe_bands(rocking, beginning, found, deviations)
    return bands.assign(ranked).assign_attrs(model=CONTACT.name, members=plan.count, warnings=[])


def _about(middle: float, half: float) -> Range:
    return middle - half, middle + half
