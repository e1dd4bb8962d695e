"""Spectra of a column: rocking on a motion, overturning by a pulse; the options that ask for them."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np

from colonnade.assessment.ground import NONE, Ground, corrected
from colonnade.assessment.measures import IntensityMeasures, intensity_measures
from colonnade.campaign import Campaign
from colonnade.campaign.syntax.fields import Duration, Limits, MapPoints, MapRatio, OneOf, Quantity
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.history import History
from colonnade.dynamics.models import NONLINEAR, PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.pulses import PULSES, OverturningSpectrum, overturning_spectrum
from colonnade.dynamics.rock import rock
from colonnade.dynamics.search import WIDTH
from colonnade.dynamics.spectra import RockingSpectrum, rocking_spectrum
from colonnade.errors import CampaignError
from colonnade.store.layout import Layout
from colonnade.units.text import number, quantity
from colonnade.workflow.real_column import AskedColumn, FoundColumn, find_column

if TYPE_CHECKING:
    from colonnade.figures.files.output import Picture

REACH = 4.0
"""Largest and least size, 2π/p, of a rocking spectrum over that of the column."""

FREQUENCIES = (0.5, 8.0)
"""Ω of an overturning spectrum."""


class Asked(Table):
    """What a spectrum is asked for with, besides its column; quantities as in a campaign file."""

    pulse: Annotated[str, OneOf(tuple(PULSES))] | None = None
    """Kind of pulse."""
    unit: str | None = None
    """Unit of the accelerations in a file that does not give it, such as "g"."""
    interval: Duration | None = None
    """Sampling interval of a file that does not give it, such as "0.01 s"."""
    column: str | None = None
    """Name or number of the column of the accelerations in a file."""
    peak: Annotated[float, Quantity("acceleration")] | None = None
    """Peak that the motion is brought to, such as "0.3 g"."""
    baseline: str = NONE
    """Correction of the motion's baseline: linear, quadratic or highpass(0.1 Hz)."""
    drift: float | None = None
    """Largest drift over PGV of a motion with PGV; by default 0.1, or 0.25 of a table at rest at both ends."""
    slenderness: tuple[Annotated[float, Quantity("angle")], ...] = ()
    """A further α of the rocking spectrum, besides that of the column."""
    periods: Limits[MapRatio] | None = None
    """Sizes 2π/p of the rocking spectrum, s; by default from a fourth of the column's to four times."""
    omega: Limits[MapRatio] = FREQUENCIES
    """Frequency ratios Ω = ω/p of the pulse."""
    points: MapPoints = 24
    """Number of sizes, in equal ratios, or of frequencies, in equal steps."""
    model: Annotated[str, OneOf(tuple(PLANE_MODELS))] = NONLINEAR.name
    """Model of rocking."""
    cycles: float = 2.0
    """γ of mavroeidis-papageorgiou."""
    phase: float = 0.0
    """ν of mavroeidis-papageorgiou, in degrees."""
    largest: float = 10.0
    """Largest A that is tried."""
    least_width: float = WIDTH
    """In A: narrower intervals are islands, not limits."""


@dataclass(frozen=True)
class Rocking:
    """
    A rocking spectrum and what belongs to it.

    Attributes
    ----------
    column : FoundColumn
    motion : Motion
    source : str
        Where the motion comes from.
    history : History
        Of the column itself.
    spectrum : RockingSpectrum
        Of rectangular blocks over their size, the slenderness of the column first.
    measures : IntensityMeasures
    """

    column: FoundColumn
    motion: Motion
    source: str
    history: History
    spectrum: RockingSpectrum
    measures: IntensityMeasures


@dataclass(frozen=True)
class Overturning:
    """An overturning spectrum and its column."""

    column: FoundColumn
    spectrum: OverturningSpectrum


def rocking_of(
    campaign: Campaign | None, layout: Layout | None, column: AskedColumn, motion: str, asked: Asked
) -> Rocking:
    """
    Compute the rocking spectrum of a motion around a column.

    Parameters
    ----------
    campaign, layout : optional
        None without a campaign.
    column : AskedColumn
        A specimen stands for itself unless options make it another column.
    motion : str
        A file, a test that recorded it, a motion that tests name or one of [motions].
    asked : Asked

    Raises
    ------
    CampaignError
        If something is not known or out of its range.
    ReadError
        If the file of the motion cannot be read.
    """
    known = find_column(column, campaign, layout)
    base, source, is_table = _motion(motion, asked, campaign, layout, known)
    block, own = known.block, 2 * pi / known.block.p
    try:
        spectrum = rocking_spectrum(
            base,
            critical_angle=[block.critical_angle, *asked.slenderness],
            period=np.geomspace(*(asked.periods or (own / REACH, own * REACH)), asked.points),
            restitution=known.restitution,
            model=asked.model,
            gravity=block.gravity,
        )
        history = rock(block, base, restitution=known.restitution, model=asked.model)
        measures = intensity_measures(base, block, drift=asked.drift, at_rest=is_table)
    except ValueError as error:
        raise CampaignError(str(error)) from None
    return Rocking(known, base, source, history, spectrum, measures)


