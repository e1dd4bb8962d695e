"""Ensemble of the contact model: over its friction, its damping, and how straight the specimen stood at the start."""

from __future__ import annotations

import numpy as np
import xarray as xr
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.contact.ensembles import INPUTS, ContactPlan, Range, gather, run_member
from colonnade.dynamics.ensembles import stride_of
from colonnade.errors import StageError
from colonnade.stages import contact as contact_stage
from colonnade.stages import predict, verdict
from colonnade.stages.beginning import begin
from colonnade.stages.ensemble import described


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    prediction : predict.Instructions
    space : contact_stage.Instructions
    runs : int
    friction_range, damping_range : float
        Half of the range, over the value that it lies about.
    out_of_plane_range : float
        Half of the range, rad.
    verdict : verdict.Instructions
    """

    model_config = ConfigDict(frozen=True)

    prediction: predict.Instructions
    space: contact_stage.Instructions
    runs: int
    friction_range: float
    damping_range: float
    out_of_plane_range: float
    verdict: verdict.Instructions


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `contact_ensemble` reads for one test."""
    settings = campaign.processing.predict.ensemble.contact
    return Instructions(
        prediction=predict.instructions(campaign, test, "contact"),
        space=contact_stage.instructions(campaign, test.specimen),
        runs=settings.members,
        friction_range=settings.friction,
        damping_range=settings.damping_fraction,
        out_of_plane_range=abs(settings.out_of_plane),
        verdict=verdict.instructions(campaign, test),
    )


def contact_ensemble(
    conditioned: xr.Dataset,
    rocking: xr.Dataset,
    contact: xr.Dataset,
    instructions: Instructions,
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
    instructions : Instructions
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
    beginning = begin(rocking, instructions.prediction, identified)
    settings, law = instructions.space.settings, contact_stage.law_of(contact)
    plan = ContactPlan(
        contact_stage.body_of(instructions.space),
        law,
        friction=_about(law.friction, instructions.friction_range * law.friction),
        damping_fraction=_about(law.damping_fraction, instructions.damping_range * law.damping_fraction),
        out_of_plane=_about(settings.out_of_plane, instructions.out_of_plane_range),
        motion=beginning.motion,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        gravity=instructions.space.block.gravity,
        step=settings.step,
        count=instructions.runs,
    )
    try:
        found = gather(plan, [run_member(plan, member) for member in range(plan.count)])
    except ValueError as error:
        raise StageError(f"processing.predict.contact: {error}") from error
    middles = dict(zip(INPUTS, (law.friction, law.damping_fraction, 1.0), strict=True))
    deviations = {name: np.ptp(getattr(plan, name)) / np.sqrt(12.0) / (middles[name] or 1.0) for name in INPUTS}
    time = rocking["elapsed"].to_numpy()[beginning.first :: stride_of(beginning.motion)]
    bands = described(found, time, deviations)
    start = beginning.theta0 if instructions.prediction.free_vibration else None
    errors = verdict.measurement(conditioned, rocking, start, instructions.verdict)
    held = verdict.held(rocking, beginning, found, np.zeros(plan.count), errors, instructions.verdict)
    return bands.assign(held).assign_attrs(model="contact", members=plan.count, warnings=[])


def _about(middle: float, half: float) -> Range:
    return middle - half, middle + half
