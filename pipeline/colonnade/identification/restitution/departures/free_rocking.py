"""Whether the arcs of a record are those of free rocking, by their durations and their shape."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.arcs import Arcs
from colonnade.identification.restitution.arcs.rocking_arc import half_duration_of
from colonnade.units import format_percent

PERIOD_TOLERANCE = 0.15
"""Largest median departure of the arcs' durations from those of this block."""

LEAST_FOLLOWING = 0.6
"""Power of the expected duration with which the measured one changes at least; 1 is a block, 0 an oscillator."""

SHAPE_TOLERANCE = 0.03
"""Largest median difference of the duration that an arc has by its middle part; a sine seems 4 % too short."""

SURE = 3.0
"""Standard errors by which a bound has to be passed."""

BEYOND_ERRORS = 20.0
"""Times by which the expected durations' variance exceeds that of their errors where measured ones must follow."""

LARGEST_ERROR = 0.02
"""Of the durations by the middle part that are looked at, as a share of them."""


def objection(arcs: Arcs, usable: Mask, block: Block) -> str:
    """
    Say why the arcs are not those of this block, if they are not.

    Parameters
    ----------
    arcs : Arcs
        n of them.
    usable : ndarray of bool, shape (n,)
    block : Block

    Returns
    -------
    reason : str
        Empty if they are.

    Notes
    -----
    A rocking block's period falls with its amplitude in its own way, and its arcs are near to parabolas; the duration,
    its change with the peak and what the middle of an arc says of its ends are held against the equation of motion.
    """
    angle = arcs.peak_angle[usable]
    peak, critical, p = np.abs(angle), block.critical_angle_at(angle), block.p_at(angle)
    if peak.size == 0:
        return ""
    expected = 2 * half_duration_of(peak, critical, False) / p
    ratio = arcs.duration[usable] / expected
    excess = float(np.median(ratio)) - 1
    if abs(excess) > PERIOD_TOLERANCE:
        return (
            f"Times between impacts differ by {format_percent(excess, signed=True)} from those of this block in "
            "free rocking at these amplitudes: this is not free rocking of this specimen, or its dimensions are wrong."
        )
    moved = half_duration_of(np.minimum(1.001 * peak, 0.5 * (peak + critical)), critical, False)
    slope = np.log(2 * moved / p / expected) / (np.minimum(1.001 * peak, 0.5 * (peak + critical)) - peak)
    blur = float(np.mean((slope * arcs.peak_standard_error[usable]) ** 2))
    power, error = _power(np.log(expected), np.log(arcs.duration[usable]), blur)
    if power + SURE * error < LEAST_FOLLOWING:
        return (
            f"Times between impacts change with the {power:.2g} ± {error:.2g} power of those of a rocking block; 1 was "
            "expected. A period that does not follow the amplitude is that of an oscillator on springs, not of rocking."
        )
    unsure = np.hypot(arcs.rise_standard_error, arcs.fall_standard_error)[usable] / arcs.duration[usable]
    seen = unsure < LARGEST_ERROR
    if not seen.any():
        return ""
    within = (arcs.fall - arcs.rise)[usable][seen] / arcs.duration[usable][seen]
    median, scatter = float(np.median(within)) - 1, 1.25 * float(np.median(unsure[seen])) / np.sqrt(seen.sum())
    if abs(median) > SHAPE_TOLERANCE + SURE * scatter:
        return (
            "Between impacts the angle is not the arc of a rocking block: judged by its middle part, an arc would "
            f"last {format_percent(median, signed=True)} longer than it does; "
            f"less than {format_percent(SHAPE_TOLERANCE)} was expected. This is not free "
            "rocking."
        )
    return ""


def _power(expected: Array, duration: Array, blur: float) -> tuple[float, float]:
    """Slope of one logarithm against the other, and its standard error; infinite if all is error."""
    centred = expected - expected.mean()
    power = float(centred @ centred)
    if expected.size < 3 or power < max(BEYOND_ERRORS * blur * expected.size, 1e-6):
        return 1.0, np.inf
    slope = float(centred @ duration) / power
    residual = duration - duration.mean() - slope * centred
    return slope, float(np.sqrt(residual @ residual / (expected.size - 2) / power))
