"""Whether the table's acceleration is that of its displacement, and that which rocks the specimen."""

from __future__ import annotations

from dataclasses import dataclass
from math import log
from typing import Literal

import numpy as np
import scipy

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious, warning
from colonnade.identification.plausibility.scale import (
    DEAD,
    MISLEADING,
    STANDING,
    SURE,
    UNKNOWN,
    as_expected,
    cause,
    dead,
    least_squares,
)
from colonnade.signals.alignment import RIVAL_EVIDENCE, find_offset
from colonnade.signals.filters import lowpass, second_derivative
from colonnade.signals.metrics import find_hum
from colonnade.units.text import format_percent, format_uncertain

BANDWIDTH = 10.0
"""Hz, below which the two are compared: above it a displacement's noise is larger than its motion."""

SAME_MOTION = 0.9
"""Correlation from which on the two are of one motion, so that their ratio means something."""

OTHER_MOTION = 0.5
"""Correlation below which they are not."""

WRONG_DELAY = 0.03
"""s, from which on predictions are wrong."""

LEAST_HUM = 0.05
"""Of an accelerometer's peak, from which on a hum is reported."""

HUMLESS = 0.6
"""Of the frequency of a hum: a cut-off that takes it off."""

SEEN = 0.2
"""Logarithm of a ratio from which on the specimen shows which of two channels is wrong."""

LEAST_ROCKING = 0.03
"""Of the critical angle, above which the specimen is taken to rock."""

MISPLACED = ("late recorder", "AC coupling", "table motion")
"""Kinds of findings of an acceleration that does not shake the specimen: no transducer is judged by it."""

FEWEST_SECONDS = 5.0
"""Of rocking, over p."""

EXPLAINED = 0.85
"""Correlation with what the specimen's rocking requires, from which on it shows a delay or a high-pass."""

SLOWEST = 0.5
"""Hz, above which an acceleration is integrated."""

CALIBRATED = 0.05
"""Relative departure of their ratio from one that calibrations leave."""

BETTER = 2.0
"""Times less that has to be left unexplained with a delay, or with what a high-pass took off."""

LONGEST_DELAY, LEAST_DELAY = 1.0, 0.01
"""s: the longest delay searched for; the shortest reported."""

LEAST_LOST = 0.1
"""Share of the motion that a high-pass has to take off."""


@dataclass(frozen=True)
class TableChannel:
    """
    A channel of the table along x.

    Attributes
    ----------
    name : str
    values : ndarray, shape (n,)
        m/s² or m.
    noise : float
        Its standard deviation.
    recorder : str
    is_good : bool
        Whether its peaks are beyond doubt.
    """

    name: str
    values: Array
    noise: float
    recorder: str = "main"
    is_good: bool = True


@dataclass(frozen=True)
class Comparison:
    """
    How an acceleration follows a reference that is one, too.

    Attributes
    ----------
    factor, factor_error : float
        Acceleration over reference, with its sign; standard error.
    delay, delay_error : float
        How late it is, s; 0 unless a delay explains far more.
    corner, corner_error : float
        Hz, below which a high-pass took its motion off; 0 unless that explains far more.
    correlation : float
        With these.
    """

    factor: float
    factor_error: float
    correlation: float
    delay: float = 0.0
    delay_error: float = 0.0
    corner: float = 0.0
    corner_error: float = 0.0

    @property
    def differs(self) -> bool:
        """Whether it has another scale, sign, clock or high-pass than declared."""
        return self.is_misplaced or abs(self.factor - 1) > max(CALIBRATED, SURE * self.factor_error)

    @property
    def is_misplaced(self) -> bool:
        """Whether it is late, or lacks what is slow."""
        return bool(self.delay or self.corner)