def overturning_of(campaign: Campaign | None, layout: Layout | None, column: AskedColumn, asked: Asked) -> Overturning:
    """Compute the overturning spectrum of the pulse that is asked for; as of `rocking_of`."""
    known = find_column(column, campaign, layout)
    try:
        spectrum = overturning_spectrum(
            known.block,
            str(asked.pulse),
            cycles=asked.cycles,
            phase=radians(asked.phase),
            frequency_ratio=np.linspace(*asked.omega, asked.points),
            restitution=known.restitution,
            model=asked.model,
            largest=asked.largest,
            width=asked.least_width,
        )
    except ValueError as error:
        raise CampaignError(str(error)) from None
    return Overturning(known, spectrum)


def _motion(
    name: str, asked: Asked, campaign: Campaign | None, layout: Layout | None, column: FoundColumn
) -> tuple[Motion, str, bool]:
    """Find the base motion that is asked for, where it comes from, and whether it was recorded on a table."""
    motion, source, kind = _found(name, asked, campaign, layout, column.scale)
    if asked.peak is None and kind == "shape":
        raise CampaignError(f'--motion {name}: it is {source}. Give its peak acceleration, --peak "0.3 g".')
    factor = 1.0
    if asked.peak is not None:
        if not motion.peak > 0.0:
            raise CampaignError(f"--motion {name}: it does not move, so that it cannot be brought to --peak.")
        factor, source = asked.peak / motion.peak, f"{source}, brought to a peak of {quantity(asked.peak, 'g')}"
    if asked.baseline != NONE:
        source = f"{source}, baseline corrected: {asked.baseline}"
    try:
        base = corrected(Ground(factor * motion.acceleration, motion.dt), asked.baseline).acceleration
    except ValueError as error:
        raise CampaignError(f"--baseline: {error}") from None
    vertical = None if motion.vertical is None else abs(factor) * motion.vertical
    return Motion(base, motion.dt, vertical), source, kind == "table"


def _found(
    name: str, asked: Asked, campaign: Campaign | None, layout: Layout | None, scale: float | None
) -> tuple[Motion, str, Literal["file", "shape", "table"]]:
    """
    Return the motion in the time of the column, its source, and what is known of it: its shape alone or all.

    What a campaign recorded is in the time of its model. It is stretched by the root of the scale of the column; if
    that is not said (None), of the specimen that was tested.
    """
    from colonnade.readers.motion import read_motion

    path = Path(name)
    is_of_file = asked.model_fields_set & {"unit", "interval", "column"}
    if path.is_file() or campaign is None or layout is None or is_of_file:
        if not path.is_file():
            raise CampaignError(f"--motion {name}: there is no such file{' and no campaign' * (not campaign)}.")
        column = int(asked.column) if asked.column is not None and asked.column.isdigit() else asked.column
        return read_motion(path, unit=asked.unit, dt=asked.interval, column=column), f"file {path.name}", "file"
    from colonnade.workflow.motions import motion_asked_for

    found = motion_asked_for(campaign, layout, name, None, None)
    if found.test is None:
        return found.motion, found.source, "shape"
    own = found.test.specimen
    if not (scale := scale or campaign.specimens[own].scale):
        raise CampaignError(
            f"--motion {name}: it was recorded in the time of the model {own}, and how many times larger the "
            f"column is, is not known. Give the `scale` of specimens.{own}, or --specimen {own} with --scale (1 for "
            "its own size)."
        )
    if scale == 1.0:
        return found.motion, found.source, "table"
    slower = sqrt(scale)
    source = f"{found.source}, {number(slower)} times slower for a column {scale:g} times larger"
    return Motion(found.motion.acceleration, found.motion.dt * slower), source, "table"


def picture_of(found: Rocking | Overturning) -> Picture:
    """Draw a spectrum."""
    from colonnade.figures import spectra
    from colonnade.figures.files.output import Picture

    if isinstance(found, Rocking):
        title = f"Rocking spectrum: {found.source}"
        figure = spectra.rocking_spectrum(found.spectrum, period=2 * pi / found.column.block.p, title=found.source)
        angles = ", ".join(f"{angle:.4g}" for angle in found.spectrum.critical_angle)
        seen = f"Largest angle over the size of blocks with α = {angles} rad."
        return Picture(figure, "rocking-spectrum", title, seen)
    figure = spectra.overturning_spectrum(found.spectrum)
    title = f"Overturning spectrum: {found.spectrum.pulse}"
    return Picture(figure, "overturning-spectrum", title, f"{found.column.name}: lower and upper limit over frequency.")
