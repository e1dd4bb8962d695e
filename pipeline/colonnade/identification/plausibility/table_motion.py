"""Whether the table's acceleration is that of its displacement, and that which rocks the specimen."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import log
from typing import Literal, NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array, Mask
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
from colonnade.identification.plausibility.transducers import Rotation
from colonnade.signals.alignment import EVIDENCE, find_offset
from colonnade.signals.filters import lowpass, second_derivative
from colonnade.signals.metrics import find_hum
from colonnade.signals.samples import filled_in
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

FEWEST_SECONDS = 5.0
"""Of rocking, over p."""

EXPLAINED = 0.85
"""Correlation with what the specimen's rocking requires, from which on it shows a delay or a high-pass."""

MISPLACED = ("late recorder", "AC coupling", "table motion")
"""Kinds of findings of an acceleration that does not shake the specimen: no transducer is judged by it."""

SLOWEST = 0.5
"""Hz, above which an acceleration is integrated."""

CALIBRATED = 0.05
"""Relative departure of their ratio from one that calibrations leave."""

MUCH_BETTER = 2.0
"""Times less that has to be left unexplained with a delay, or with what a high-pass took off."""

LONGEST_DELAY, LEAST_DELAY = 1.0, 0.01
"""s: the longest delay searched for; the shortest reported."""

LEAST_LOST = 0.1
"""Share of the motion that a high-pass has to take off."""


class TableChannel(NamedTuple):
    """A channel of the table along x, m/s² or m, its noise, and whether its peaks are beyond doubt."""

    name: str
    values: Array
    noise: float
    recorder: str = "main"
    is_good: bool = True


class Comparison(NamedTuple):
    """
    How an acceleration follows a reference that is one, too.

    Attributes
    ----------
    factor, factor_error : float
        Acceleration over reference, with its sign; standard error.
    correlation : float
        With what follows.
    misplaced : str
        "late recorder" or "AC coupling" where a delay, or a high-pass, explains far more; else empty.
    size, size_error : float
        How late it is, s, or the corner of the high-pass, Hz.
    """

    factor: float
    factor_error: float
    correlation: float
    misplaced: str = ""
    size: float = 0.0
    size_error: float = 0.0

    @property
    def differs(self) -> bool:
        """Whether it has another scale or sign than declared."""
        return abs(self.factor - 1) > max(CALIBRATED, SURE * self.factor_error)


def compare(interval: float, acceleration: Array, reference: Array, where: Mask) -> Comparison:
    """
    Regress a reference (m/s², finite) where it counts on an acceleration as it is, shifted, and with its integral.

    What a high-pass took off an acceleration a is ω∫a dt if it is of the first order, and √2 ω∫a dt + ω²∬a dt dt of the
    second: the coefficient of the integral is about its corner. Of two explanations the one that leaves less is taken.
    Errors are from what is left, in as many independent samples as the bandwidth allows.
    """
    bandwidth = bandwidth_of(interval)
    recorded = lowpass(acceleration, interval, bandwidth)
    if not (recorded.any() and reference.any()):
        return Comparison(np.nan, np.nan, 0.0)
    shown = np.where(where, reference, 0.0)
    offset = find_offset(shown, recorded, interval, longest=LONGEST_DELAY, bandwidth_hz=bandwidth)
    time = interval * np.arange(recorded.size)
    shifted = np.interp(time + offset.seconds, time, recorded)
    once = _integrated(recorded, interval)
    independent = 2 * bandwidth * interval * float(where.sum())
    plain, late, cut = (
        least_squares(reference, columns, where, independent)
        for columns in ([recorded], [shifted], [recorded, once, _integrated(once, interval)])
    )
    corner, corner_error = (each[1] / (2 * np.pi * cut[0][0]) for each in cut[:2])
    taken = cut[0][1] * once[where].std() > LEAST_LOST * reference[where].std()
    candidates = [
        (late, "late recorder", offset.seconds, offset.standard_error, abs(offset.seconds) > LEAST_DELAY),
        (cut, "AC coupling", corner, corner_error, taken),
    ]
    best, how = plain, ("", 0.0, 0.0)
    for fit, kind, size, error, is_seen in candidates:
        better = 2 * log(max(plain[2], 1e-300) / max(fit[2], 1e-6 * plain[2], 1e-300))
        is_sure = better > log(MUCH_BETTER) and 0.5 * independent * better > EVIDENCE
        if is_seen and is_sure and fit[0][0] > 0 and abs(size) > SURE * abs(error) and fit[2] < best[2]:
            best, how = fit, (kind, float(size), float(error))
    (share, *_), (error, *_), left = best
    unexplained = left**2 / max(float(np.mean(reference[where] ** 2)), 1e-300)
    share = share or 1e-300
    return Comparison(1 / share, error / share**2, float(np.sqrt(max(1 - unexplained, 0.0))), *how)


