"""Stage forecast: the ensemble of a forecast on any motion, and its scores by what was measured."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Dataset, dataset
from colonnade.campaign.forms.forecast import ForecastFile, ForecastInputs
from colonnade.dynamics.ensemble import PlanePlan
from colonnade.dynamics.motion import Motion
from colonnade.errors import StageError
from colonnade.identification.forecasts import Response, forecast_of, randomised_pit, score
from colonnade.stages.parts.beginning import base_acceleration
from colonnade.store.provenance import Inputs

BASES = ("on_target", "on_recorded", "rigid_body")
"""As it was forecast; its frozen inputs on the recorded base motion; as forecast, with the e of the rigid body."""

SCORES = ("crps", "ranked_probability", "brier", "logarithmic")


class ForecastScoreInputs(Inputs):
    """Name of the forecast's file; its content enters the result's key by its hash."""

    file: str


def score_forecast(rocking: Dataset, forecast: ForecastFile, inputs: ForecastScoreInputs) -> Dataset:
    """
    Score a forecast by what was measured.

    Parameters
    ----------
    rocking : Dataset
        Result of `rocking`: outcome, peak, base motion.
    forecast : ForecastFile
    inputs : ForecastScoreInputs

    Returns
    -------
    scores : Dataset
        By `model` and by `basis` (`BASES`) the scores of `identification.verification`, and the probability integral
        transform; `observed_amplitude`. Without a measured angle there are none, without a recorded base motion
        those on it are NaN; the attribute `reason` says so.
    """
    attributes = {"file": inputs.file, "reason": "", "warnings": []}
    if "rocking_angle" not in rocking:
        return dataset({}, attrs=attributes | {"reason": "its rocking angle was not measured"})
    outcome = str(rocking.attrs["outcome"])
    observed = Response.observed(outcome, float(rocking["peak_ratio"]))
    motion = None
    try:
        time = rocking["elapsed"].to_numpy()
        motion = felt(forecast.inputs, Motion(base_acceleration(rocking), float(time[1] - time[0])))
    except StageError as error:
        attributes["reason"] = str(error)
    names = list(forecast.models)
    found = np.full((len(SCORES) + 2, len(names), len(BASES)), np.nan)
    for row, (name, model) in enumerate(forecast.models.items()):
        ensembles = {
            "on_target": forecast_of(model.peak_ratio),
            "rigid_body": forecast_of(model.rigid_body_peak_ratio),
        }
        if motion is not None:
            ensembles["on_recorded"] = forecast_of(plan_of(forecast.inputs, name, motion).run().peak_ratio)
        for basis, ensemble in ensembles.items():
            scores = score(ensemble, observed)
            # A draw of its own for each file, the same in each run.
            seed = int(forecast.motion.sha256[:8], 16) ^ int(forecast.made.timestamp())
            pit = float(randomised_pit([ensemble], [observed], seed=seed)[0])
            values = [*(scores[each] for each in SCORES), pit, ensemble.overturning_probability]
            found[:, row, BASES.index(basis)] = values
    variables = [f"forecast_{name}" for name in (*SCORES, "pit", "overturning_probability")]
    return dataset(
        {name: (("model", "basis"), values) for name, values in zip(variables, found, strict=True)}
        | {"observed_amplitude": ((), observed.amplitude)},
        coords={"model": np.array(names, dtype=object), "basis": np.array(BASES, dtype=object)},
        attrs=attributes | {"outcome": outcome},
    )


def felt(inputs: ForecastInputs, motion: Motion) -> Motion:
    """Add the table's tilt to its motion along x: a part of gravity acts as a base acceleration the other way would."""
    pull = inputs.block.gravity * np.sin(inputs.table_tilt)
    return Motion(motion.acceleration - pull, motion.dt)


def plan_of(inputs: ForecastInputs, model: str, motion: Motion, *, rigid_body: bool = False) -> PlanePlan:
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
    return PlanePlan(
        block=inputs.block.block(),
        motion=motion,
        restitution=inputs.restitution.rigid_body if rigid_body else inputs.restitution.value,
        uncertainty=inputs.spread.uncertainty(),
        count=inputs.members,
        seed=inputs.seed,
        model=model,
        rest_angle=inputs.rest_angle,
    )
