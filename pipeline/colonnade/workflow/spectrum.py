"""Spectra of a column, rocking on a motion or overturning by a pulse: what asks for them, their rows and record."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import isfinite, pi, radians, sqrt
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from colonnade.assessment.ground import NONE, correction_of
from colonnade.assessment.measures import intensity_measures, measure_of
from colonnade.campaign import Campaign
from colonnade.campaign.assessment import Baseline
from colonnade.campaign.syntax.fields import Duration, Limits, MapPoints, MapRatio, OneOf, Quantity
from colonnade.campaign.syntax.table import Problems, Table
from colonnade.dynamics.models import NONLINEAR, PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.pulses import PULSES, OverturningSpectrum, overturning_spectrum
from colonnade.dynamics.rock import rock
from colonnade.dynamics.search import WIDTH
from colonnade.dynamics.spectra import RockingSpectrum, rocking_spectrum
from colonnade.errors import CampaignError
from colonnade.store.layout import Layout
from colonnade.store.records.assessment import level
from colonnade.units.text import NOTHING, acceleration, number, quantity, ratio
from colonnade.workflow.asked import FoundColumn, Given, find_column, motion_asked_for

if TYPE_CHECKING:
    from colonnade.figures.files.output import Picture

REACH = 4.0
"""Largest and least size, 2π/p, of a rocking spectrum over that of the column."""

FREQUENCIES = (0.5, 8.0)
"""Ω of an overturning spectrum."""


class AskedSpectrum(Table):
    """What a spectrum is asked for with, besides its column; quantities as in a campaign file."""

    motion: str | None = None
    """A file, a test that recorded it, or one of [motions]."""
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
    baseline: Baseline = NONE
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

    def contradictions(self) -> Problems:
        """Say that it is not of one thing."""
        if (self.motion is None) == (self.pulse is None):
            yield (), "Give either --motion or --pulse."


Row = tuple[str, ...]


@dataclass(frozen=True)
class Answer:
    """
    What a motion or a pulse does to a column, as it is shown.

    Attributes
    ----------
    verdict : str
        In a sentence.
    fields : sequence of (str, str)
        What column and motion or pulse are.
    tables : sequence of (Row, sequence of Row)
        Heads and rows of each.
    record : dict
        For programs: SI, NaN for what there is not.
    draw : callable
        Gives the picture.
    """

    verdict: str
    fields: Sequence[tuple[str, str]]
    tables: Sequence[tuple[Row, Sequence[Row]]]
    record: dict[str, Any]
    draw: Callable[[], Picture]


def spectrum_of(asked: AskedSpectrum, given: Given, campaign: Campaign | None, layout: Layout | None) -> Answer:
    """
    Compute the spectrum that is asked for.

    Parameters
    ----------
    asked : AskedSpectrum
    given : Given
        Which column: a specimen stands for itself unless options make it another column.
    campaign, layout : optional
        None without a campaign.

    Raises
    ------
    CampaignError
        If something is not known or out of its range.
    ReadError
        If the file of the motion cannot be read.
    """
    column = find_column(given, campaign, layout)
    try:
        if asked.motion is None:
            return _overturning(column, asked)
        return _rocking(column, asked, *_base(asked, campaign, layout, column.scale))
    except ValueError as error:
        raise CampaignError(str(error)) from None


def _rocking(column: FoundColumn, asked: AskedSpectrum, motion: Motion, source: str, is_table: bool) -> Answer:
    """Answer by rectangular blocks over their size, the slenderness of the column first."""
    block, own = column.real.block, 2 * pi / column.real.block.p
    spectrum = rocking_spectrum(
        motion,
        critical_angle=[block.critical_angle, *asked.slenderness],
        period=np.geomspace(*(asked.periods or (own / REACH, own * REACH)), asked.points),
        restitution=column.real.restitution,
        model=asked.model,
        gravity=block.gravity,
    )
    history = rock(block, motion, restitution=column.real.restitution, model=asked.model)
    measures = intensity_measures(motion, block, drift=asked.drift, at_rest=is_table)
    peak = history.peak_ratio
    rocks = "does not rock" if not peak else f"rocks to |θ|/α = {ratio(peak)} and stands"
    drift = f"the velocity drifts by {measures.drift:.2g} of its peak; {measures.largest_drift:g} is allowed"
    angles = [f"largest |θ|/α, α = {quantity(float(angle), 'rad', 4)}" for angle in spectrum.critical_angle]
    sizes = [
        (quantity(float(period), "s"), *("overturned" if np.isnan(each) else ratio(float(each)) for each in peaks))
        for period, peaks in zip(spectrum.period, spectrum.peak_ratio.T, strict=True)
    ]
    measured = [
        (each.name, each.symbol, level(each.id, value), measures.reasons.get(each.id, "").partition(":")[0])
        for each, value in zip(map(measure_of, measures.values), measures.values.values(), strict=True)
    ]
    return Answer(
        f"The column {'overturns' if history.outcome == 'overturned' else rocks} ({history.model} model).",
        [
            *column.fields(),
            ("motion", f"{source}; {motion.duration:.4g} s in steps of {motion.dt:.4g} s"),
            ("drift", drift),
        ],
        [(("measure", "symbol", "value", "why not"), measured), (("2π/p", *angles), sizes)],
        {
            "column": column.record(),
            "motion": {"source": source, "interval": motion.dt, "duration": motion.duration},
            "outcome": history.outcome,
            "peak_ratio": peak,
            "spectrum": spectrum,
            "measures": measures,
        },
        partial(_picture, spectrum, f"Rocking spectrum: {source}", period=own, title=source),
    )


def _picture(spectrum: RockingSpectrum | OverturningSpectrum, heading: str, **how: Any) -> Picture:
    from colonnade.figures.files.output import Picture
    from colonnade.figures.maps.stability_map import overturning_spectrum, rocking_spectrum

    if isinstance(spectrum, RockingSpectrum):
        return Picture(rocking_spectrum(spectrum, **how), "rocking-spectrum", heading, "Largest angle over size.")
    figure = overturning_spectrum(spectrum)
    return Picture(figure, "overturning-spectrum", heading, "Lower and upper limit over frequency.")


def _overturning(column: FoundColumn, asked: AskedSpectrum) -> Answer:
    """Answer by the limits of the pulses over their frequency."""
    kind, block = PULSES[str(asked.pulse)], column.real.block
    spectrum = overturning_spectrum(
        block,
        kind.name,
        cycles=asked.cycles,
        phase=radians(asked.phase),
        frequency_ratio=np.linspace(*asked.omega, asked.points),
        restitution=column.real.restitution,
        model=asked.model,
        largest=asked.largest,
        width=asked.least_width,
    )

    def limit(level: float) -> str:
        return f"{number(level, 5)}, {acceleration(level * block.uplift_acceleration)}" if isfinite(level) else NOTHING

    shape = f"; γ = {asked.cycles:g}, ν = {radians(asked.phase):.3g} rad" if "cycles" in spectrum.options else ""
    verdict = f"No {kind.name} pulse up to A = {asked.largest:g} overturns the column ({asked.model} model)."
    limits = np.column_stack([spectrum.frequency_ratio, spectrum.lower, spectrum.upper]).tolist()
    if np.isfinite(spectrum.lower).any():
        omega, lower, _ = limits[int(np.nanargmin(spectrum.lower))]
        verdict = (
            f"The least {kind.name} pulse that overturns the column has A = {limit(lower)}, at Ω = {number(omega)} "
            f"({asked.model} model)."
        )
    rows = [
        (number(omega), quantity(omega * block.p / (2 * pi), "Hz"), limit(lower), limit(upper))
        for omega, lower, upper in limits
    ]
    return Answer(
        verdict,
        [
            *column.fields(),
            ("pulse", f"{kind.name}: {kind.definition}, φ = ω t{shape} ({kind.source})"),
            ("limits", f"of intervals at least {asked.least_width:g} wide in A, up to A = {asked.largest:g}"),
        ],
        [(("Ω", "frequency", "lower limit A", "upper limit A"), rows)],
        {"column": column.record(), "spectrum": spectrum},
        partial(_picture, spectrum, f"Overturning spectrum: {kind.name}"),
    )


def _base(
    asked: AskedSpectrum, campaign: Campaign | None, layout: Layout | None, scale: float | None
) -> tuple[Motion, str, bool]:
    """
    Find the base motion that is asked for, in the time of the column: where it comes from, whether a table did it.

    What a campaign recorded is in the time of its model. It is stretched by the root of the scale of the column; if
    that is not said (None), of the specimen that was tested.
    """
    column = int(asked.column) if asked.column is not None and asked.column.isdigit() else asked.column
    reading: dict[str, Any] = {"unit": asked.unit, "dt": asked.interval, "column": column}
    said = {key: value for key, value in reading.items() if value is not None}
    found = motion_asked_for(str(asked.motion), campaign, layout, **said)
    source, base, dt = found.source, found.motion.acceleration, found.motion.dt
    if asked.peak is None and found.is_shape:
        raise CampaignError(f'--motion {found.name}: it is {source}. Give its peak acceleration, --peak "0.3 g".')
    if found.test is not None and campaign is not None:
        own = found.test.specimen
        if not (scale := scale or campaign.specimens[own].scale):
            raise CampaignError(
                f"--motion {found.name}: it was recorded in the time of the model {own}, and how many times larger the "
                f"column is, is not known. Give the `scale` of specimens.{own}, or --specimen {own} with --scale (1 "
                "for its own size)."
            )
        if scale != 1.0:
            dt *= sqrt(scale)
            source = f"{source}, {number(sqrt(scale))} times slower for a column {scale:g} times larger"
    if asked.peak is not None:
        base = found.factor_to(asked.peak) * base
        source = f"{source}, brought to a peak of {quantity(asked.peak, 'g')}"
    if asked.baseline != NONE:
        base = correction_of(asked.baseline)(base, dt)
        source = f"{source}, baseline corrected: {asked.baseline}"
    return Motion(base, dt), source, found.test is not None
