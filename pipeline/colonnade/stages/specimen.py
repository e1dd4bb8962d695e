"""Specimen: what all free vibrations of a specimen say together, and the e that predictions take."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.identification.restitution.pooling import pool


class Instructions(BaseModel):
    """What this stage reads of the campaign: the block, the restitution given in the file, the interval's level."""

    model_config = ConfigDict(frozen=True)

    block: Block
    given: Sided | None
    level: float


def instructions(campaign: Campaign, specimen: str) -> Instructions:
    """Gather what `specimen` reads for one specimen."""
    entry = campaign.specimens[specimen]
    return Instructions(
        block=entry.block(campaign.gravity), given=entry.restitution, level=campaign.processing.restitution.level
    )


def specimen(identified: Mapping[str, xr.Dataset], instructions: Instructions) -> xr.Dataset:
    """
    Pool the restitution of a specimen's free vibrations.

    Parameters
    ----------
    identified : mapping of str to xr.Dataset
        Results of `restitution` by test id; those that were refused carry NaN.
    instructions : Instructions

    Returns
    -------
    pooled : xr.Dataset
        `side_restitution` (θ < 0, θ > 0) that predictions take and `restitution`, their mean: the one given in the
        campaign file, else the identified one, else the rigid-body value; `restitution_source` says which.
    """
    tests = sorted(name for name, result in identified.items() if np.isfinite(float(result["restitution"])))
    refused = [f"{name}: {result.attrs['reason']}" for name, result in sorted(identified.items()) if name not in tests]
    values = np.array([float(identified[name]["restitution"]) for name in tests])
    errors = np.array([float(identified[name]["restitution_standard_error"]) for name in tests])
    block = instructions.block
    attributes = {"method": "", "reason": "", "warnings": []}
    low = high = between = np.nan
    if instructions.given is not None:
        value = pair(instructions.given)
        attributes |= {"restitution_source": "given", "method": "given in the campaign file"}
    elif tests:
        pooled = pool(values, errors, level=instructions.level)
        value, low, high, between = pair(pooled.value), pooled.low, pooled.high, pooled.between
        count = f"{len(tests)} free vibration{'s' if len(tests) > 1 else ''}"
        method = identified[tests[0]].attrs["method"]
        attributes |= {"restitution_source": "identified", "method": f"{method}; random effects over {count}"}
    else:
        value = pair(block.restitution)
        attributes |= {
            "restitution_source": "rigid-body",
            "method": "rigid body without bounce, 1 − (2 m R b/I₀) sin α (Housner 1963)",
            "reason": "; ".join(refused) or "no free vibration of this specimen was identified",
        }
    return xr.Dataset(
        {
            "side_restitution": ("side", np.array(value)),
            "restitution": ((), float(np.mean(value))),
            "restitution_low": ((), low),
            "restitution_high": ((), high),
            "between_test_scatter": ((), between),
            "level": ((), instructions.level),
            "rigid_restitution": ((), block.restitution),
            "critical_angle": ((), block.critical_angle),
            "pole_distance": ((), block.pole_distance),
            "inertia": ((), block.inertia),
            "p": ((), block.p),
            "test_restitution": ("test", values),
            "test_restitution_standard_error": ("test", errors),
        },
        coords={"test_id": ("test", np.array(tests, dtype=object))},
        attrs=attributes,
    )
