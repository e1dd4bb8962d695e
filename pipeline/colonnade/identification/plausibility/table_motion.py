"""Whether the table's acceleration and displacement are the same motion in the same units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from colonnade.arrays import Array
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.factors import as_expected, cause
from colonnade.signals.filters import lowpass, second_derivative

BANDWIDTH = 10.0
"""Hz, below which the two are compared: above it a displacement's noise is larger than its motion."""

SLOWEST = 0.5
"""Hz, above which an acceleration is integrated to see whether a displacement should show."""

SAME_MOTION = 0.9
"""Correlation from which on the two are of one motion, so that their ratio means something."""

OTHER_MOTION = 0.5
"""Correlation below which they are not."""

STANDING = 8.0
"""Times its noise below which a channel does not move."""

DEAD = 0.1
"""Share of what the other gives below which a channel is dead."""


@dataclass(frozen=True)
class TableChannel:
    """A channel of the table along x: its name, its values (m/s² or m) and the standard deviation of their noise."""

    name: str
    values: Array
    noise: float


def ratio(interval: float, acceleration: TableChannel, displacement: TableChannel) -> float | None:
    """
    Acceleration over the second derivative of the displacement, with its sign; None if they do not agree.

    Parameters
    ----------
    interval : float
        s.
    acceleration, displacement : TableChannel
        On one clock; finite.
    """
    recorded, derived = _band(interval, acceleration, displacement)
    agreement = _correlation(recorded, derived)
    if abs(agreement) < SAME_MOTION:
        return None
    return float(np.copysign(recorded.std() / derived.std(), agreement))


def guilty(found: float, by_specimen: float | None) -> Literal["", "acceleration", "displacement", "either"]:
    """
    Say which of the two is wrong; empty if both are right.

    Parameters
    ----------
    found : float
        Acceleration over the second derivative of the displacement.
    by_specimen : float or None
        How many times too large the acceleration is by what it does to the specimen.
    """
    if as_expected(found) and found > 0:
        return ""
    if by_specimen is not None and as_expected(by_specimen) and by_specimen > 0:
        return "displacement"
    if by_specimen is not None and as_expected(by_specimen / found) and by_specimen * found > 0:
        return "acceleration"
    return "either"


def disagreement(acceleration: str, displacement: str, found: float, wrong: str) -> Finding:
    """
    Say what a ratio that is not one means.

    Parameters
    ----------
    acceleration, displacement : str
        Names of the channels.
    found : float
        Their ratio.
    wrong : str
        See `guilty`.
    """
    which = {
        "acceleration": f"the specimen's rocking shows that {acceleration} is wrong",
        "displacement": f"the specimen's rocking shows that {displacement} is wrong",
        "either": f"one of the two is wrong, {acceleration} or {displacement}",
    }[wrong]
    if as_expected(found):
        return serious(
            "sign",
            f"channel {acceleration} and the second derivative of {displacement} have opposite signs: {which} "
            "(`direction`, or the sign of the gain)",
        )
    return serious(
        "gain",
        f"channel {acceleration} is {found:.3g} times the second derivative of {displacement}: {which}; "
        f"{cause(found, 'acceleration')}",
    )


def dead(interval: float, acceleration: TableChannel, displacement: TableChannel) -> Finding | None:
    """Say which of the two stands still, or that they are not of one motion; None if there is no problem."""
    recorded, derived = _band(interval, acceleration, displacement)
    if abs(_correlation(recorded, derived)) > OTHER_MOTION:
        return None
    due, shown = _integrated(recorded, interval), _integrated(derived, interval)
    # Noise in a second derivative is separated from motion where the displacement itself is.
    moves = shown.std() > STANDING * displacement.noise
    shakes = recorded.std() > STANDING * acceleration.noise
    if shakes and due.std() > STANDING * displacement.noise and shown.std() < DEAD * due.std():
        return _standing(displacement.name, acceleration.name, 1e3 * shown.std(), 1e3 * due.std(), "mm")
    if moves and derived.std() > STANDING * acceleration.noise and recorded.std() < DEAD * derived.std():
        return _standing(acceleration.name, displacement.name, recorded.std(), derived.std(), "m/s²")
    if moves and shakes:
        return serious(
            "table motion",
            f"channels {acceleration.name} and {displacement.name} both move, but not like one table (correlation "
            f"{_correlation(recorded, derived):.2f}): one of them was read from another column, measures "
            "another component of the motion, or is on a recorder that did not start with the other (`clock`)",
            follows=("late recorder",),
        )
    return None


def _standing(still: str, other: str, shown: float, due: float, unit: str) -> Finding:
    return serious(
        "dead channel",
        f"channel {still} hardly moves ({shown:.2g} {unit} RMS), although {other} gives {due:.2g} {unit}: it is dead, "
        "or its gain is far too small. Check cable and sensor",
    )


def _band(interval: float, acceleration: TableChannel, displacement: TableChannel) -> tuple[Array, Array]:
    bandwidth = min(BANDWIDTH, 0.2 / interval)
    return (
        lowpass(acceleration.values, interval, bandwidth),
        second_derivative(displacement.values, interval, bandwidth),
    )


def _correlation(first: Array, second: Array) -> float:
    if not (first.std() > 0 and second.std() > 0):
        return 0.0
    return float(np.corrcoef(first, second)[0, 1])


def _integrated(acceleration: Array, interval: float) -> Array:
    """Displacement of an acceleration above `SLOWEST`, m."""
    spectrum = np.fft.rfft(acceleration)
    frequency = np.fft.rfftfreq(acceleration.size, interval)
    kept = frequency >= SLOWEST
    spectrum[kept] /= -((2 * np.pi * frequency[kept]) ** 2)
    spectrum[~kept] = 0.0
    return np.asarray(np.fft.irfft(spectrum, acceleration.size))
