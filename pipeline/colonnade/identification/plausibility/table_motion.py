"""Whether the table's acceleration is that of its displacement, and that which rocks the specimen."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import isfinite, pi
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.findings import Finding, serious, warning
from colonnade.identification.plausibility.scale import (
    MISLEADING,
    STANDING,
    SURE,
    UNKNOWN,
    as_expected,
    cause,
    least_squares,
)
from colonnade.identification.plausibility.transducers import Rotation
from colonnade.signals.alignment import find_offset
from colonnade.signals.filters import lowpass, second_derivative
from colonnade.units.text import format_uncertain

BANDWIDTH = 10.0
"""Hz, below which the two are compared: above it a displacement's noise is larger than its motion."""

SAME_MOTION, OTHER_MOTION = 0.9, 0.5
"""Correlation from which on the two are of one motion, so that their ratio means something; below it they are not."""

WRONG_DELAY = 0.03
"""s, from which on predictions are wrong."""

MISPLACED = ("late recorder", "table motion")
"""Kinds of findings of an acceleration that does not shake the specimen: no transducer is judged by it."""

CALIBRATED = 0.05
"""Relative departure of their ratio from one that calibrations leave."""

MUCH_BETTER = 1.6
"""Times less that has to be left unexplained with a delay."""

LONGEST_DELAY, LEAST_DELAY = 1.0, 0.01
"""s: the longest delay searched for; the shortest reported."""


