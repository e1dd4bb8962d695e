"""Spectra of a column: rocking on a motion, overturning by a pulse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from colonnade.assessment.measures import IntensityMeasures, intensity_measures
from colonnade.campaign import Campaign
from colonnade.campaign.syntax.fields import MAP_RATIO, MOST_POINTS, outside
from colonnade.dynamics.history import History
from colonnade.dynamics.maps.plan import WIDTH
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.spectra.overturning import OverturningSpectrum, overturning_spectrum
from colonnade.dynamics.spectra.spectrum import RockingSpectrum, rocking_spectrum
from colonnade.errors import CampaignError
from colonnade.store.layout import Layout
from colonnade.workflow.real_column import AskedColumn
from colonnade.workflow.spectra.asked import AskedMotion, Column, column_of, motion_of, quantity_of

if TYPE_CHECKING:
    from colonnade.figures.files.output import Picture

REACH = 4.0
"""Largest and least size, 2π/p, of a rocking spectrum over that of the column."""

FREQUENCIES = (0.5, 8.0)
"""Ω of an overturning spectrum."""

POINTS = 24


@dataclass(frozen=True)
class Rocking:
    """
    A rocking spectrum and what belongs to it.

    Attributes
    ----------
    column : Column
    motion : Motion
    source : str
        Where the motion comes from.
    history : History
        Of the column itself.
    spectrum : RockingSpectrum
        Of rectangular blocks over their size, the slenderness of the column first.
    measures : IntensityMeasures
    """

    column: Column
    motion: Motion
    source: str
    history: History
    spectrum: RockingSpectrum
    measures: IntensityMeasures


@dataclass(frozen=True)
class Overturning:
    """An overturning spectrum and its column."""

    column: Column
    spectrum: OverturningSpectrum


@dataclass(frozen=True)
class AskedPulse:
    """
    A pulse; γ and ν (rad) are of Mavroeidis and Papageorgiou's, `largest` and `width` are in A.

    Its limits are as of `overturning_spectrum`.
    """

    kind: str
    cycles: float = 2.0
    phase: float = 0.0
    largest: float = 10.0
    width: float = WIDTH


def rocking_of(
    campaign: Campaign | None,
    layout: Layout | None,
    column: AskedColumn,
    asked: AskedMotion,
    *,
    slenderness: Sequence[str] = (),
    periods: tuple[float, float] | None = None,
    points: int = POINTS,
    model: str = NONLINEAR.name,
    drift: float | None = None,
) -> Rocking:
    """
    Compute the rocking spectrum of a motion around a column.

    Parameters
    ----------
    campaign, layout : optional
        None without a campaign.
    column : AskedColumn
    asked : AskedMotion
    slenderness : sequence of str, optional
        Further α with their units, besides that of the column.
    periods : pair of float, optional
        First and last 2π/p, s; by default from a fourth of the column's to four times.
    points : int, optional
        Sizes, in equal ratios.
    model : str, optional
        A plane one.
    drift : float, optional
        As of `intensity_measures`; that of a table's motion if a test recorded it.

    Raises
    ------
    CampaignError
        If something is not known or out of its range.
    """
    known = column_of(column, campaign, layout)
    motion, source, is_table = motion_of(asked, campaign, layout, known.scale)
    own = 2 * pi / known.block.p
    low, high = _range("--periods", periods or (own / REACH, own * REACH), "s")
    sizes = np.geomspace(low, high, _points(points))
    others = [quantity_of("--slenderness", each, "angle") for each in slenderness]
    try:
        spectrum = rocking_spectrum(
            motion,
            critical_angle=[known.block.critical_angle, *others],
            period=sizes,
            restitution=known.restitution,
            model=model,
            gravity=known.block.gravity,
        )
        history = rock(known.block, motion, restitution=known.restitution, model=model)
        measures = intensity_measures(motion, known.block, drift=drift, at_rest=is_table)
    except ValueError as error:
        raise CampaignError(str(error)) from None
    return Rocking(known, motion, source, history, spectrum, measures)


def overturning_of(
    campaign: Campaign | None,
    layout: Layout | None,
    column: AskedColumn,
    asked: AskedPulse,
    *,
    frequencies: tuple[float, float] | None = None,
    points: int = POINTS,
    model: str = NONLINEAR.name,
) -> Overturning:
    """
    Compute the overturning spectrum of a pulse for a column.

    Parameters
    ----------
    campaign, layout, column, points, model
        As of `rocking_of`; frequencies are in equal steps.
    asked : AskedPulse
    frequencies : pair of float, optional
        First and last Ω = ω/p.

    Raises
    ------
    CampaignError
        If something is not known or out of its range.
    """
    known = column_of(column, campaign, layout)
    low, high = _range("--omega", frequencies or FREQUENCIES, "")
    compute = partial(overturning_spectrum, known.block, asked.kind, cycles=asked.cycles, phase=asked.phase)
    try:
        spectrum = compute(
            frequency_ratio=np.linspace(low, high, _points(points)),
            restitution=known.restitution,
            model=model,
            largest=asked.largest,
            width=asked.width,
        )
    except ValueError as error:
        raise CampaignError(str(error)) from None
    return Overturning(known, spectrum)


def picture_of(found: Rocking | Overturning) -> Picture:
    """Draw a spectrum."""
    from colonnade.figures.files.output import Picture
    from colonnade.figures.spectra import overturning, rocking

    if isinstance(found, Rocking):
        title = f"Rocking spectrum: {found.source}"
        figure = rocking.rocking_spectrum(found.spectrum, period=2 * pi / found.column.block.p, title=found.source)
        angles = ", ".join(f"{angle:.4g}" for angle in found.spectrum.critical_angle)
        seen = f"Largest angle over the size of blocks with α = {angles} rad."
        return Picture(figure, "rocking-spectrum", title, seen)
    figure = overturning.overturning_spectrum(found.spectrum)
    title = f"Overturning spectrum: {found.spectrum.pulse}"
    return Picture(figure, "overturning-spectrum", title, f"{found.column.name}: lower and upper limit over frequency.")


def _range(option: str, limits: tuple[float, float], unit: str) -> tuple[float, float]:
    low, high = limits
    for each in limits:
        if expected := outside(each, MAP_RATIO, unit):
            raise CampaignError(f"{option} {low:g} {high:g}: {expected}")
    if not 0.0 < low < high:
        raise CampaignError(f"{option} {low:g} {high:g}: two positive values in rising order were expected.")
    return low, high


def _points(points: int) -> int:
    if not 2 <= points <= MOST_POINTS:
        raise CampaignError(f"--points {points}: a number from 2 to {MOST_POINTS} was expected.")
    return points
