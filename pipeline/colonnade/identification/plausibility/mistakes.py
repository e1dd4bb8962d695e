"""What has to be mended before a scale means anything: mistakes that can be undone, and what no block does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.identification.plausibility.scale import (
    BEYOND,
    CERTAIN,
    STANDING,
    WINDOW,
    Scale,
    as_expected,
    bending,
    deviation,
)
from colonnade.identification.plausibility.table_motion import LEAST_LOST
from colonnade.identification.restitution.arcs import find_impacts
from colonnade.signals.samples import filled_in, stretches

BETTER = 4.0
"""Times less that has to be left unexplained without the mistake."""

LEAST = 0.01
"""Of what the least of them moves, that is left unexplained with it."""


CORNERS = np.geomspace(0.02, 3.0, 8)
"""Hz, of a high-pass that a transducer alone is looked for behind."""

FOLLOWS = 0.01
"""Relative standard error of its scale, with which its record follows the equation of motion."""

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


def mistakes(
    interval: float, rotation: Rotation, scales: Sequence[Scale], acceleration: Array | None, block: Block
) -> list[Finding]:
    """Name what has to be mended before a scale means anything; see `judge`."""
    mistake = undone(interval, rotation, acceleration, block)
    return [mistake] if mistake else stuck(interval, rotation, scales, acceleration, block)


def undone(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Finding | None:
    """Name the one mistake without which transducers agree on one rotation, and far better; see `judge`."""
    if len(rotation.names) == 1:
        return _coupled_alone(interval, rotation, acceleration, block)
    before, moved = rotation.residual(), float(np.nanstd(rotation.readings, axis=1).min())
    found: dict[float, Finding] = {}
    for named, changed in (*_exchanged(rotation), *_refixed(rotation), *_coupled(interval, rotation)):
        after = changed.residual()
        if before < LEAST * moved or not before > BETTER * after:
            continue
        scales = changed.scales(interval, acceleration, block)
        # What agrees by chance, or with a block that walks, does not obey the equation of motion as well.
        proved = named.kind == "geometry" or all(each.is_known for each in scales)
        if proved and all(as_expected(each.value) for each in scales if each.is_known):
            fall = f"their residual about one rotation falls from {1e3 * before:.2g} to {1e3 * after:.2g} mm"
            found[after] = replace(named, text=f"{named.text}, {fall}")
    return found[min(found)] if found else None


def _exchanged(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    for first, second in combinations(range(len(rotation.names)), 2):
        for with_gains, what in ((False, "columns"), (True, "places")):
            names = f"{rotation.names[first]} and {rotation.names[second]}"
            text = f"channels {names} look swapped: with their {what} exchanged"
            yield serious("swapped channels", text), rotation.exchanged(first, second, with_gains=with_gains)


def _refixed(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    """Some of the transducers on the ground and not on the table, or the reverse."""
    if rotation.refixed is None:
        return
    every = range(len(rotation.names))
    for chosen in (each for count in every for each in combinations(every, count + 1)):
        readings = rotation.readings.copy()
        readings[list(chosen)] -= rotation.refixed[list(chosen)]
        names = " and ".join(rotation.names[index] for index in chosen)
        text = (
            f"channel{'s' if len(chosen) > 1 else ''} {names}: `relative_to` is wrong, the table for the ground or the "
            "reverse: with the table's displacement taken off or added"
        )
        yield serious("geometry", text), replace(rotation, readings=readings)


def _lost(interval: float, reading: Array) -> list[Array]:
    """What a high-pass of the first order takes off, over its ω: the integral, from either end."""
    integral = np.cumsum(filled_in(reading)) * interval
    return [integral - integral[0], integral - integral[-1]]


def _coupled(interval: float, rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    """Each behind a high-pass of the first order, r' = r + ω∫r dt, with the ω that leaves least."""
    misfit = rotation.misfit()
    for index, name in enumerate(rotation.names):
        for added in _lost(interval, rotation.readings[index]):
            lost = np.zeros_like(rotation.readings)
            lost[index] = added
            effect = replace(rotation, readings=rotation.readings + lost).misfit() - misfit
            corner = -float(np.nansum(effect * misfit) / max(float(np.nansum(effect**2)), 1e-300))
            if corner > 0:
                text = f"{_cut_off(name, corner / (2 * np.pi))}, which shows as a slide: with that undone"
                yield serious("AC coupling", text), replace(rotation, readings=rotation.readings + corner * lost)


def _cut_off(name: str, hertz: float) -> str:
    return f"channel {name} does not hold a constant value (AC-coupled, or a high-pass of {hertz:.2g} Hz)"


