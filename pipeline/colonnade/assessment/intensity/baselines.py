"""Corrections of the baseline of a ground motion by name. They are used only where one is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.intensity.ground import Ground
from colonnade.assessment.intensity.naming import quantity_of, split_name
from colonnade.errors import nearest
from colonnade.validation import text

NONE = "none"
"""The name of no correction."""

CORNER = 0.1
"""Hz, of the high-pass, if its name gives no other."""

LEAST_CORNER = 1e-3
"""Hz: slower than any motion of the ground that is recorded; the zeros around the record grow with its inverse."""

ORDER = 2
"""Of the high-pass in each direction."""

PADDING = 1.5
"""Zeros before and after the record over the order of the whole filter and its corner: 1.5 n / f (Converse 1992)."""


@dataclass(frozen=True)
class Baseline:
    """
    A correction.

    Attributes
    ----------
    name : str
    definition, source : str
    correct : callable
        Acceleration (m/s²) and interval (s) in, corrected acceleration out; shapes (n,).
    """

    name: str
    definition: str
    source: str
    correct: Callable[[Array, float], Array]


def baseline_of(name: str) -> Baseline:
    """
    Find a correction by its name; that of the high-pass may give its corner, "highpass(0.05 Hz)".

    Raises
    ------
    ValueError
        If it is not known, or its corner is not a frequency.
    """
    bare, given = split_name(text("baseline", name, "the name of a correction"))
    if bare not in BASELINES:
        raise ValueError(f'Unknown baseline correction "{name}".{nearest(name, BASELINES)}')
    if given is None:
        return BASELINES[bare]
    if bare != "highpass":
        raise ValueError(f'"{name}": nothing in brackets was expected, but for highpass its corner, "highpass(0.1 Hz)"')
    corner = quantity_of(name, given, "frequency")
    if corner < LEAST_CORNER:
        raise ValueError(f'"{name}": a corner of at least {LEAST_CORNER:g} Hz was expected')
    return _highpass(corner, name)


def corrected(ground: Ground, baseline: str) -> Ground:
    """
    Correct the baseline of a motion.

    Raises
    ------
    ValueError
        As `baseline_of`; or if the corner is not below half the sampling rate.
    """
    return replace(ground, acceleration=baseline_of(baseline).correct(ground.acceleration, ground.interval))


def _without_line(acceleration: Array, interval: float) -> Array:
    return _without_polynomial(acceleration, interval, 1)


def _without_parabola(acceleration: Array, interval: float) -> Array:
    return _without_polynomial(acceleration, interval, 2)


def _without_polynomial(acceleration: Array, interval: float, degree: int) -> Array:
    """Subtract the derivative of the polynomial through zero that is closest to the velocity."""
    velocity = Ground(acceleration, interval).velocity
    share = np.arange(acceleration.size) / max(acceleration.size - 1, 1)
    powers = np.arange(1, degree + 1)
    factors = np.linalg.lstsq(share[:, None] ** powers, velocity, rcond=None)[0]
    slope = share[:, None] ** (powers - 1) @ (powers * factors)
    return np.asarray(acceleration - slope / (max(acceleration.size - 1, 1) * interval))


def _highpass(corner: float, name: str) -> Baseline:
    def correct(acceleration: Array, interval: float) -> Array:
        import scipy  # the check of a campaign file must not load it

        if not corner < 0.5 / interval:
            raise ValueError(
                f"{name}: the corner {corner:g} Hz is not below half the sampling rate, {0.5 / interval:g} Hz"
            )
        sections = scipy.signal.butter(ORDER, corner, "highpass", fs=1 / interval, output="sos")
        padding = np.zeros(round(PADDING * 2 * ORDER / (corner * interval)))
        padded = np.concatenate((padding, acceleration, padding))
        filtered = scipy.signal.sosfiltfilt(sections, padded, padtype=None)
        return np.asarray(filtered[padding.size : padding.size + acceleration.size])

    return Baseline(
        name,
        f"Butterworth high-pass of order {ORDER} at {corner:g} Hz, run forwards and backwards over the acceleration "
        "with zeros before and after, then cut to the record",
        "Boore and Bommer 2005",
        correct,
    )


BASELINES: dict[str, Baseline] = {
    each.name: each
    for each in (
        Baseline(NONE, "the motion as it is", "", lambda acceleration, _interval: acceleration),
        Baseline(
            "linear",
            "the acceleration less a constant: the slope of the line through zero that is closest to the velocity",
            "Boore 2001",
            _without_line,
        ),
        Baseline(
            "quadratic",
            "the acceleration less a line: the derivative of the parabola through zero that is closest to the velocity",
            "Boore, Stephens and Joyner 2002",
            _without_parabola,
        ),
        _highpass(CORNER, "highpass"),
    )
}
"""All corrections by name, in the order of tables."""
