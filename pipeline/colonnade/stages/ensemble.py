"""Ensemble: recorded base motion, specimen and what is not exactly known -> bands of a model, odds of overturning."""

from __future__ import annotations

from collections.abc import Mapping
from statistics import NormalDist

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.campaign.channel import ALONG
from colonnade.dynamics.ensembles import Ensemble, Plan, gather, run_members
from colonnade.dynamics.uncertainty import INPUTS, Uncertainty
from colonnade.identification.as_measured import Measurement
from colonnade.stages import predict, verdict
from colonnade.stages.beginning import RECORDED, begin
from colonnade.stages.transducers import transducers

Array = NDArray[np.float64]


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    prediction : predict.Instructions
    members : int
    restitution, critical_angle, p, gain, clock, filter : float
        Standard deviations: of e where no interval was identified, of the others relative.
    filter_order : int
    table : tuple of str
        Accelerometers of the table along x, by the names of their variables.
    verdict : verdict.Instructions
    """

    model_config = ConfigDict(frozen=True)

    prediction: predict.Instructions
    members: int
    restitution: float
    critical_angle: float
    p: float
    gain: float
    clock: float
    filter: float
    filter_order: int
    table: tuple[str, ...]
    verdict: verdict.Instructions


def instructions(campaign: Campaign, test: Test, model: str) -> Instructions:
    """Gather what `ensemble` reads for one test and model."""
    settings = campaign.processing.predict.ensemble
    along = transducers(campaign.channels(test)).accelerations
    return Instructions(
        prediction=predict.instructions(campaign, test, model),
        members=settings.members,
        restitution=settings.restitution,
        critical_angle=settings.critical_angle,
        p=settings.p,
        gain=settings.gain,
        clock=settings.clock,
        filter=settings.filter,
        filter_order=campaign.processing.filter_order,
        table=tuple(name for name, direction in along.items() if abs(direction[0]) >= ALONG),
        verdict=verdict.instructions(campaign, test),
    )


def ensemble(
    conditioned: xr.Dataset,
    rocking: xr.Dataset,
    specimen: xr.Dataset,
    instructions: Instructions,
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
    instructions : Instructions
    identified : xr.Dataset, optional
        As of `predict`.

    Returns
    -------
    bands : xr.Dataset
        `rocking_angle_band` by `quantile` on the record's clock, from where the prediction starts; the
        `overturning_probability` with its interval; `member_peak_ratio` (NaN where it overturns) and
        `member_overturning_time`; by `input` its standard deviation and `peak_sensitivity`; what `verdict.held` adds.

    Raises
    ------
    StageError
        As `predict`.
    """
    beginning = begin(rocking, instructions.prediction, identified)
    start = beginning.theta0 if instructions.prediction.free_vibration else None
    errors = verdict.measurement(conditioned, rocking, start, instructions.verdict)
    plan = Plan(
        instructions.prediction.block,
        beginning.motion,
        predict.sides(specimen),
        _uncertainty(conditioned, specimen, errors, instructions, is_driven=beginning.driven_by == RECORDED),
        count=instructions.members,
        model=instructions.prediction.model,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        rest_angle=instructions.prediction.rest_angle,
    )
    found = gather(plan, [run_members(plan, 0, plan.count)])
    deviations = dict(zip(INPUTS, plan.uncertainty.deviations.tolist(), strict=True))
    bands = described(found, rocking["elapsed"].to_numpy()[beginning.first :: plan.stride], deviations)
    starts = found.inputs[:, INPUTS.index("theta0")]
    held = verdict.held(rocking, beginning, found, starts, errors, instructions.verdict)
    return bands.assign(held).assign_attrs(
        model=plan.model,
        members=plan.count,
        noise=plan.uncertainty.noise,
        cutoff_hz=plan.uncertainty.cutoff,
        warnings=[],
    )


def described(found: Ensemble, time: Array, deviations: Mapping[str, float]) -> xr.Dataset:
    """
    Put an ensemble into a dataset.

    Parameters
    ----------
    found : Ensemble
    time : ndarray, shape (n,)
        Of its bands, on the record's clock, s.
    deviations : mapping of str to float
        Standard deviation of each input.
    """
    low, high = found.overturning_interval()
    sensitivity = found.sensitivity()
    return xr.Dataset(
        {
            "rocking_angle": ("elapsed", found.central),
            "rocking_angle_band": (("quantile", "elapsed"), found.bands),
            "overturning_probability": ((), found.overturning_probability),
            "overturning_probability_low": ((), low),
            "overturning_probability_high": ((), high),
            "member_peak_ratio": ("member", found.peak_ratio),
            "member_overturning_time": ("member", found.overturning_time + float(time[0])),
            "input_deviation": ("input", np.array([deviations[name] for name in sensitivity])),
            "peak_sensitivity": ("input", np.array(list(sensitivity.values()))),
        },
        coords={
            "elapsed": ("elapsed", time),
            "quantile": ("quantile", found.levels),
            "input": ("input", np.array(list(sensitivity), dtype=object)),
        },
    )


def _uncertainty(
    conditioned: xr.Dataset,
    specimen: xr.Dataset,
    errors: Measurement,
    instructions: Instructions,
    *,
    is_driven: bool,
) -> Uncertainty:
    half = (float(specimen["restitution_high"]) - float(specimen["restitution_low"])) / 2
    identified = half / NormalDist().inv_cdf(0.5 + float(specimen["level"]) / 2)
    noise, cutoff = _base_noise(conditioned, instructions.table) if is_driven else (0.0, None)
    return Uncertainty(
        restitution=identified if np.isfinite(identified) else instructions.restitution,
        critical_angle=instructions.critical_angle,
        p=instructions.p,
        gain=instructions.gain if is_driven else 0.0,
        clock=instructions.clock,
        noise=noise,
        cutoff=cutoff,
        filter=0.0 if cutoff is None else instructions.filter,
        filter_order=instructions.filter_order,
        theta0=errors.start_deviation,
    )


def _base_noise(conditioned: xr.Dataset, table: tuple[str, ...]) -> tuple[float, float | None]:
    """Noise (m/s²) and cut-off (Hz) of the mean of the table's accelerometers; none where there is none."""
    used = [conditioned[name].attrs for name in table if name in conditioned]
    if not used:
        return 0.0, None
    noise = np.array([float(given.get("noise", 0.0)) for given in used])
    cutoff = min((float(given["cutoff_hz"]) for given in used if "cutoff_hz" in given), default=None)
    return float(np.sqrt(np.sum(noise**2))) / noise.size, cutoff