def _coupled_alone(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Finding | None:
    """The same of one transducer, whose record the equation of motion then explains far better."""
    lost = _lost(interval, rotation.readings[0])

    def scale(hertz: float) -> Scale:
        """Of the two ends that the high-pass may be undone from, that which follows the equation better."""
        mended = (replace(rotation, readings=rotation.readings + 2 * np.pi * hertz * each) for each in lost)
        return min((each.scales(interval, acceleration, block)[0] for each in mended), key=error)

    def error(found: Scale) -> float:
        return found.error / found.value if found.is_known else 1.0

    before = min(error(rotation.scales(interval, acceleration, block)[0]), CERTAIN)
    if before < FOLLOWS / BETTER:
        return None
    coarse = [error(scale(hertz)) for hertz in CORNERS]
    best, step = int(np.argmin(coarse)), float(np.log(CORNERS[1] / CORNERS[0]))
    if not coarse[best] < before:
        return None
    near = scipy.optimize.minimize_scalar(
        lambda change: error(scale(CORNERS[best] * np.exp(change))),
        bounds=(-step if best else 0.0, step),
        method="bounded",
        options={"xatol": 0.02},
    )
    hertz = float(CORNERS[best] * np.exp(near.x))
    found, added = scale(hertz), 2 * np.pi * hertz * float(np.ptp(lost[0]))
    is_seen = added > LEAST_LOST * float(np.nanmax(np.abs(rotation.readings[0])))
    if not (is_seen and error(found) < min(FOLLOWS, before / BETTER) and as_expected(found.value)):
        return None
    return serious(
        "AC coupling",
        f"{_cut_off(rotation.names[0], hertz)}: with that undone its record follows the equation of motion "
        f"{before / error(found):.2g} times as closely. What it gives as leaning, or as another zero, is that; peaks "
        "are wrong by up to as much. Record its direct (DC) output",
    )


def stuck(
    interval: float, rotation: Rotation, scales: Sequence[Scale], acceleration: Array | None, block: Block
) -> list[Finding]:
    """
    Name transducers that stand still during an arc, or jump; see `judge` for the arguments.

    Notes
    -----
    An arc whose angle bends by κ deviates over a window of length T by κT²/√720 at least, at its peak.

    Where most of the others come to rest beyond the critical angle, the specimen fell, and what jumps with it did not
    tear: drums of a column fall faster than a block turns.
    """
    found = []
    fell = np.array([_lies(rotation.angle(index), block) for index in range(len(rotation.names))])
    for index, scale in enumerate(scales):
        name, is_angle, reading = rotation.names[index], rotation.measures_angle(index), rotation.readings[index]
        of_angle = scale.value if scale.is_known else 1.0
        of_table = scale.base / scale.value if scale.is_known and scale.base_is_known else 1.0
        felt = None if acceleration is None else of_table * acceleration
        angle = filled_in(rotation.angle(index, of_angle))
        noise = float(rotation.noise[index] / abs(rotation.levers[index] * of_angle))
        known = np.zeros(angle.size, dtype=bool) if rotation.flagged is None else rotation.flagged[index]
        flat = _flat(interval, angle, noise, felt, block)
        where = [place for place in flat if not known[place].any() and np.isfinite(reading[place]).any()]
        if where:
            longest = max(where, key=lambda place: place.stop - place.start)
            level = _written(float(np.nanmedian(reading[longest])), is_angle)
            text = (
                f"channel {name} stands still {f'{len(where)} times' if len(where) > 1 else 'once'}, at {level} for "
                f"{interval * (longest.stop - longest.start):.2g} s, though the equation of motion turns the specimen "
                "on: its transducer or recorder saturates, or its core sticks. The peak is a lower bound, and the "
                "specimen may have overturned. Give the channel's `range`; repeat the test with a larger one"
            )
            found.append(serious("end of the range", text))
        elif (fell.sum() - fell[index] <= (fell.size - 1) / 2) and (torn := _torn(interval, angle, noise, block)):
            sample, size = torn
            text = (
                f"channel {name} jumps by {_written(size * abs(rotation.levers[index]), is_angle)} "
                f"{interval * sample:.4g} s after the start, faster than the specimen can turn, and stands still from "
                "then on: its cable tore, or its core came off. The peak is a lower bound, and the specimen may have "
                "overturned"
            )
            found.append(serious("dead channel", text))
    return found


def _written(value: float, is_angle: bool) -> str:
    return f"{1e3 * value:.3g} {'mrad' if is_angle else 'mm'}"


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


def _lies(angle: Array, block: Block) -> bool:
    """Whether the last known angle is beyond the critical one."""
    known = angle[np.isfinite(angle)]
    return bool(known.size and abs(known[-1]) > block.critical_angle)


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