class TableChannel(NamedTuple):
    """A channel of the table along x, m/s² or m, its noise, and whether its peaks are beyond doubt."""

    name: str
    values: Array
    noise: float
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
    delay, delay_error : float
        How late it is, s, where that explains far more; else 0.
    """

    factor: float
    factor_error: float
    correlation: float
    delay: float = 0.0
    delay_error: float = 0.0

    @property
    def differs(self) -> bool:
        """Whether it has another scale or sign than declared."""
        return abs(self.factor - 1) > max(CALIBRATED, SURE * self.factor_error)


def compare(interval: float, acceleration: Array, reference: Array) -> Comparison:
    """
    Regress a reference (m/s², finite) on an acceleration as it is, and shifted.

    Errors are from what is left, in as many independent samples as the bandwidth allows.
    """
    bandwidth = bandwidth_of(interval)
    recorded = lowpass(acceleration, interval, bandwidth)
    if not (recorded.any() and reference.any()):
        return Comparison(np.nan, np.nan, 0.0)
    offset = find_offset(reference, recorded, interval, longest=LONGEST_DELAY, bandwidth_hz=bandwidth)
    time, everywhere = interval * np.arange(recorded.size), np.ones(recorded.size, dtype=np.bool_)
    independent = 2 * bandwidth * interval * recorded.size
    best, late = (
        least_squares(reference, [column], everywhere, independent)
        for column in (recorded, np.interp(time + offset.seconds, time, recorded))
    )
    delay = 0.0, 0.0
    is_sure = abs(offset.seconds) > max(LEAST_DELAY, SURE * offset.standard_error)
    if is_sure and late[0][0] > 0 and best[2] > MUCH_BETTER * late[2]:
        best, delay = late, (offset.seconds, offset.standard_error)
    [share], [error], left = best
    unexplained = left**2 / float(np.mean(reference**2))
    share = float(share) or 1e-300
    return Comparison(1 / share, float(error) / share**2, max(1 - unexplained, 0.0) ** 0.5, *delay)


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
) -> list[Finding]:
    """
    Say which of the table's channels cannot be right.

    They are held against each other, and the first acceleration, that of the rotation, against what rocks the specimen.
    """
    by_specimen = np.nan if rotation is None or rotation.mistake else rotation.shaken
    found: list[Finding] = []
    agree = False
    for one, other in product(accelerations, displacements):
        compared = compare(interval, one.values, derived(interval, other.values))
        if not compared.correlation >= SAME_MOTION:
            found += _unlike(interval, one, other, compared.correlation)
        elif compared.delay:
            found.append(_late(one.name, compared, other.name))
        elif compared.differs and one.is_good and other.is_good:
            found.append(_disagreement(one, other, compared, by_specimen))
        else:
            agree = True
    if found or np.isnan(by_specimen):
        return found
    if by_specimen > 0 and (agree or as_expected(by_specimen) or not accelerations[0].is_good):
        return []
    kind, why = "gain", cause(by_specimen, "acceleration")
    if by_specimen < 0:
        kind = "sign"
        why = "its sign is wrong, or that of all transducers on the specimen (`direction`, or the sign of the gain)"
    name = " and ".join(each.name for each in accelerations)
    text = f"channel {name} is {by_specimen:.3g} times what the specimen's rocking requires: {why}"
    return [serious(kind, text)]


def _late(name: str, found: Comparison, other: str) -> Finding:
    """Say of an acceleration that it is late against a displacement."""
    delay, how = _written(1e3 * abs(found.delay), 1e3 * found.delay_error), "late" if found.delay > 0 else "early"
    return (serious if abs(found.delay) > WRONG_DELAY else warning)(
        "late recorder",
        f"channel {name} is {delay} ms {how} against what {other} shows; with that they agree (correlation "
        f"{found.correlation:.2f}): its recorder started at another time (align it by its `clock`), or its amplifier "
        "or a filter delays it (`delay` of the channel)",
        follows=("clock",),
    )


def _disagreement(
    acceleration: TableChannel, displacement: TableChannel, found: Comparison, by_specimen: float
) -> Finding:
    """Say what a ratio that differs means; the acceleration is `by_specimen` times what rocks the specimen."""
    name, other = acceleration.name, displacement.name
    which = f"one of the two is wrong, {name} or {other}"
    if isfinite(by_specimen):
        which += f" (the specimen's rocking asks for {1 / by_specimen:.3g} × {name})"
    if found.factor < 0:
        return serious(
            "sign",
            f"channel {name} and the second derivative of {other} have opposite signs: {which}. Look at `direction` "
            "and the sign of the gain",
        )
    why, ratio = cause(found.factor, "acceleration"), 1 / found.factor
    if why == UNKNOWN:
        why = "look at gain, range and AC coupling, or whether one of them is from the file of another test"
    return (serious if abs(found.factor - 1) > MISLEADING else warning)(
        "gain",
        f"channel {name} is {_written(found.factor, found.factor_error)} times the second derivative of {other}: "
        f"{which}; {why}. If it is {name}, the peak acceleration is {ratio:.3g} times what is given; if it is the "
        f"sampling rate of both, that is {ratio**-0.5:.3g} times what is given",
    )


def _written(value: float, error: float) -> str:
    """Write a value with its 95 % interval, of which less than a thousandth says nothing."""
    return format_uncertain(value, max(2 * error, 1e-3 * abs(value)))


def _unlike(interval: float, one: TableChannel, other: TableChannel, correlation: float) -> list[Finding]:
    """Say that an acceleration and a displacement are not of one motion, if one of them moves beyond its noise."""
    bandwidth = bandwidth_of(interval)
    shown, due = float(lowpass(one.values, interval, bandwidth).std()), float(derived(interval, other.values).std())
    noise = max(one.noise, other.noise * (2 * pi * bandwidth) ** 2)
    if correlation > OTHER_MOTION or max(shown, due) < STANDING * noise:
        return []
    text = (
        f"channels {one.name} and {other.name} do not move like one table (correlation {correlation:.2f}): {one.name} "
        f"shows {shown:.2g} m/s² RMS below {bandwidth:g} Hz, the second derivative of {other.name} {due:.2g} m/s². One "
        "of them is dead, was read from another column or another test's file, measures another component of the "
        "motion, lacks its slow part (AC coupling), or is on a recorder that did not start with the other (`clock`)"
    )
    return [serious("table motion", text, follows=("late recorder",))]
