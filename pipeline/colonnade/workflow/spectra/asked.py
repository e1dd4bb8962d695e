"""The column that a spectrum is asked for, and the base motion."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import Literal

from colonnade import units
from colonnade.assessment.ground import NONE, Ground, corrected
from colonnade.campaign import Campaign
from colonnade.campaign.syntax.fields import BETWEEN, outside
from colonnade.dynamics.block import Block, pair
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError, UnitError
from colonnade.stages.assessing.column import real_column
from colonnade.store.layout import Layout
from colonnade.units.text import number
from colonnade.workflow.real_column import AskedColumn, find_column


@dataclass(frozen=True)
class Column:
    """
    The column of a spectrum.

    Attributes
    ----------
    name : str
    block : Block
    restitution : pair of float
        e of impacts that end an arc at θ < 0, and at θ > 0.
    restitution_source : str
        given, identified or rigid-body.
    scale : float or None
        How many times larger it is than what the campaign tests; None if that is not said.
    """

    name: str
    block: Block
    restitution: tuple[float, float]
    restitution_source: str
    scale: float | None = 1.0


@dataclass(frozen=True)
class AskedMotion:
    """
    What says which motion.

    Attributes
    ----------
    name : str
        A file, a test that recorded it, a motion that tests name or one of [motions].
    unit, interval : str or None
        Of a file that does not give them; the interval with its unit.
    column : str or None
        Name or number of the column of a file.
    peak : str or None
        Acceleration that it is brought to, with its unit.
    baseline : str
        Name of a correction.
    """

    name: str
    unit: str | None = None
    interval: str | None = None
    column: str | None = None
    peak: str | None = None
    baseline: str = NONE


def column_of(asked: AskedColumn, campaign: Campaign | None, layout: Layout | None) -> Column:
    """
    Make the column that is asked for; a specimen stands for itself unless options make it another column.

    Raises
    ------
    CampaignError
        If it is not said, or an option is out of its range.
    """
    found = find_column(asked, campaign, layout)
    try:
        column, source = real_column(found.inputs, found.pooled)
    except ValueError as error:
        raise CampaignError(f"The column cannot be: {error}.") from None
    block, scale = column.block, found.inputs.scale
    if found.specimen is None:
        name = f"α = {block.critical_angle:.4g} rad, p = {block.p:.4g} rad/s"
    else:
        name = found.specimen if scale == 1.0 else f"{found.specimen}, {scale:g} times larger"
    return Column(name, block, pair(column.restitution), source, None if asked.has_own_size else scale)


def motion_of(
    asked: AskedMotion, campaign: Campaign | None, layout: Layout | None, scale: float | None = 1.0
) -> tuple[Motion, str, bool]:
    """
    Find the base motion that is asked for, where it comes from, and whether it was recorded on a table.

    What a campaign recorded is in the time of its model. It is stretched by the root of the scale of the column; if
    that is not said (None), of the specimen that was tested.

    Raises
    ------
    CampaignError
        If there is no such motion, only its shape or not its scale is known, or an option is out of its range.
    ReadError
        If its file cannot be read.
    """
    motion, source, kind = _found(asked, campaign, layout, scale)
    peak = _quantity("--peak", asked.peak, "acceleration")
    if peak is None and kind == "shape":
        raise CampaignError(f'--motion {asked.name}: it is {source}. Give its peak acceleration, --peak "0.3 g".')
    factor = 1.0
    if peak is not None:
        if not motion.peak > 0.0:
            raise CampaignError(f"--motion {asked.name}: it does not move, so that it cannot be brought to --peak.")
        factor, source = peak / motion.peak, f"{source}, brought to a peak of {asked.peak}"
    if asked.baseline != NONE:
        source = f"{source}, baseline corrected: {asked.baseline}"
    try:
        base = corrected(Ground(factor * motion.acceleration, motion.dt), asked.baseline).acceleration
    except ValueError as error:
        raise CampaignError(f"--baseline {error}") from None
    vertical = None if motion.vertical is None else abs(factor) * motion.vertical
    return Motion(base, motion.dt, vertical), source, kind == "table"


def _found(
    asked: AskedMotion, campaign: Campaign | None, layout: Layout | None, scale: float | None
) -> tuple[Motion, str, Literal["file", "shape", "table"]]:
    """Return the motion in the time of the column, its source, and what is known of it: its shape alone or all."""
    from colonnade.readers.motion import read_motion

    path = Path(asked.name)
    options = {"--unit": asked.unit, "--interval": asked.interval, "--column": asked.column}
    given = [name for name, value in options.items() if value is not None]
    if path.is_file() or campaign is None or layout is None or given:
        if not path.is_file():
            raise CampaignError(f"--motion {asked.name}: there is no such file{' and no campaign' * (not campaign)}.")
        column = int(asked.column) if asked.column is not None and asked.column.isdigit() else asked.column
        interval = _quantity("--interval", asked.interval, "time")
        return read_motion(path, unit=asked.unit, dt=interval, column=column), f"file {path.name}", "file"
    from colonnade.workflow.forecasting.motions import motion_asked_for

    found = motion_asked_for(campaign, layout, asked.name, None, None)
    if found.test is None:
        return found.motion, found.source, "shape"
    own = found.test.specimen
    if not (scale := scale or campaign.specimens[own].scale):
        raise CampaignError(
            f"--motion {asked.name}: it was recorded in the time of the model {own}, and how many times larger the "
            f"column is, is not known. Give the `scale` of specimens.{own}, or --specimen {own} with --scale (1 for "
            "its own size)."
        )
    if scale == 1.0:
        return found.motion, found.source, "table"
    slower = sqrt(scale)
    source = f"{found.source}, {number(slower)} times slower for a column {scale:g} times larger"
    return Motion(found.motion.acceleration, found.motion.dt * slower), source, "table"


def _quantity(option: str, given: str | None, dimension: str) -> float | None:
    return None if given is None else quantity_of(option, given, dimension)


def quantity_of(option: str, given: str, dimension: str) -> float:
    """
    Read a positive quantity with its unit, SI.

    Raises
    ------
    CampaignError
        If it is not one; the message names the option.
    """
    try:
        value = units.to_si(given, dimension)
    except UnitError as error:
        raise CampaignError(f"{option} {given}: {error}") from None
    if expected := outside(value, BETWEEN[dimension], units.DIMENSIONS[dimension][0]):
        raise CampaignError(f"{option} {given}: {expected}")
    if not value > 0.0:
        raise CampaignError(f"{option} {given}: a positive {dimension} was expected.")
    return value
