"""Restitution: the rocking angle of a free vibration -> impacts, peaks, e with its interval."""

from __future__ import annotations

import numpy as np
import xarray as xr
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.rock import MODELS
from colonnade.errors import StageError
from colonnade.identification.history_fit import METHOD as HISTORY_METHOD
from colonnade.identification.history_fit import fit_history
from colonnade.identification.restitution import identify_restitution


class Instructions(BaseModel):
    """What this stage reads of the campaign: the block, and how e is identified."""

    model_config = ConfigDict(frozen=True)

    block: Block
    level: float
    lowest_amplitude: float


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `restitution` reads for one free vibration."""
    return Instructions(
        block=campaign.specimens[test.specimen].block(campaign.gravity),
        level=campaign.processing.restitution.level,
        lowest_amplitude=campaign.processing.restitution.lowest_amplitude,
    )


def restitution(rocking: xr.Dataset, instructions: Instructions) -> xr.Dataset:
    """
    Identify e from one free vibration.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    instructions : Instructions

    Returns
    -------
    identified : xr.Dataset
        The peaks, fitted and measured, and `restitution` with its interval; beside it `restitution_history`, from the
        whole history by each model. Where e cannot be identified it is NaN and the attribute `reason` (of the
        histories, `history_reason`) says why: that is a result, not a failure.

    Raises
    ------
    StageError
        If no transducer was on the specimen.
    """
    if "rocking_angle" not in rocking:
        raise StageError(
            "A free vibration without a usable displacement transducer on the specimen gives no restitution; "
            'at least one channel with on = "specimen" and quantity = "displacement" was expected.'
        )
    time, angle = rocking["elapsed"].to_numpy(), rocking["rocking_angle"].to_numpy()
    result = identify_restitution(
        time,
        angle,
        instructions.block,
        level=instructions.level,
        lowest_amplitude=instructions.lowest_amplitude,
        noise=float(np.nanmedian(rocking["rocking_angle_standard_error"])),
    )
    histories = [fit_history(time, angle, instructions.block, result, model=model) for model in MODELS]
    warnings = [f"No restitution from this test: {result.reason}"] if result.reason else []
    # The linear model is an approximation, and is off by more than these errors where angles are large.
    warnings += [text for each in histories if each.model == "nonlinear" if (text := each.disagreement(result))]
    scalars = {
        "restitution": result.value,
        "restitution_low": result.low,
        "restitution_high": result.high,
        "restitution_standard_error": result.standard_error,
        "level": result.level,
        "zero_offset": result.zero_offset,
    }
    columns = {
        "peak_time": result.peaks.time,
        "peak_angle": result.peaks.angle,
        "peak_angle_standard_error": result.peaks.standard_error,
        "fitted_angle": result.peaks.fitted_angle,
        "peak_used": result.peaks.used.astype(np.int8),
    }
    by_model = {
        "restitution_history": [each.value for each in histories],
        "restitution_history_low": [each.low for each in histories],
        "restitution_history_high": [each.high for each in histories],
        "restitution_history_standard_error": [each.standard_error for each in histories],
        "restitution_history_residual": [each.residual for each in histories],
    }
    return xr.Dataset(
        {name: ((), np.nan if value is None else value) for name, value in scalars.items()}
        | {name: ("peak", values) for name, values in columns.items()}
        | {name: ("model", np.array(values, dtype=np.float64)) for name, values in by_model.items()},
        coords={"model": ("model", np.array(MODELS, dtype=object))},
        attrs={
            "method": result.method,
            "reason": result.reason,
            "history_method": HISTORY_METHOD,
            "history_reason": " ".join(dict.fromkeys(each.reason for each in histories if each.reason)),
            "warnings": warnings,
        },
    )
