"""A free vibration as the estimators of e use it: its samples, and its arcs about their zero."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs import Arcs, arcs_between, find_impacts, noise_level
from colonnade.identification.restitution.peaks import energy_slope, half_duration, lift
from colonnade.identification.restitution.result import Impacts, Peaks
from colonnade.units.text import format_percent

FEWEST_ARCS = 2
"""For a value."""

STEP = 0.02
"""Longest step of the samples fitted, in p t: the lowest arc of interest, of 0.02 α, has twenty."""

RESTING = 20.0
"""Times what an arc bends in a group: a smaller angle is of a block at rest, which nothing bends."""

UNEVEN = 1e-3
"""Steps that differ by more than this share are not of one clock: neither averaged nor held against a spectrum."""

NOISE_MARGIN = 8.0
"""Excursions below this many standard deviations of the smoothed noise are not counted."""

SMOOTHED = 0.1
"""Over p: length over which the record is averaged to find its excursions."""

PERIOD_TOLERANCE = 0.15
"""Largest median departure of the arcs' durations from those of this block."""

SHAPE_TOLERANCE = 0.03
"""Largest median difference of the duration that an arc has by its middle part; a sine seems 4 % too short."""

SURE = 3.0
"""Standard errors by which a bound has to be passed."""

LARGEST_ERROR = 0.02
"""Of the durations by the middle part that are looked at, as a share of them."""


@dataclass(frozen=True, eq=False)
class AngleSamples:
    """
    The samples that are fitted: as few as hold the record's information without bias.

    Attributes
    ----------
    time, angle : ndarray, shape (n,)
        s, increasing; rad, NaN where missing.
    along : ndarray, shape (n,)
        Share of the record, from −1/2 to 1/2.
    base : ndarray, shape (n,)
        Base acceleration over gravity; zeros if the table is at rest.
    interval : float
        s, the mean of steps that are uneven.
    is_even : bool
    group : int
        Recorded samples averaged in each.
    """

    time: Array
    angle: Array
    along: Array
    base: Array
    interval: float
    is_even: bool
    group: int = 1

    @property
    def step(self) -> float:
        """Of the recording, s."""
        return self.interval / self.group