def compare(interval: float, acceleration: Array, reference: Array, where: Mask) -> Comparison:
    """
    Regress a reference on an acceleration as it is, on a shifted one, and on one with its integral.

    Parameters
    ----------
    interval : float
        s.
    acceleration, reference : ndarray, shape (n,)
        m/s²; finite.
    where : ndarray of bool, shape (n,)
        Samples of the reference that count.

    Notes
    -----
    What a high-pass took off an acceleration a is ω∫a dt if it is of the first order, and √2 ω∫a dt + ω²∬a dt dt of the
    second: the coefficient of the integral is about its corner. Of two explanations the one that leaves less is taken.
    Errors are from what is left, in as many independent samples as the bandwidth allows.
    """
    bandwidth = bandwidth_of(interval)
    recorded = lowpass(acceleration, interval, bandwidth)
    once = integrated(recorded, interval)
    offset = find_offset(
        np.where(where, reference, 0.0), recorded, interval, longest=LONGEST_DELAY, bandwidth_hz=bandwidth
    )
    time = interval * np.arange(recorded.size)
    shifted = np.interp(time + offset.seconds, time, recorded)
    independent = 2 * bandwidth * interval * float(where.sum())
    whole = max(float(np.mean(reference[where] ** 2)), 1e-300)

    def fit(*columns: Array) -> tuple[Array, Array, float]:
        found, errors, left = least_squares(reference, columns, where, independent)
        return found, errors, left**2 / whole

    def better(left: float) -> bool:
        ratio = max(plain, 1e-12) / max(left, 1e-12)
        return ratio > BETTER and 0.5 * independent * log(ratio) > RIVAL_EVIDENCE

    def result(share: float, error: float, left: float, *how: float) -> Comparison:
        return Comparison(1 / share, error / share**2, float(np.sqrt(max(1 - left, 0.0))), *how)

    (share,), (error,), plain = fit(recorded)
    (late,), (late_error,), by_delay = fit(shifted)
    (kept, lost, _), (kept_error, lost_error, _), by_corner = fit(recorded, once, integrated(once, interval))
    is_late = late > 0 and better(by_delay) and abs(offset.seconds) > max(LEAST_DELAY, SURE * offset.standard_error)
    is_cut = kept > 0 and lost > SURE * lost_error and better(by_corner)
    is_cut = is_cut and lost * once[where].std() > LEAST_LOST * reference[where].std()
    if is_cut and not (is_late and by_delay < by_corner):
        hertz = 2 * np.pi * kept
        return result(kept, kept_error, by_corner, 0.0, 0.0, lost / hertz, lost_error / hertz)
    if is_late:
        return result(late, late_error, by_delay, offset.seconds, offset.standard_error)
    return result(share or 1e-300, error, plain)


def integrated(values: Array, interval: float) -> Array:
    """Integral above `SLOWEST`."""
    summed = np.cumsum(values - values.mean()) * interval
    return summed - lowpass(summed, interval, SLOWEST)


def bandwidth_of(interval: float) -> float:
    """Hz, below which the table's channels are compared."""
    return min(BANDWIDTH, 0.2 / interval)


def derived(interval: float, displacement: TableChannel) -> Array:
    """Acceleration of a displacement, below `BANDWIDTH`."""
    return second_derivative(displacement.values, interval, bandwidth_of(interval))


def with_displacement(interval: float, acceleration: TableChannel, displacement: TableChannel) -> Comparison | None:
    """Compare with the second derivative of a displacement; None if they do not agree in any way."""
    due = derived(interval, displacement)
    if not (due.any() and acceleration.values.any()):
        return None
    found = compare(interval, acceleration.values, due, np.ones(due.size, dtype=bool))
    return found if found.correlation >= SAME_MOTION else None


def by_rocking(
    interval: float, name: str, acceleration: Array, angle: Array, noise: float, block: Block
) -> Finding | None:
    """
    Say of an acceleration that it is late or lacks its slow part, by what the specimen's rocking requires.

    Notes
    -----
    While it rocks, a/g = θ − α sgn θ − θ̈/p².
    """
    bandwidth = bandwidth_of(interval)
    critical = block.critical_angle_at(angle)
    near = max(int(1.6 / block.p / interval), 3)
    largest = scipy.ndimage.maximum_filter1d(np.abs(angle), near)
    rocks = (largest > max(STANDING * noise, LEAST_ROCKING * block.critical_angle)) & (np.abs(angle) < critical)
    if rocks.sum() * interval < FEWEST_SECONDS / block.p or not acceleration.any():
        return None
    required = lowpass(angle - critical * np.sign(angle), interval, bandwidth)
    required -= second_derivative(angle, interval, bandwidth) / block.p**2
    found = compare(interval, acceleration, block.gravity * required, rocks)
    if found.correlation < EXPLAINED or not found.is_misplaced:
        return None
    return misplaced(name, found, "the specimen's rocking requires")


def guilty(found: float, by_specimen: float | None) -> Literal["acceleration", "displacement", "either"]:
    """
    Say which of two that differ is wrong.

    Parameters
    ----------
    found : float
        Acceleration over the second derivative of the displacement.
    by_specimen : float or None
        How many times too large the acceleration is by what it does to the specimen.
    """
    if by_specimen is None or (found > 0 and abs(log(found)) < SEEN):
        return "either"

    def is_right(scale: float) -> bool:
        return scale > 0 and as_expected(scale) and (found < 0 or 2 * abs(log(scale)) < abs(log(found)))

    if is_right(by_specimen):
        return "displacement"
    return "acceleration" if is_right(by_specimen / found) else "either"


