"""How many times too large a record is: by the equation of motion, and the mistake that a factor points to."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite, log

import numpy as np
import scipy

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.signals.samples import filled_in

LOOSE = 1.5
"""A scale within this factor of one is as expected: dimensions, friction and noise are in it."""

CLOSE = 1.12
"""A scale within this factor of a known one is a sign of it."""

STANDING = 8.0
"""Times its noise below which a channel does not move."""

MISLEADING = 0.1
"""Relative departure of a scale from which on results are wrong."""

UNKNOWN = "look at its gain and unit"
"""Cause of a scale that is a sign of nothing."""

_LENGTH = ((25.4, "inches read as mm, or the reverse"), (2.54, "inches read as cm, or the reverse"))
_CAUSES = {
    "acceleration": ((9.80665, "g read as m/s² or the reverse, or a gain wrong by a factor of 10"),),
    "displacement": ((10.0, "a gain wrong by a factor of 10, or cm read as mm"), *_LENGTH),
    "angle": ((57.29578, "degrees read as radians, or the reverse"), (10.0, "a gain wrong by a factor of 10")),
}
_EVERY = (
    (100.0, "a gain wrong by a factor of 100, or cm read as m, or Gal as m/s²"),
    (1000.0, "a gain wrong by a factor of 1000, or mm read as m, or mV as V"),
    (10.0, "a gain wrong by a factor of 10"),
)

WINDOW = 0.4
"""Length over which the equation of motion is held against the record, over p: shorter than all arcs that count."""

BLURRED = 0.1
"""Over p: what a low-pass rounds on either side of an impact."""

FEWEST_SECONDS, FEWEST_SAMPLES = 2.0, 10
"""Of rocking between impacts, over p; a shorter record gives no scale."""

CALIBRATED = 0.025
"""Relative departure of a scale from one that calibration and sizes leave; ..."""

SURE = 4.0
"""... and the standard errors that it also has to exceed."""

LEAST_RATE = 0.01
"""Relative departure of p that a clock is suspected of."""

CERTAIN = 0.15
"""Largest standard error of a scale, relative to it, with which it is used."""

MOVES = 0.03
"""Of the largest angle, above which the specimen is taken to rock."""

HELD = 0.02
"""Of the largest angle, below which the deviation of one that is not upright means that the specimen is held."""

BEYOND = 1.3
"""Times the critical angle, from which on a specimen falls into its frame."""

UNEXPLAINED = 0.5
"""Of what bends the angle: if more is left, the record is not that of a rocking block on this table."""

STEPS = 12
LARGEST_STEP = 2.0
"""Factor by which a step changes the scale at most."""


def as_expected(scale: float) -> bool:
    """Whether a scale is one, as far as such a comparison shows; its sign does not count."""
    return isfinite(scale) and scale != 0 and abs(log(abs(scale))) < log(LOOSE)


def cause(scale: float, quantity: str) -> str:
    """
    Probable cause of a scale.

    Examples
    --------
    >>> cause(0.101, "displacement"), cause(3.3, "angle")
    ('a gain wrong by a factor of 10, or cm read as mm', 'look at its gain and unit')
    """
    for factor, words in (*_CAUSES.get(quantity, ()), *_EVERY):
        if abs(abs(log(abs(scale))) - log(factor)) < log(CLOSE):
            return words
    return UNKNOWN


@dataclass(frozen=True)
class Scale:
    """
    How large a transducer's rotation is against the equation of motion.

    Attributes
    ----------
    value, error : float
        1 where it is right; standard error.
    base : float
        The same from what the table's acceleration does to it, with its sign; NaN where that is not known.
    rate : float
        How many times p of the block is that of the record, as of a wrong clock, if that explains the scale; else NaN.
    """

    value: float
    error: float
    base: float = np.nan
    rate: float = np.nan

    @property
    def is_known(self) -> bool:
        """Whether the record gives the scale."""
        return bool(self.value > 0 and self.error < CERTAIN * self.value)

    @property
    def differs(self) -> bool:
        """Whether it is known, and not one."""
        return self.is_known and abs(self.value - 1) > max(CALIBRATED * self.value, SURE * self.error)

    @property
    def misleads(self) -> bool:
        """Whether it makes results wrong."""
        return abs(log(abs(self.value))) > log(1 + MISLEADING)


UNKNOWN_SCALE = Scale(np.nan, np.nan)


def scale_of(
    interval: float,
    angle_at: Callable[[float], Array],
    noise: float,
    acceleration: Array | None,
    block: Block,
    *,
    blur: float = 0.0,
) -> Scale:
    """
    Find how many times too large an angle is, by the equation of motion; NaN where the specimen hardly rocks.

    `angle_at` gives θ (n,), rad, NaN where missing, if its readings are so many times too large; `noise` is its
    standard deviation, rad, and `acceleration` (n,) that of the table along x, m/s²; `blur` is what a low-pass rounds
    on either side of an impact, s (at least `BLURRED` is left out).

    Between impacts θ̈ = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)]. Both sides are averaged with the same smooth
    weight over windows that hold no impact, so that noise is not differentiated, and α (a times larger angle looks like
    a times larger α), the share of a, and then p are found by least squares. The errors are those of the residuals.
    """
    weight, recorded = _weight(interval, block.p), angle_at(1.0)
    gaps = scipy.ndimage.maximum_filter1d(~np.isfinite(recorded), weight.size)
    around = weight.size + 2 * int(max(BLURRED / block.p, blur) / interval)
    free = _between_impacts(interval, filled_in(recorded), noise, block.p, around) & ~gaps
    value = max(float(np.nanmax(np.abs(recorded))) / (BEYOND * block.critical_angle), 1.0)
    for _ in range(STEPS):
        angle = filled_in(angle_at(value))
        within = free & (np.abs(angle) < BEYOND * block.critical_angle)
        if within.sum() < max(FEWEST_SECONDS / block.p / interval, FEWEST_SAMPLES):
            return UNKNOWN_SCALE
        bend = _averaged(np.gradient(np.gradient(angle, interval), interval), weight)
        turning, *columns = (_averaged(each, weight) for each in _bending(angle, acceleration, block))
        independent = 3 * within.sum() * interval * block.p / WINDOW  # three in a window
        found, errors, _ = least_squares(bend - turning, columns, within, independent)
        step = float(np.clip(1 + found[0], 1 / LARGEST_STEP, LARGEST_STEP))
        value *= step
        if abs(step - 1) < 0.1 * errors[0]:
            break
    freed, freed_errors, left = least_squares(bend, [turning, *columns], within, independent)
    if left > UNEXPLAINED * float(np.std(bend[within])):
        return UNKNOWN_SCALE
    rate, rate_error = max(float(freed[0]), 1e-9) ** 0.5, float(freed_errors[0]) / 2
    without_rate = max(value * (1 + float(freed[1]) / rate**2), 1e-9)
    explains = abs(log(without_rate)) < abs(log(value)) / 2 and abs(rate - 1) > max(SURE * rate_error, LEAST_RATE)
    shows_base = acceleration is not None and errors[1] < CERTAIN * abs(found[1])
    base = value * float(found[1]) if shows_base else np.nan
    return Scale(value, value * float(errors[0]), base, rate if explains else np.nan)


def _bending(angle: Array, acceleration: Array | None, block: Block) -> list[Array]:
    """What bends an angle, rad/s²: at a table at rest, per relative change of α, and by the table if that is known."""
    critical, squared = np.copysign(block.critical_angle_at(angle), angle), block.p_at(angle) ** 2
    pull = -squared * np.cos(critical - angle)
    terms = [-squared * np.sin(critical - angle), pull * critical]
    return terms if acceleration is None else [*terms, pull * filled_in(acceleration) / block.gravity]


def least_squares(
    values: Array, columns: Sequence[Array], chosen: Mask, independent: float
) -> tuple[Array, Array, float]:
    """Coefficients, their standard errors with so many independent samples, and the RMS of what is left."""
    matrix = np.column_stack(columns)[chosen]
    inverse = np.linalg.pinv(matrix.T @ matrix)
    found = inverse @ (matrix.T @ values[chosen])
    left = float(np.mean((values[chosen] - matrix @ found) ** 2))
    errors = np.sqrt(np.diag(inverse) * left * chosen.sum() / max(independent - found.size, 1.0))
    return found, errors, left**0.5


def _weight(interval: float, p: float) -> Array:
    """Weight of the samples of a window, that falls to zero with its slope and curvature."""
    half = max(round(WINDOW / 2 / p / interval), 3)
    weight = (1 - (np.arange(-half, half + 1) / (half + 1)) ** 2) ** 3
    return np.asarray(weight / weight.sum())


def _averaged(values: Array, weight: Array) -> Array:
    return np.asarray(scipy.signal.oaconvolve(values, weight, mode="same"))


def _between_impacts(interval: float, angle: Array, noise: float, p: float, around: int) -> Mask:
    """Samples about which so many have no impact, of a movement that is neither noise nor held far from rest."""
    magnitude = np.abs(angle)
    largest = float(magnitude.max())
    window = max(int(1.6 / p / interval), 3)
    moves = scipy.ndimage.maximum_filter1d(magnitude, window) > max(STANDING * noise, MOVES * largest)
    lowest, highest = (each(angle, around) for each in (scipy.ndimage.minimum_filter1d, scipy.ndimage.maximum_filter1d))
    mean, squared = (scipy.ndimage.uniform_filter1d(each, window) for each in (angle, angle**2))
    still = squared - mean**2 < (HELD * largest) ** 2
    held = still & (magnitude > max(STANDING * noise, 0.3 * MOVES * largest))
    inside = np.zeros(angle.size, dtype=bool)
    inside[around:-around] = True
    return np.asarray(
        inside & moves & ((lowest > 0) | (highest < 0)) & ~scipy.ndimage.binary_dilation(held, iterations=window)
    )
