"""The column that a spectrum is asked for, and the base motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, sqrt
from pathlib import Path

from colonnade import units
from colonnade.assessment.intensity.baselines import NONE, corrected
from colonnade.assessment.intensity.ground import Ground
from colonnade.campaign import Campaign
from colonnade.campaign.syntax.bounds import BETWEEN, outside
from colonnade.dynamics.block import Block, pair
from colonnade.dynamics.ensembles.uncertainty import member_block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.spectra.spectrum import rectangular
from colonnade.errors import CampaignError, UnitError, nearest
from colonnade.store.layout import Layout

IDENTIFIED, RIGID_BODY = "identified", "rigid-body"
"""Words for e in place of its value."""


@dataclass(frozen=True)
class AskedColumn:
    """
    What says which column.

    Attributes
    ----------
    specimen : str or None
        Id; the only one of a campaign if neither it nor α and p are given.
    scale : float
        How many times larger than the specimen it is.
    critical_angle, p : str or None
        With their units; in place of those of the specimen.
    restitution : str or None
        A value, "rigid-body" or "identified"; by default the latter for a specimen, else the former.
    """

    specimen: str | None = None
    scale: float = 1.0
    critical_angle: str | None = None
    p: str | None = None
    restitution: str | None = None


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
    """

    name: str
    block: Block
    restitution: tuple[float, float]
    restitution_source: str


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
    Make the column that is asked for.

    Raises
    ------
    CampaignError
        If it is not said, or an option is out of its range.
    """
    alpha = _quantity("--critical-angle", asked.critical_angle, "angle")
    frequency = None if asked.p is None else frequency_of(asked.p)
    if campaign is None or layout is None or (asked.specimen is None and alpha is not None and frequency is not None):
        return _without_specimen(asked, alpha, frequency, has_campaign=campaign is not None)
    name = _specimen(campaign, asked.specimen)
    if expected := outside(asked.scale, BETWEEN["length"]):
        raise CampaignError(f"--scale {asked.scale:g}: {expected}")
    model = campaign.specimens[name].block(campaign.gravity)
    if not asked.scale > 0.0:
        raise CampaignError(f"--scale {asked.scale:g}: a positive factor was expected.")
    slenderness = 1.0 if alpha is None else alpha / model.critical_angle
    size = 1.0 / sqrt(asked.scale) if frequency is None else frequency / model.p
    block = _sound(lambda: member_block(model, slenderness, size))
    words = name if asked.scale == 1.0 else f"{name}, {asked.scale:g} times larger"
    given = asked.restitution or IDENTIFIED
    if given == IDENTIFIED:
        from colonnade.workflow.maps.plans import restitution_of

        e, source = restitution_of(campaign, layout, name)
        return Column(words, block, pair(e), source)
    return Column(words, block, *_restitution(given, block))


def _without_specimen(
    asked: AskedColumn, alpha: float | None, frequency: float | None, *, has_campaign: bool
) -> Column:
    if asked.specimen is not None:
        raise CampaignError(
            f"--specimen {asked.specimen}: there is no campaign here. Give CAMPAIGN, or --critical-angle and --p."
        )
    if alpha is None or frequency is None:
        raise CampaignError(
            'The column is not known. Give --critical-angle "0.2 rad" and --p "2 rad/s", or a CAMPAIGN with --specimen.'
        )
    if asked.scale != 1.0:
        raise CampaignError("--scale is for a specimen. With --critical-angle and --p give those of the real column.")
    block = _sound(lambda: rectangular(alpha, 2 * pi / frequency))
    given = asked.restitution or RIGID_BODY
    if given == IDENTIFIED:
        where = "name it with --specimen" if has_campaign else "give CAMPAIGN and --specimen"
        raise CampaignError(f"--restitution identified: e is identified of a specimen; {where}.")
    return Column(f"α = {alpha:.4g} rad, p = {frequency:.4g} rad/s", block, *_restitution(given, block))


def _sound(make: Callable[[], Block]) -> Block:
    try:
        return make()
    except ValueError as error:
        raise CampaignError(f"The column cannot be: {error}.") from None


def _restitution(given: str, block: Block) -> tuple[tuple[float, float], str]:
    if given == RIGID_BODY:
        return pair(block.restitution), RIGID_BODY
    try:
        value = float(given)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 1.0:
        raise CampaignError(
            f'--restitution {given}: a number between 0 and 1, "{RIGID_BODY}" or "{IDENTIFIED}" was expected.'
        )
    return pair(value), "given"


def _specimen(campaign: Campaign, name: str | None) -> str:
    known = list(campaign.specimens)
    if name is None and len(known) == 1:
        return known[0]
    if name is None:
        raise CampaignError(f"The campaign has several specimens. Name one with --specimen.{nearest('', known)}")
    if name not in known:
        raise CampaignError(f'{campaign.path.name} has no specimen "{name}".{nearest(name, known)}')
    return name


def motion_of(asked: AskedMotion, campaign: Campaign | None, layout: Layout | None) -> tuple[Motion, str]:
    """
    Find the base motion that is asked for, and say where it comes from.

    Raises
    ------
    CampaignError
        If there is no such motion, only its shape is known, or an option is out of its range.
    ReadError
        If its file cannot be read.
    """
    motion, source, is_shape = _found(asked, campaign, layout)
    peak = _quantity("--peak", asked.peak, "acceleration")
    if peak is None and is_shape:
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
    return Motion(base, motion.dt, vertical), source


def _found(asked: AskedMotion, campaign: Campaign | None, layout: Layout | None) -> tuple[Motion, str, bool]:
    """Return the motion as it is found, its source, and whether only its shape is known."""
    from colonnade.readers.motion import read_motion

    path = Path(asked.name)
    options = {"--unit": asked.unit, "--interval": asked.interval, "--column": asked.column}
    given = [name for name, value in options.items() if value is not None]
    if path.is_file() or campaign is None or layout is None or given:
        if not path.is_file():
            raise CampaignError(f"--motion {asked.name}: there is no such file{' and no campaign' * (not campaign)}.")
        column = int(asked.column) if asked.column is not None and asked.column.isdigit() else asked.column
        interval = _quantity("--interval", asked.interval, "time")
        return read_motion(path, unit=asked.unit, dt=interval, column=column), f"file {path.name}", False
    from colonnade.workflow.forecasting.motions import motion_asked_for

    found = motion_asked_for(campaign, layout, asked.name, None, None)
    return found.motion, found.source, found.test is None


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


def frequency_of(given: str) -> float:
    """
    Read p, rad/s.

    Raises
    ------
    CampaignError
        If it is no positive angular frequency.
    """
    try:
        value = units.to_si(given, "angular_velocity")
    except UnitError as error:
        raise CampaignError(f"--p {given}: {error}") from None
    if not BETWEEN["frequency"][0] <= value <= BETWEEN["frequency"][1]:
        raise CampaignError(f'--p {given}: a positive angular frequency was expected, such as "2 rad/s".')
    return value