def disagreement(acceleration: TableChannel, displacement: TableChannel, found: Comparison, wrong: str) -> Finding:
    """
    Say what a comparison that differs means.

    Parameters
    ----------
    acceleration, displacement : TableChannel
    found : Comparison
    wrong : str
        See `guilty`.
    """
    if found.is_misplaced:
        return misplaced(acceleration.name, found, f"{displacement.name} shows")
    which = f"one of the two is wrong, {acceleration.name} or {displacement.name}"
    if wrong != "either":
        guilty_one = displacement.name if wrong == "displacement" else acceleration.name
        which = f"the specimen's rocking shows that {guilty_one} is wrong"
    if found.factor < 0:
        return serious(
            "sign",
            f"channel {acceleration.name} and the second derivative of {displacement.name} have opposite signs: "
            f"{which} (`direction`, or the sign of the gain)",
        )
    why, ratio = cause(found.factor, "acceleration"), 1 / found.factor
    if why == UNKNOWN:
        why = "look at gain, range and AC coupling"
        if acceleration.recorder != displacement.recorder:
            why += f", or whether the file of recorder {acceleration.recorder} is that of another test"
    if wrong == "acceleration":
        why += f". The peak acceleration is then {ratio:.3g} times what is given"
    elif wrong == "either":
        why += f". If it is {acceleration.name}, the peak acceleration is {ratio:.3g} times what is given"
        why += f"; if it is the sampling rate of both, that is {ratio**-0.5:.3g} times what is given"
    return (serious if abs(found.factor - 1) > MISLEADING else warning)(
        "gain",
        f"channel {acceleration.name} is {_written(found.factor, found.factor_error)} times the second derivative "
        f"of {displacement.name}: {which}; {why}",
    )


def misplaced(name: str, found: Comparison, shows: str) -> Finding:
    """Say of an acceleration that it is late, or that a high-pass took its slow part off; `shows` names what does."""
    agree = f"with that they agree (correlation {found.correlation:.2f})"
    if found.corner:
        return serious(
            "AC coupling",
            f"channel {name} lacks what is slower than about {_written(found.corner, found.corner_error)} Hz of "
            f"what {shows}; {agree}: its amplifier blocks slow changes (AC coupling), or a high-pass was applied to "
            "it. Predictions lack that motion: record it with DC coupling and without a high-pass",
        )
    how = "late" if found.delay > 0 else "early"
    return (serious if abs(found.delay) > WRONG_DELAY else warning)(
        "late recorder",
        f"channel {name} is {_written(1e3 * abs(found.delay), 1e3 * found.delay_error)} ms {how} against what {shows}; "
        f"{agree}: its recorder started at another time (align it by its `clock`), or its amplifier or a filter delays "
        "it (`delay` of the channel)",
        follows=("clock",),
    )


def _written(value: float, error: float) -> str:
    """Write a value with its 95 % interval, of which less than a thousandth says nothing."""
    return format_uncertain(value, max(2 * error, 1e-3 * abs(value)))


def humming(interval: float, channel: TableChannel) -> Finding | None:
    """Say of an accelerometer that it hums, if its peak is larger for it."""
    hum, peak = find_hum(channel.values, interval), float(np.abs(channel.values).max())
    if hum is None or hum[1] < LEAST_HUM * peak:
        return None
    frequency, amplitude = hum
    return (serious if amplitude > MISLEADING * peak else warning)(
        "hum",
        f"channel {channel.name} hums at {frequency:g} Hz with ±{amplitude:.2g} m/s², at rest too: that is "
        f"{format_percent(amplitude / peak)} of its peak of {peak:.3g} m/s², which is larger for it. Mains get into "
        "its cable or amplifier (ground and shield them), or a pump shakes the table. "
        f'`base_lowpass` = "{HUMLESS * frequency:g} Hz" under [processing] takes it off, and all faster motion',
    )


def unlike(interval: float, acceleration: TableChannel, displacement: TableChannel) -> Finding | None:
    """Say which of the two stands still, or that they are not of one motion; None if there is no problem."""
    recorded = lowpass(acceleration.values, interval, bandwidth_of(interval))
    due = derived(interval, displacement)
    alike = float(np.corrcoef(recorded, due)[0, 1]) if recorded.std() > 0 and due.std() > 0 else 0.0
    if abs(alike) > OTHER_MOTION:
        return None
    expected, shown = (integrated(integrated(each, interval), interval) for each in (recorded, due))
    # Noise in a second derivative is separated from motion where the displacement itself is.
    moves = shown.std() > STANDING * displacement.noise
    shakes = recorded.std() > STANDING * acceleration.noise
    if shakes and expected.std() > STANDING * displacement.noise and shown.std() < DEAD * expected.std():
        return dead(displacement.name, 1e3 * shown.std(), 1e3 * expected.std(), "mm", acceleration.name)
    if moves and due.std() > STANDING * acceleration.noise and recorded.std() < DEAD * due.std():
        return dead(acceleration.name, recorded.std(), due.std(), "m/s²", displacement.name)
    if moves and shakes:
        return serious(
            "table motion",
            f"channels {acceleration.name} and {displacement.name} both move, but not like one table (correlation "
            f"{alike:.2f}): one of them was read from another column or another test's file, "
            "measures another component of the motion, or is on a recorder that did not start with the other (`clock`)",
            follows=("late recorder",),
        )
    return None