def _integrated(values: Array, interval: float) -> Array:
    """Integral above `SLOWEST`."""
    summed = np.cumsum(values - values.mean()) * interval
    return summed - lowpass(summed, interval, SLOWEST)


def bandwidth_of(interval: float) -> float:
    """Hz, below which the table's channels are compared."""
    return min(BANDWIDTH, 0.2 / interval)


def derived(interval: float, displacement: Array) -> Array:
    """Acceleration of a displacement, below `BANDWIDTH`."""
    return second_derivative(displacement, interval, bandwidth_of(interval))


def table_doubts(
    accelerations: Sequence[TableChannel],
    displacements: Sequence[TableChannel],
    rotation: Rotation | None,
    interval: float,
) -> tuple[list[Finding], float]:
    """
    Say which of the table's channels cannot be right, and how many times too large the acceleration surely is.

    They are held against each other, and against what rocks the specimen.
    """
    rocking = Comparison(np.nan, np.nan, 0.0)
    if rotation is not None and not rotation.mistake:
        rocking = compare(interval, accelerations[0].values, *_required(rotation))
    is_known = rocking.correlation > EXPLAINED
    by_specimen = rocking.factor if is_known and not rocking.misplaced else None
    found: list[Finding] = []
    agree = False
    for one, other in product(accelerations, displacements):
        reference = derived(interval, other.values)
        compared = compare(interval, one.values, reference, np.ones(reference.size, dtype=bool))
        if not compared.correlation >= SAME_MOTION:
            found += _unlike(interval, one, other)
        elif compared.misplaced:
            found.append(_misplaced(one.name, compared, f"{other.name} shows"))
        elif compared.differs and one.is_good and other.is_good:
            wrong = guilty(compared.factor, by_specimen)
            found.append(_disagreement(one, other, compared, wrong))
            if wrong == "acceleration":
                return found, compared.factor
        else:
            agree = True
    name = " and ".join(each.name for each in accelerations)
    if not found and is_known and rocking.misplaced:
        return [_misplaced(name, rocking, "the specimen's rocking requires")], 1.0
    if found or agree or by_specimen is None or as_expected(by_specimen) or not accelerations[0].is_good:
        return found, 1.0
    size = abs(by_specimen)
    text = f"channel {name} is {size:.3g} times what the specimen's rocking requires: {cause(size, 'acceleration')}"
    return [serious("gain", text)], size


def _required(rotation: Rotation) -> tuple[Array, Mask]:
    """Acceleration that a rocking requires, a/g = θ − α sgn θ − θ̈/p², m/s², and where the specimen rocks."""
    gauge = max(rotation.gauges, key=lambda each: abs(each.lever))
    angle, noise = filled_in(gauge.reading) / gauge.lever, gauge.noise / abs(gauge.lever)
    block, interval = rotation.block, rotation.interval
    critical, bandwidth = block.critical_angle_at(angle), bandwidth_of(interval)
    largest = scipy.ndimage.maximum_filter1d(np.abs(angle), max(int(1.6 / block.p / interval), 3))
    rocks = (largest > max(STANDING * noise, LEAST_ROCKING * block.critical_angle)) & (np.abs(angle) < critical)
    if rocks.sum() * interval < FEWEST_SECONDS / block.p:
        return np.zeros(angle.size), rocks
    required = lowpass(angle - critical * np.sign(angle), interval, bandwidth)
    return block.gravity * (required - second_derivative(angle, interval, bandwidth) / block.p**2), rocks


def guilty(found: float, by_specimen: float | None) -> Literal["acceleration", "displacement", "either"]:
    """
    Say which of two that differ is wrong.

    `found` is the acceleration over the second derivative of the displacement, `by_specimen` how many times too large
    the acceleration is by what it does to the specimen.
    """
    if by_specimen is None or (found > 0 and abs(log(found)) < SEEN):
        return "either"

    def is_right(scale: float) -> bool:
        return scale > 0 and as_expected(scale) and (found < 0 or 2 * abs(log(scale)) < abs(log(found)))

    if is_right(by_specimen):
        return "displacement"
    return "acceleration" if is_right(by_specimen / found) else "either"


