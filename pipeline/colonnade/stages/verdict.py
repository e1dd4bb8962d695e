"""The measured angle beside the runs of a model: how far it is from them, and up to which time that says anything."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles import Ensemble, stride_of
from colonnade.dynamics.history import capped
from colonnade.identification.as_measured import Measurement, as_measured
from colonnade.identification.verdict import distances
from colonnade.stages.beginning import Beginning
from colonnade.stages.transducers import transducers

Array = NDArray[np.float64]

SEED = 22
"""Of the measurement errors of the runs; they are the same in every run of the stage."""


class Instructions(BaseModel):
    """
    What the verdict reads of the campaign.

    Attributes
    ----------
    block : Block
    angle_gain : float
        Standard deviation of the calibration of the measured angle, relative.
    angle_zero : float
        Standard deviation of its zero, of α.
    horizon : float
        Width of the 95 % band, of α, up to which a history is predicted.
    filter_order : int
    channels : tuple of str
        Transducers on the specimen, by the names of their variables.
    """

    model_config = ConfigDict(frozen=True)

    block: Block
    angle_gain: float
    angle_zero: float
    horizon: float
    filter_order: int
    channels: tuple[str, ...]


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what the verdict reads for one test."""
    settings = campaign.processing.predict.ensemble
    return Instructions(
        block=campaign.specimens[test.specimen].block(campaign.gravity),
        angle_gain=settings.angle_gain,
        angle_zero=settings.angle_zero,
        horizon=settings.horizon,
        filter_order=campaign.processing.filter_order,
        channels=transducers(campaign.channels(test)).on_specimen,
    )


def measurement(
    conditioned: xr.Dataset, rocking: xr.Dataset, start: float | None, instructions: Instructions
) -> Measurement:
    """
    Gather the errors of a measured angle.

    Parameters
    ----------
    conditioned, rocking : xr.Dataset
        Results of `condition` and `rocking`.
    start : float or None
        Measured angle that the model starts from, rad; None if it starts at rest.
    instructions : Instructions
    """
    time = rocking["elapsed"].to_numpy()
    error = float(rocking["rocking_angle_standard_error"]) if "rocking_angle" in rocking else 0.0
    drift = float(rocking["rocking_angle_drift"]) / np.sqrt(3) if "rocking_angle" in rocking else 0.0
    is_integrated = "angle_deviation" in rocking
    cutoffs = [conditioned[name].attrs.get("cutoff_hz") for name in instructions.channels if name in conditioned]
    known = [float(each) for each in cutoffs if each is not None]
    return Measurement(
        interval=float(time[1] - time[0]),
        gain=instructions.angle_gain,
        zero=max(instructions.angle_zero * instructions.block.critical_angle, drift),
        noise=0.0 if is_integrated else float(np.sqrt(max(error**2 - drift**2, 0.0))),
        drift=rocking["angle_deviation"].to_numpy() if is_integrated else np.zeros(time.size),
        cutoff_hz=min(known, default=None),
        filter_order=instructions.filter_order,
        start=start,
        start_error=0.0 if start is None else error,
    )


def held(
    rocking: xr.Dataset,
    beginning: Beginning,
    found: Ensemble,
    starts: Array,
    errors: Measurement,
    instructions: Instructions,
) -> dict[str, Any]:
    """
    Hold the measured angle against the runs of a model.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    beginning : Beginning
        Of the prediction.
    found : Ensemble
    starts : ndarray, shape (members,)
        By how much each run began above the measured start, rad.
    errors : Measurement
        Of the measured angle, as of `measurement`.
    instructions : Instructions

    Returns
    -------
    variables : dict
        `horizon`, s; if an angle was measured and there are runs enough, `measured_distance`, and on `judged_member`
        the `member_distance` of the runs.
    """
    first, stride = beginning.first, stride_of(beginning.motion)
    time = rocking["elapsed"].to_numpy()[first::stride]
    horizon = found.horizon(instructions.horizon * instructions.block.critical_angle) + float(time[0])
    variables: dict[str, Any] = {"horizon": ((), horizon)}
    if "rocking_angle" not in rocking:
        return variables
    angle = rocking["rocking_angle"].to_numpy()[first::stride] - beginning.zero_offset
    measured = capped(time, angle, float(rocking["overturning_time"]), instructions.block)
    thinned = errors.thinned(first, stride)
    recorded = as_measured(found.histories, starts[: len(found.histories)], thinned, np.random.default_rng(SEED))
    seen = time <= horizon
    compared = distances(measured[seen], recorded[:, seen])
    if compared is None:
        return variables
    return variables | {
        "measured_distance": ((), compared.measured),
        "member_distance": ("judged_member", compared.members),
    }
