"""Ensemble: recorded base motion, specimen and uncertain inputs -> bands of a model, probability of overturning."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.channel import ALONG
from colonnade.campaign.settings import PlaneEnsembleSettings
from colonnade.dynamics.ensemble import PlanePlan
from colonnade.dynamics.uncertainty import INPUTS, Uncertainty
from colonnade.identification.response.rank import Measurement
from colonnade.stages.parts.beginning import RECORDED, begin
from colonnade.stages.parts.inputs import Inputs
from colonnade.stages.parts.rank import MeasurementInputs, describe_bands, measurement_errors, rank_measured
from colonnade.stages.parts.transducers import transducers
from colonnade.stages.predict import PredictInputs, sides
from colonnade.stages.specimen import centre, spread_of

if TYPE_CHECKING:
    import xarray as xr


class EnsembleInputs(Inputs):
    """
    What `ensemble` reads of the campaign for one test and model.

    Attributes
    ----------
    prediction : PredictInputs
    settings : PlaneEnsembleSettings
    filter_order : int
    table : tuple of str
        Accelerometers of the table along x, by the names of their variables.
    measurement : MeasurementInputs
    """

    prediction: PredictInputs
    settings: PlaneEnsembleSettings
    filter_order: int
    table: tuple[str, ...]
    measurement: MeasurementInputs

    @classmethod
    def of(cls, campaign: Campaign, test: Test, model: str) -> EnsembleInputs:
        """Gather what `ensemble` reads for one test and model."""
        along = transducers(campaign.channels(test)).accelerations
        return cls(
            prediction=PredictInputs.of(campaign, test, model),
            settings=campaign.ensemble_settings(test.specimen),
            filter_order=campaign.processing.filter_order,
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
        `member_overturning_time`; by `input` its standard deviation and `peak_sensitivity`; what `rank_measured` adds.

    Raises
    ------
    StageError
        As `predict`.
    """
    block = centre(specimen, inputs.prediction.block)
    beginning = begin(rocking, inputs.prediction, identified, block)
    start = beginning.theta0 if inputs.prediction.free_vibration else None
    errors = measurement_errors(conditioned, rocking, start, inputs.measurement)
    plan = PlanePlan(
        block=block,
        motion=beginning.motion,
        restitution=sides(specimen),
        uncertainty=_uncertainty(conditioned, specimen, errors, inputs, is_driven=beginning.driven_by == RECORDED),
        count=inputs.settings.members,
        model=inputs.prediction.model,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        rest_angle=inputs.prediction.rest_angle,
    )
    found = plan.run()
    deviations = dict(zip(INPUTS, plan.uncertainty.deviations.tolist(), strict=True))
    starts = found.inputs[:, INPUTS.index("theta0")]
    bands = describe_bands(rocking, beginning, found, deviations)
    return bands.assign(rank_measured(rocking, beginning, found, starts, errors, inputs.measurement)).assign_attrs(
        model=plan.model,
        members=plan.count,
        noise=plan.uncertainty.noise,
        cutoff_hz=plan.uncertainty.cutoff,
        warnings=[],
    )


def _uncertainty(
    conditioned: xr.Dataset,
    specimen: xr.Dataset,
    errors: Measurement,
    inputs: EnsembleInputs,
    *,
    is_driven: bool,
) -> Uncertainty:
    noise, cutoff = _base_noise(conditioned, inputs.table) if is_driven else (0.0, None)
    return replace(
        spread_of(specimen, inputs.settings),
        gain=inputs.settings.gain if is_driven else 0.0,
        clock=inputs.settings.clock,
        noise=noise,
        cutoff=cutoff,
        filter=0.0 if cutoff is None else inputs.settings.filter,
        filter_order=inputs.filter_order,
        theta0=errors.start_deviation,
    )


def _base_noise(conditioned: xr.Dataset, table: tuple[str, ...]) -> tuple[float, float | None]:
    """Noise (m/s²) and cut-off (Hz) of the mean of the table's accelerometers; 0 and None without one."""
    used = [conditioned[name].attrs for name in table if name in conditioned]
    if not used:
        return 0.0, None
    noise = np.array([float(given.get("noise", 0.0)) for given in used])
    cutoff = min((float(given["cutoff_hz"]) for given in used if "cutoff_hz" in given), default=None)
    return float(np.sqrt(np.sum(noise**2))) / noise.size, cutoff
