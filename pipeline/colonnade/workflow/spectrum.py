"""Spectra of a column, rocking on a motion or overturning by a pulse: what asks for them, their rows and record."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, pi, radians, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.ground import NONE, Ground, corrected
from colonnade.assessment.measures import IntensityMeasures, intensity_measures, measure_of
from colonnade.campaign import Campaign
from colonnade.campaign.syntax.fields import Duration, Limits, MapPoints, MapRatio, OneOf, Quantity
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.history import History
from colonnade.dynamics.models import NONLINEAR, PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.pulses import PULSES, OverturningSpectrum, overturning_spectrum, pulse_of
from colonnade.dynamics.rock import rock
from colonnade.dynamics.search import WIDTH
from colonnade.dynamics.spectra import RockingSpectrum, rocking_spectrum
from colonnade.errors import CampaignError
from colonnade.store.layout import Layout
from colonnade.units.text import NOTHING, acceleration, number, quantity, ratio
from colonnade.workflow.real_column import FoundColumn, Given, find_column

if TYPE_CHECKING:
    from colonnade.figures.files.output import Picture

REACH = 4.0
"""Largest and least size, 2π/p, of a rocking spectrum over that of the column."""

FREQUENCIES = (0.5, 8.0)
"""Ω of an overturning spectrum."""


class AskedSpectrum(Table):
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


Row = tuple[str, ...]
Fields = list[tuple[str, str]]
Tables = list[tuple[Row, list[Row]]]
"""Heads and rows of each."""


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

    def picture(self) -> Picture:
        """Draw the spectrum."""
        from colonnade.figures.files.output import Picture
        from colonnade.figures.maps import stability_map as spectra

        figure = spectra.rocking_spectrum(self.spectrum, period=2 * pi / self.column.block.p, title=self.source)
        angles = ", ".join(f"{angle:.4g}" for angle in self.spectrum.critical_angle)
        seen = f"Largest angle over the size of blocks with α = {angles} rad."
        return Picture(figure, "rocking-spectrum", f"Rocking spectrum: {self.source}", seen)

    def verdict(self) -> str:
        """Say in a sentence what the motion does to the column."""
        peak, model = self.history.peak_ratio, self.history.model
        rocks = "does not rock" if not peak else f"rocks to |θ|/α = {ratio(peak)} and stands"
        return f"The column {'overturns' if self.history.outcome == 'overturned' else rocks} ({model} model)."

    def fields(self) -> Fields:
        """Write what column and motion are."""
        motion, drift = self.motion, self.measures.drift
        allowed = f"{self.measures.largest_drift:g} is allowed"
        return [
            *self.column.fields(),
            ("motion", f"{self.source}; {motion.duration:.4g} s in steps of {motion.dt:.4g} s"),
            ("drift", f"the velocity drifts by {drift:.2g} of its peak; {allowed}"),
        ]

    def tables(self) -> Tables:
        """Write the measures of the motion, and the spectrum, a row for each slenderness and size."""
        return [
            (("measure", "symbol", "value", "why not"), [self._measured(name) for name in self.measures.values]),
            (
                ("α", "2π/p", "p", "outcome", "largest |θ|/α", "largest |θ'|"),
                [self._row(*place) for place in np.ndindex(self.spectrum.overturned.shape)],
            ),
        ]

    def _measured(self, name: str) -> Row:
        each, value = measure_of(name), self.measures.values[name]
        shown = f"{number(value)} {each.unit}".rstrip() if isfinite(value) else NOTHING
        why_not = self.measures.reasons.get(name, "").partition(":")[0]
        return each.name, each.symbol, acceleration(value) if each.dimension == "acceleration" else shown, why_not

    def _row(self, *place: int) -> Row:
        spectrum, p = self.spectrum, 2 * pi / float(self.spectrum.period[place[1]])
        peak = float(spectrum.peak_ratio[place])
        return (
            quantity(float(spectrum.critical_angle[place[0]]), "rad", 4),
            quantity(2 * pi / p, "s"),
            quantity(p, "rad/s"),
            "overturned" if spectrum.overturned[place] else "rocking" if peak > 0.0 else "no-rocking",
            ratio(peak),
            quantity(float(spectrum.peak_velocity_ratio[place]) * p, "rad/s"),
        )

    def record(self) -> dict[str, Any]:
        """Give it for programs: SI, null for what there is not."""
        measures, of = self.measures, ("unit", "definition", "source", "filter")
        return {
            "column": self.column.record(),
            "motion": self.source,
            "interval": self.motion.dt,
            "duration": self.motion.duration,
            "model": self.spectrum.model,
            "outcome": self.history.outcome,
            "peak_ratio": self.history.peak_ratio,
            "period": _plain(self.spectrum.period),
            "critical_angle": _plain(self.spectrum.critical_angle),
            "spectrum_peak_ratio": [_plain(row) for row in self.spectrum.peak_ratio],
            "spectrum_overturned": self.spectrum.overturned.tolist(),
            "drift": measures.drift,
            "largest_drift": measures.largest_drift,
            "measures": {
                name: {
                    "value": value if isfinite(value) else None,
                    **{key: getattr(measure_of(name), key) for key in of},
                    "reason": measures.reasons.get(name, ""),
                }
                for name, value in measures.values.items()
            },
        }


@dataclass(frozen=True)
class Overturning:
    """An overturning spectrum and its column."""

    column: FoundColumn
    spectrum: OverturningSpectrum

    def picture(self) -> Picture:
        """Draw the spectrum."""
        from colonnade.figures.files.output import Picture
        from colonnade.figures.maps import stability_map as spectra

        title, seen = f"Overturning spectrum: {self.spectrum.pulse}", "lower and upper limit over frequency."
        figure = spectra.overturning_spectrum(self.spectrum)
        return Picture(figure, "overturning-spectrum", title, f"{self.column.name}: {seen}")

    def verdict(self) -> str:
        """Say in a sentence what the least of the pulses does to the column."""
        spectrum, by = self.spectrum, f"({self.spectrum.model} model)"
        if not np.isfinite(spectrum.lower).any():
            return f"No {spectrum.pulse} pulse up to A = {spectrum.options['largest']:g} overturns the column {by}."
        least = int(np.nanargmin(spectrum.lower))
        level = float(spectrum.lower[least])
        return (
            f"The least {spectrum.pulse} pulse that overturns the column has A = {number(level)}, "
            f"{acceleration(level * self.column.block.uplift_acceleration)}, at Ω = "
            f"{number(float(spectrum.frequency_ratio[least]))} {by}."
        )

    def fields(self) -> Fields:
        """Write what column and pulse are, and what the limits are."""
        kind, options = pulse_of(self.spectrum.pulse), self.spectrum.options
        shape = f"; γ = {options['cycles']:g}, ν = {options['phase']:.3g} rad" if "cycles" in options else ""
        return [
            *self.column.fields(),
            ("pulse", f"{kind.name}: {kind.definition}, φ = ω t{shape} ({kind.source})"),
            ("limits", f"of intervals at least {options['width']:g} wide in A, up to A = {options['largest']:g}"),
        ]

    def tables(self) -> Tables:
        """Write the spectrum, a row for each frequency."""
        heads = ("Ω", "frequency", "lower limit A", "acceleration", "upper limit A", "acceleration", "islands")
        return [(heads, [self._row(place) for place in range(self.spectrum.lower.size)])]

    def _row(self, place: int) -> Row:
        spectrum, block = self.spectrum, self.column.block
        omega, lower, upper = (
            float(each[place]) for each in (spectrum.frequency_ratio, spectrum.lower, spectrum.upper)
        )
        return (
            number(omega),
            quantity(omega * block.p / (2 * pi), "Hz"),
            number(lower, 5),
            acceleration(lower * block.uplift_acceleration),
            number(upper, 5),
            acceleration(upper * block.uplift_acceleration),
            str(int((spectrum.islands[:, 0] == omega).sum())),
        )

    def record(self) -> dict[str, Any]:
        """Give it for programs: SI, null for what there is not."""
        spectrum = self.spectrum
        edges = np.column_stack([spectrum.interval_frequency_ratio, spectrum.interval_start, spectrum.interval_end])
        return {
            "column": self.column.record(),
            "pulse": spectrum.pulse,
            "model": spectrum.model,
            "options": spectrum.options,
            **{key: _plain(getattr(spectrum, key)) for key in ("frequency_ratio", "lower", "upper")},
            "intervals": edges.tolist(),
        }


def _plain(values: Array) -> list[float | None]:
    return [value if isfinite(value) else None for value in values.tolist()]


def rocking_of(
    campaign: Campaign | None, layout: Layout | None, column: Given, motion: str, asked: AskedSpectrum
) -> Rocking:
    """
    Compute the rocking spectrum of a motion around a column.

    Parameters
    ----------
    campaign, layout : optional
        None without a campaign.
    column : Given
        A specimen stands for itself unless options make it another column.
    motion : str
        A file, a test that recorded it, a motion that tests name or one of [motions].
    asked : AskedSpectrum

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


def overturning_of(
    campaign: Campaign | None, layout: Layout | None, column: Given, asked: AskedSpectrum
) -> Overturning:
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
    name: str, asked: AskedSpectrum, campaign: Campaign | None, layout: Layout | None, column: FoundColumn
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
    name: str, asked: AskedSpectrum, campaign: Campaign | None, layout: Layout | None, scale: float | None
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