def thinned(time: Array, angle: Array, block: Block, base: Array | None = None) -> AngleSamples:
    """
    Average samples in groups, as long as free rocking hardly bends in one.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block
    base : ndarray, shape (n,), optional
        Acceleration of a table that moves, over gravity.

    Notes
    -----
    The mean of a curve over a group of m samples differs from its middle by (m² − 1) dt² θ̈ / 24; θ̈ is known from the
    angle itself, so this is taken off. White noise stays white.
    """
    steps = np.diff(time)
    interval = float(time[-1] - time[0]) / max(steps.size, 1)
    base = np.zeros(time.size) if base is None else base
    is_even = bool(np.abs(steps - interval).max(initial=0.0) <= UNEVEN * interval)
    fine = STEP / max(map(block.side_p, block.sides))
    group = max(min(int(fine / interval), time.size // 8), 1) if is_even else 1
    if group > 1:
        time, angle, base = (_means(values, group) for values in (time, angle, base))
        critical = block.critical_angle_at(angle)
        acceleration = -(block.p_at(angle) ** 2) * np.sin(np.where(angle < 0, -critical, critical) - angle)
        bend = (group**2 - 1) * interval**2 / 24 * acceleration
        moves = (np.abs(angle) < 1.5 * critical) & (np.abs(angle) > RESTING * np.abs(bend))
        angle = angle - np.where(moves, bend, 0.0)
    along = (time - time[0]) / max(float(time[-1] - time[0]), 1e-300) - 0.5
    return AngleSamples(time, angle, along, base, group * interval, is_even, group)


def _means(values: Array, group: int) -> Array:
    return np.asarray(values[: group * (values.size // group)].reshape(-1, group).mean(axis=1))


@dataclass(frozen=True, eq=False)
class Record:
    """
    A record with the arcs seen in it.

    Attributes
    ----------
    block : Block
    samples : AngleSamples
        About the zero of the record.
    impacts : ndarray, shape (n + 1,)
        s.
    lowest, least : float
        rad; lower peaks are not counted, and not followed by the whole history.
    noise : float
        Standard deviation of the averaged angle at rest, rad.
    zero : float
        rad, what is taken off the angle for `arcs`: the block's zero as far as it is known.
    """

    block: Block
    samples: AngleSamples
    impacts: Array
    lowest: float
    least: float
    noise: float
    zero: float = 0.0

    @classmethod
    def seen(cls, samples: AngleSamples, block: Block, lowest_amplitude: float, noise: float | None) -> Record:
        """Find the impacts in the averaged samples."""
        length = max(int(SMOOTHED / (block.p * samples.interval)), 1)
        smooth = _averaged(samples.angle, length)
        sampled = smooth[::length]
        scatter = noise_level(sampled[np.isfinite(sampled)]) if noise is None else noise
        least = lowest_amplitude * block.critical_angle
        lowest = max(least, NOISE_MARGIN * scatter)
        return cls(block, samples, find_impacts(samples.time, smooth, lowest=lowest), lowest, least, scatter)

    @cached_property
    def arcs(self) -> Arcs:
        """All arcs, fitted in the samples themselves."""
        angle, block = self.samples.angle - self.zero, self.block
        return arcs_between(self.impacts, self.samples.time, angle, block.p, critical=block.critical_angle)

    @cached_property
    def usable(self) -> Mask:
        """Arcs whose peak is known, below α and above `lowest`."""
        arcs = self.arcs
        high = (arcs.height > self.lowest) & (arcs.height < self.block.critical_angle_at(arcs.peak_angle))
        return np.isfinite(arcs.peak_standard_error) & high

    def run(self) -> tuple[Array, Array]:
        """Peaks (rad, signed) and times (s) of the longest run of arcs on alternating sides."""
        peaks, times = self.arcs.peak_angle, self.arcs.peak_time
        seen = np.isfinite(peaks) & (np.abs(peaks) < self.block.critical_angle_at(peaks))
        follows = seen[1:] & seen[:-1] & (np.sign(peaks[1:]) == -np.sign(peaks[:-1]))
        breaks = np.flatnonzero(np.concatenate(([True], ~follows, [True])))
        longest = int(np.argmax(np.diff(breaks)))
        run = slice(int(breaks[longest]), int(breaks[longest + 1]))
        return peaks[run][seen[run]], times[run][seen[run]]

    @cached_property
    def counted(self) -> Arcs:
        """The usable arcs."""
        return self.arcs.only(self.usable)

    @property
    def peaks(self) -> Peaks:
        """The peaks of all arcs, without a fit."""
        arcs = self.arcs
        unfitted = np.full(arcs.peak_angle.shape, np.nan)
        return Peaks(arcs.peak_time, arcs.peak_angle, arcs.peak_standard_error, unfitted, self.usable)

    def single_impacts(self, zero: float) -> Impacts:
        """Find e of each impact between two arcs, with their peaks about a zero (rad)."""
        peak, error = self.arcs.peak_angle - zero, self.arcs.peak_standard_error
        critical = self.block.critical_angle_at(peak)
        peak = np.where(self.usable & (np.abs(peak) < critical), peak, np.nan)
        energy = self.block.p_at(peak) ** 2 * lift(peak, critical)
        relative = energy_slope(peak, critical) * error
        restitution = np.sqrt(energy[1:] / energy[:-1])
        errors = 0.5 * restitution * np.hypot(relative[1:], relative[:-1])
        used = np.isfinite(restitution) & np.isfinite(errors)
        return Impacts(self.arcs.end[:-1], np.sqrt(2 * energy[:-1]), restitution, errors, used)


def _averaged(angle: Array, length: int) -> Array:
    """Mean over `length` samples (made odd) about each; NaN where one is missing, and as recorded at the ends."""
    half = length // 2
    if half == 0 or angle.size <= 2 * half:
        return angle
    windows = np.lib.stride_tricks.sliding_window_view(angle, 2 * half + 1)
    return np.concatenate((angle[:half], windows.mean(axis=1), angle[-half:]))


def objection(record: Record, base: Array | None) -> str:
    """
    Say why the record is no free rocking of this block from which e could be found; empty if it is.

    Parameters
    ----------
    record : Record
    base : ndarray, shape (n,), or None
        Acceleration of a table that moves, at all samples of the recording.

    Notes
    -----
    The arcs of a rocking block are near to parabolas, and as long as their height says: the duration, and what the
    middle of an arc says of its ends, are held against the equation of motion.
    """
    seen = record.counted
    if seen.start.size < FEWEST_ARCS:
        whole, length = record.block.critical_angle, float(np.ptp(record.samples.time))
        return (
            f"At least {FEWEST_ARCS} peaks between two impacts, above {record.lowest / whole:.2g} of the critical "
            f"angle, {whole:.3g} rad, and below it, are needed; the record of {length:.2g} s has {seen.start.size}."
        )
    if base is not None and not (record.samples.is_even and np.isfinite(base).all()):
        return (
            "The table moves, and its acceleration misses samples, or steps are uneven; all of them on a uniform clock "
            "were expected. Give the test a `window` without missing ones."
        )
    peak, critical = seen.height, record.block.critical_angle_at(seen.peak_angle)
    p = record.block.p_at(np.sign(seen.peak_angle))
    expected, duration = 2 * half_duration(peak, critical) / p, seen.end - seen.start
    excess = float(np.median(duration / expected)) - 1
    if abs(excess) > PERIOD_TOLERANCE:
        return (
            f"Times between impacts, in s, differ by {format_percent(excess, signed=True)} from those of this block in "
            "free rocking at these amplitudes, in rad: this is not free rocking of this specimen, or its dimensions "
            "are wrong."
        )
    unsure = seen.duration_standard_error / duration
    sure = unsure < LARGEST_ERROR
    if not sure.any():
        return ""
    within = (seen.duration / duration)[sure]
    median, scatter = float(np.median(within)) - 1, 1.25 * float(np.median(unsure[sure])) / np.sqrt(sure.sum())
    if abs(median) > SHAPE_TOLERANCE + SURE * scatter:
        return (
            "Between impacts the angle is not the arc of a rocking block: judged by its middle part, an arc would "
            f"last {format_percent(median, signed=True)} longer than it does; "
            f"less than {format_percent(SHAPE_TOLERANCE)} was expected. This is not free rocking."
        )
    return ""
