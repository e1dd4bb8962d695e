"""The ensemble of a forecast: the models, with the inputs that it froze, on any base motion along x."""

from __future__ import annotations

import numpy as np

from colonnade.campaign.forms.forecast import ForecastInputs
from colonnade.dynamics.ensembles.ensemble import Plan, gather, run_members
from colonnade.dynamics.ensembles.outcome import Ensemble
from colonnade.dynamics.motion import Motion


def felt(inputs: ForecastInputs, motion: Motion) -> Motion:
    """Add the table's tilt to its motion along x: a part of gravity acts as a base acceleration the other way would."""
    pull = inputs.block.gravity * np.sin(inputs.table_tilt)
    return Motion(motion.acceleration - pull, motion.dt)


def plan_of(inputs: ForecastInputs, model: str, motion: Motion, *, rigid_body: bool = False) -> Plan:
    """
    Plan the ensemble of a forecast.

    Parameters
    ----------
    inputs : ForecastInputs
    model : str
    motion : Motion
        Of the table, with its tilt in it.
    rigid_body : bool, optional
        Take the e of the rigid body: the reference.
    """
    return Plan(
        inputs.block.block(),
        motion,
        inputs.restitution.rigid_body if rigid_body else inputs.restitution.value,
        inputs.spread.uncertainty(),
        count=inputs.members,
        seed=inputs.seed,
        model=model,
        rest_angle=inputs.rest_angle,
    )


def run_forecast(plan: Plan) -> Ensemble:
    """Run all members."""
    return gather(plan, [run_members(plan, 0, plan.count)])
