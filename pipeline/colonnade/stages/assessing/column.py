"""The real column of a specimen: its properties, and the limits of what is not known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy

from colonnade.assessment.prototype import Prototype
from colonnade.campaign import assessment as written
from colonnade.campaign.settings import PlaneEnsembleSettings
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.size import at_prototype
from colonnade.dynamics.uncertainty import member_block
from colonnade.stages.parts.inputs import Inputs
from colonnade.stages.specimen import restitution_spread

if TYPE_CHECKING:
    import xarray as xr

USUAL_MARGIN = 0.02
"""To either side of e, if neither limits nor free vibrations are known."""


class ColumnInputs(Inputs):
    """What is read of the campaign about a real column: its model, how many times larger it is, what is assumed.

    `usual_scatter` is the standard deviation of e between tests, if a single one does not show it.
    """

    block: Block
    scale: float
    prototype: written.Prototype
    usual_scatter: float = PlaneEnsembleSettings().restitution


def real_column(inputs: ColumnInputs, pooled: xr.Dataset) -> tuple[Prototype, str]:
    """
    Put together the real column.

    Parameters
    ----------
    inputs : ColumnInputs
    pooled : xr.Dataset
        Result of `specimen`: the e of the model.

    Returns
    -------
    column : Prototype
    source : str
        Of its e: "given", "identified" or "rigid-body".
    """
    given = inputs.prototype
    block = inputs.block if inputs.scale == 1.0 else _enlarged(inputs.block, inputs.scale)
    factors = (
        (1.0 if given.critical_angle is None else given.critical_angle / block.critical_angle),
        (1.0 if given.p is None else given.p / block.p),
    )
    if factors != (1.0, 1.0):
        block = member_block(block, *factors)
    restitution, limits, source = _restitution(inputs, block, pooled)
    column = Prototype(
        block,
        restitution,
        given.friction,
        given.restitution_range or limits,
        given.critical_angle_range,
        given.p_range,
        given.friction_range,
    )
    return column, source


def _enlarged(block: Block, scale: float) -> Block:
    """Enlarge a model of the same material; angles stay, lengths, mass and inertia grow."""
    sides = block.sides
    return Block.measured(
        mass=at_prototype("mass", block.mass, scale),
        pole_distance=(
            at_prototype("length", sides[0].pole_distance, scale),
            at_prototype("length", sides[1].pole_distance, scale),
        ),
        critical_angle=(sides[0].critical_angle, sides[1].critical_angle),
        inertia=(at_prototype("inertia", sides[0].inertia, scale), at_prototype("inertia", sides[1].inertia, scale)),
        gravity=block.gravity,
    )


def _restitution(inputs: ColumnInputs, block: Block, pooled: xr.Dataset) -> tuple[Sided, tuple[float, float], str]:
    """Return e, its limits if none are given (an identified one is that of a new test), and where it comes from."""
    given = inputs.prototype
    if given.restitution != "identified":
        rigid = given.restitution == "rigid-body"
        e = max(block.restitution, 0.0) if rigid else float(given.restitution)
        return e, _around(e), "rigid-body" if rigid else "given"
    negative, positive = (float(each) for each in pooled["side_restitution"])
    e = float(np.mean((negative, positive)))
    source = str(pooled.attrs["restitution_source"])
    margin = USUAL_MARGIN
    if source == "identified":
        deviation, freedom = restitution_spread(pooled, inputs.usual_scatter)
        margin = deviation * float(scipy.stats.t.ppf((1 + float(pooled["level"])) / 2, freedom or np.inf))
    return (e if negative == positive else (negative, positive)), _around(e, margin), source


def _around(e: float, margin: float = USUAL_MARGIN) -> tuple[float, float]:
    return max(e - margin, 0.0), min(e + margin, 1.0)