def _misplaced(name: str, found: Comparison, shows: str) -> Finding:
    """Say of an acceleration that it is late, or that a high-pass took its slow part off; `shows` names what does."""
    agree = f"{shows}; with that they agree (correlation {found.correlation:.2f})"
    if found.misplaced == "AC coupling":
        return serious(
            found.misplaced,
            f"channel {name} lacks what is slower than about {_written(found.size, found.size_error)} Hz of what "
            f"{agree}: its amplifier blocks slow changes (AC coupling), or a high-pass was applied to it. Predictions "
            "lack that motion: record it with DC coupling and without a high-pass",
        )
    delay, how = _written(1e3 * abs(found.size), 1e3 * found.size_error), "late" if found.size > 0 else "early"
    return (serious if abs(found.size) > WRONG_DELAY else warning)(
        found.misplaced,
        f"channel {name} is {delay} ms {how} against what {agree}: its recorder started at another time (align it by "
        "its `clock`), or its amplifier or a filter delays it (`delay` of the channel)",
        follows=("clock",),
    )


def _disagreement(acceleration: TableChannel, displacement: TableChannel, found: Comparison, wrong: str) -> Finding:
    """Say what a ratio that differs means; `wrong` is of `guilty`."""
    name, other = acceleration.name, displacement.name
    which = f"one of the two is wrong, {name} or {other}"
    if wrong != "either":
        which = f"the specimen's rocking shows that {other if wrong == 'displacement' else name} is wrong"
    if found.factor < 0:
        return serious(
            "sign",
            f"channel {name} and the second derivative of {other} have opposite signs: {which} (`direction`, or the "
            "sign of the gain)",
        )
    why, ratio = cause(found.factor, "acceleration"), 1 / found.factor
    if why == UNKNOWN:
        why = "look at gain, range and AC coupling"
        if acceleration.recorder != displacement.recorder:
            why += f", or whether the file of recorder {acceleration.recorder} is that of another test"
    if wrong == "acceleration":
        why += f". The peak acceleration is then {ratio:.3g} times what is given"
    elif wrong == "either":
        why += f". If it is {name}, the peak acceleration is {ratio:.3g} times what is given"
        why += f"; if it is the sampling rate of both, that is {ratio**-0.5:.3g} times what is given"
    return (serious if abs(found.factor - 1) > MISLEADING else warning)(
        "gain",
        f"channel {name} is {_written(found.factor, found.factor_error)} times the second derivative of {other}: "
        f"{which}; {why}",
    )


def _written(value: float, error: float) -> str:
    """Write a value with its 95 % interval, of which less than a thousandth says nothing."""
    return format_uncertain(value, max(2 * error, 1e-3 * abs(value)))


def _unlike(interval: float, acceleration: TableChannel, displacement: TableChannel) -> list[Finding]:
    """Say which of the two stands still, or that they are not of one motion."""
    recorded = lowpass(acceleration.values, interval, bandwidth_of(interval))
    due = derived(interval, displacement.values)
    alike = float(np.corrcoef(recorded, due)[0, 1]) if recorded.std() > 0 and due.std() > 0 else 0.0
    if abs(alike) > OTHER_MOTION:
        return []
    expected, shown = (_integrated(_integrated(each, interval), interval).std() for each in (recorded, due))
    # Noise in a second derivative is separated from motion where the displacement itself is.
    moves = shown > STANDING * displacement.noise
    shakes = recorded.std() > STANDING * acceleration.noise
    if shakes and expected > STANDING * displacement.noise and shown < DEAD * expected:
        return [dead(displacement.name, 1e3 * shown, 1e3 * expected, "mm", acceleration.name)]
    if moves and due.std() > STANDING * acceleration.noise and recorded.std() < DEAD * due.std():
        return [dead(acceleration.name, recorded.std(), due.std(), "m/s²", displacement.name)]
    text = (
        f"channels {acceleration.name} and {displacement.name} both move, but not like one table (correlation "
        f"{alike:.2f}): one of them was read from another column or another test's file, "
        "measures another component of the motion, or is on a recorder that did not start with the other (`clock`)"
    )
    return [serious("table motion", text, follows=("late recorder",))] if moves and shakes else []


def humming(interval: float, channel: TableChannel) -> list[Finding]:
    """Say of an accelerometer that it hums, if its peak is larger for it."""
    hum, peak = find_hum(channel.values, interval), float(np.abs(channel.values).max())
    if hum is None or hum[1] < LEAST_HUM * peak:
        return []
    frequency, amplitude = hum
    text = (
        f"channel {channel.name} hums at {frequency:g} Hz with ±{amplitude:.2g} m/s², at rest too: that is "
        f"{format_percent(amplitude / peak)} of its peak of {peak:.3g} m/s², which is larger for it. Mains get into "
        "its cable or amplifier (ground and shield them), or a pump shakes the table. "
        f'`base_lowpass` = "{HUMLESS * frequency:g} Hz" under [processing] takes it off, and all faster motion'
    )
    return [(serious if amplitude > MISLEADING * peak else warning)("hum", text)]
