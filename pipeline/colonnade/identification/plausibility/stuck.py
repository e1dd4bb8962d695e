"""Transducers that stand still, or jump, where the specimen cannot: saturated, torn off or stuck."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.factors import STANDING
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.identification.plausibility.scale import BEYOND, WINDOW, Scale, bending, deviation
from colonnade.identification.restitution.arcs.arcs import find_impacts
from colonnade.signals.stretches import filled_in, stretches

FLAT = 0.3
"""Of the deviation that its curvature alone gives an arc over a window, below which a reading stands still."""

LEAST_CURVED = 5.0
"""Times the noise, which that deviation has to exceed."""

ENTERED = 5.0
"""Times that deviation, by which the angle is smaller a window before and after it stands still; 13 for an arc."""

LONGEST = 4.0
"""Over p: a specimen that leans for longer is held."""

LEAST_SHARE = 0.1
"""Of the largest angle, from which on a transducer may saturate."""

FASTEST = 4.0
"""Times p α: no block that stands turns as fast."""


def stuck(
    interval: float, rotation: Rotation, scales: Sequence[Scale], acceleration: Array | None, block: Block
) -> list[Finding]:
    """
    Name transducers that stand still during an arc, or jump; see `suspicions` for the arguments.

    Notes
    -----
    An arc whose angle bends by κ deviates over a window of length T by κT²/√720 at least, at its peak.
    """
    found = []
    for index, scale in enumerate(scales):
        of_angle = scale.value if scale.is_known else 1.0
        of_table = scale.base / scale.value if scale.is_known and scale.base_is_known else 1.0
        felt = None if acceleration is None else of_table * acceleration
        angle = filled_in(rotation.angle(index, of_angle))
        noise = float(rotation.noise[index] / abs(rotation.levers[index] * of_angle))
        known = np.zeros(angle.size, dtype=bool) if rotation.flagged is None else rotation.flagged[index]
        where = [
            place
            for place in _flat(interval, angle, noise, felt, block)
            if not known[place].any() and np.isfinite(rotation.readings[index][place]).any()
        ]
        if where:
            found.append(_saturated(interval, rotation, index, where))
        elif torn := _torn(interval, angle, noise, block):
            found.append(_jumps(interval, rotation, index, *torn))
    return found


def _flat(interval: float, angle: Array, noise: float, acceleration: Array | None, block: Block) -> list[slice]:
    """Stretches after the first impact on which an angle stands still though the equation of motion bends it."""
    largest = float(np.abs(angle).max())
    impacts = find_impacts(np.arange(angle.size, dtype=np.float64), angle, lowest=max(STANDING * noise, 0.02 * largest))
    at_rest, _, *moved = bending(angle, acceleration, block)
    bend = np.asarray(sum(moved, start=at_rest))
    leaning = np.abs(angle) > max(LEAST_SHARE * largest, STANDING * noise)
    leaning[: int(impacts[0]) if impacts.size else None] = False
    # One that leans for longer is held, or lies on its frame.
    longest = LONGEST / block.p / interval
    # A short window finds a short stop, a longer one is less disturbed by noise.
    for factor in (1, 2):
        window = max(round(factor * WINDOW / block.p / interval), 3)
        due = np.abs(scipy.ndimage.uniform_filter1d(bend, window)) * (window * interval) ** 2 / np.sqrt(720)
        shown = deviation(angle, window)
        bent = (shown < FLAT * due) & (due > LEAST_CURVED * noise)
        if found := [
            slice(start, stop)
            for start, stop in zip(*stretches(leaning & bent), strict=True)
            if stop - start < longest
            and _is_entered(angle, slice(start, stop), window, ENTERED * float(due[start:stop].max()))
        ]:
            return found
    return []


def _is_entered(angle: Array, place: slice, window: int, least: float) -> bool:
    """Whether an angle is smaller by `least` before and after: that of a specimen that comes to rest leaning is not."""
    around = np.abs(angle[[max(place.start - window, 0), min(place.stop + window, angle.size - 1)]])
    return bool(around.max() < float(np.median(np.abs(angle[place]))) - least)


def _saturated(interval: float, rotation: Rotation, index: int, places: list[slice]) -> Finding:
    longest = max(places, key=lambda place: place.stop - place.start)
    level = float(np.nanmedian(rotation.readings[index][longest]))
    times = f"{len(places)} times" if len(places) > 1 else "once"
    return serious(
        "end of the range",
        f"channel {rotation.names[index]} stands still {times}, at {_reading(rotation, index, level)} for "
        f"{interval * (longest.stop - longest.start):.2g} s, though the equation of motion turns the specimen on: its "
        "transducer or recorder saturates, or its core sticks. The peak is a lower bound, and the specimen may have "
        "overturned. Give the channel's `range`; repeat the test with a larger one",
    )


def _torn(interval: float, angle: Array, noise: float, block: Block) -> tuple[int, float] | None:
    """Sample of a jump that no block makes, after which nothing moves, and its size, rad; None without one."""
    standing = np.abs(angle) < BEYOND * block.critical_angle
    fast = np.flatnonzero((np.abs(np.gradient(angle, interval)) > FASTEST * block.p * block.critical_angle) & standing)
    window = max(round(WINDOW / block.p / interval), 3)
    if not fast.size or angle.size < fast[-1] + 2 * window:
        return None
    after = angle[fast[-1] + window :]
    if float(after.std()) > STANDING * noise:
        return None
    return int(fast[-1]), abs(float(angle[max(fast[0] - 1, 0)] - after.mean()))


def _jumps(interval: float, rotation: Rotation, index: int, sample: int, size: float) -> Finding:
    return serious(
        "dead channel",
        f"channel {rotation.names[index]} jumps by {_reading(rotation, index, size * abs(rotation.levers[index]))} "
        f"{interval * sample:.4g} s after the start, faster than the specimen can turn, and stands still from then on: "
        "its cable tore, or its core came off. The peak is a lower bound, and the specimen may have overturned",
    )


def _reading(rotation: Rotation, index: int, value: float) -> str:
    return f"{1e3 * value:.3g} {'mrad' if rotation.measures_angle(index) else 'mm'}"
