"""Predict: recorded base motion, specimen and restitution -> the rocking angle of a model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import History
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.errors import StageError
from colonnade.identification.arcs import find_arcs

Array = NDArray[np.float64]


class Instructions(BaseModel):
    """
    What this stage reads of the campaign: block, model, its rest rule, whether the base is at rest, and how it tilts.

    `tilt` is the table's rotation about +y, rad: with it gravity pulls towards +x.
    """

    model_config = ConfigDict(frozen=True)

    block: Block
    model: str
    rest_angle: float
    free_vibration: bool
    tilt: float = 0.0


@dataclass(frozen=True)
class Beginning:
    """
    Where a prediction begins: the sample, the angle there (rad), and the base motion from there on.

    `base` is the base acceleration of the whole record, m/s²; `motion` has the table's tilt in it.
    """

    first: int
    theta0: float
    base: Array
    motion: Motion


def instructions(campaign: Campaign, test: Test, model: str) -> Instructions:
    """Gather what `predict` reads for one test and model."""
    return Instructions(
        block=campaign.specimens[test.specimen].block(campaign.gravity),
        model=model,
        rest_angle=campaign.processing.predict.rest_angle,
        free_vibration=test.kind == "free-vibration",
        tilt=campaign.setups[test.setup].table_tilt or 0.0,
    )


def predict(rocking: xr.Dataset, specimen: xr.Dataset, instructions: Instructions) -> xr.Dataset:
    """
    Run a model on the base motion that was recorded.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`: `base_acceleration`; of a free vibration, the measured angle that it starts from.
    specimen : xr.Dataset
        Result of `specimen`: `restitution`.
    instructions : Instructions

    Returns
    -------
    predicted : xr.Dataset
        `rocking_angle` on the clock of the record. A free vibration is predicted from the first peak after its first
        impact, where the measured angle is known and the velocity is zero; before it the angle is NaN.

    Raises
    ------
    StageError
        If there is no base motion, or a free vibration shows no arc to start from.
    """
    beginning = begin(rocking, instructions)
    history = rock(
        instructions.block,
        beginning.motion,
        restitution=sides(specimen),
        model=instructions.model,
        theta0=beginning.theta0,
        rest_angle=instructions.rest_angle,
    )
    return _described(history, rocking["elapsed"].to_numpy(), beginning, specimen, instructions)


def begin(rocking: xr.Dataset, instructions: Instructions) -> Beginning:
    """
    Find where a prediction begins and what it is driven by; arguments as of `predict`.

    Raises
    ------
    StageError
        As `predict`.
    """
    time = rocking["elapsed"].to_numpy()
    base = np.zeros_like(time) if instructions.free_vibration else _base_acceleration(rocking)
    first, theta0 = _start(rocking, instructions) if instructions.free_vibration else (0, 0.0)
    # On a tilted table a part of gravity acts along x, as a base acceleration the other way would.
    felt = base[first:] - instructions.block.gravity * np.sin(instructions.tilt)
    return Beginning(first, theta0, base, Motion(felt, float(time[1] - time[0])))


def sides(specimen: xr.Dataset) -> tuple[float, float]:
    """Return e that predictions take, of impacts that end an arc at θ < 0 and at θ > 0."""
    negative, positive = (float(e) for e in specimen["side_restitution"].to_numpy())
    return negative, positive


def _base_acceleration(rocking: xr.Dataset) -> Array:
    if "base_acceleration" not in rocking:
        raise StageError(
            "There is no record of the table's motion along x in this test; a prediction needs one. "
            'Add a channel with on = "table" and quantity = "acceleration" (or "displacement") to its set-up.'
        )
    base = rocking["base_acceleration"].to_numpy()
    missing = int((~np.isfinite(base)).sum())
    if missing:
        where = float(rocking["elapsed"][int(np.argmin(np.isfinite(base)))])
        raise StageError(
            f"The base acceleration misses {missing} of {base.size} samples, the first at {where:.3f} s; all of them "
            "were expected. Give the test a `window` that leaves them out, or mend the channel."
        )
    return base


def _start(rocking: xr.Dataset, instructions: Instructions) -> tuple[int, float]:
    """Sample and angle (rad) of the first peak between two impacts."""
    if "rocking_angle" not in rocking:
        raise StageError("A free vibration without a measured angle has no release to predict from.")
    time = rocking["elapsed"].to_numpy()
    arcs = find_arcs(
        time, rocking["rocking_angle"].to_numpy(), instructions.block.p, lowest=float(rocking["noise_threshold"])
    )
    whole = np.flatnonzero(np.isfinite(arcs.peak_angle))
    if whole.size == 0:
        raise StageError(
            "This free vibration shows no arc between two impacts above the noise; a prediction needs a peak to start "
            "from. Was the specimen released within the record?"
        )
    first = int(np.searchsorted(time, arcs.peak_time[whole[0]]))
    return min(first, time.size - 2), float(arcs.peak_angle[whole[0]])


def _described(
    history: History,
    time: Array,
    beginning: Beginning,
    specimen: xr.Dataset,
    instructions: Instructions,
) -> xr.Dataset:
    first = beginning.first
    angle = np.concatenate((np.full(first, np.nan), history.angle))
    peak = int(np.searchsorted(history.time, history.peak_time))
    return xr.Dataset(
        {
            "rocking_angle": ("elapsed", angle),
            "base_acceleration": ("elapsed", beginning.base),
            "impact_time": ("impact", history.impact_times + time[first]),
            "restitution": ((), float(specimen["restitution"])),
            "peak_angle": ((), float(history.angle[peak])),
            "peak_ratio": ((), np.nan if history.peak_ratio is None else history.peak_ratio),
            "peak_time": ((), history.peak_time + float(time[first])),
            "overturning_time": ((), history.overturning_time + float(time[first])),
            "impact_count": ((), history.impacts),
        },
        coords={"elapsed": ("elapsed", time)},
        attrs={
            "outcome": history.outcome,
            "model": instructions.model,
            "restitution_source": specimen.attrs["restitution_source"],
            "warnings": [],
        },
    )
