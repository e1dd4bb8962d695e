"""What has to be mended before a scale means anything: mistakes that can be undone, and what no block does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.rotation import Gauge, Rotation
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


def undone(rotation: Rotation) -> Finding | None:
    """Name the one mistake without which transducers agree on one rotation, and far better."""
    if len(rotation.gauges) == 1:
        return _coupled_alone(rotation)
    before, moved = rotation.residual(), min(float(np.nanstd(each.reading)) for each in rotation.gauges)
    found: dict[float, Finding] = {}
    for named, changed in (*_exchanged(rotation), *_refixed(rotation), *_coupled(rotation)):
        after = changed.residual()
        if before < LEAST * moved or not before > BETTER * after:
            continue
        # What agrees by chance, or with a block that walks, does not obey the equation of motion as well.
        proved = named.kind == "geometry" or all(each.is_known for each in changed.scales)
        if proved and all(as_expected(each.value) for each in changed.scales if each.is_known):
            fall = f"their residual about one rotation falls from {1e3 * before:.2g} to {1e3 * after:.2g} mm"
            found[after] = replace(named, text=f"{named.text}, {fall}")
    return found[min(found)] if found else None


def _exchanged(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    for first, second in combinations(rotation.gauges, 2):
        for with_gains, what in ((False, "columns"), (True, "places")):
            text = f"channels {first.name} and {second.name} look swapped: with their {what} exchanged"
            yield serious("swapped channels", text), rotation.exchanged(first, second, with_gains=with_gains)


def _refixed(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    """Some of the transducers on the ground and not on the table, or the reverse."""
    moved = {
        each: replace(each, reading=each.reading - each.refixed) for each in rotation.gauges if each.refixed is not None
    }
    for chosen in (some for count in range(len(moved)) for some in combinations(moved, count + 1)):
        names = " and ".join(each.name for each in chosen)
        text = (
            f"channel{'s' if len(chosen) > 1 else ''} {names}: `relative_to` is wrong, the table for the ground or the "
            "reverse: with the table's displacement taken off or added"
        )
        yield serious("geometry", text), rotation.with_gauges(*(moved[each] for each in chosen))


def _lost(rotation: Rotation, gauge: Gauge) -> list[Array]:
    """What a high-pass of the first order takes off, over its ω: the integral, from either end."""
    integral = np.cumsum(filled_in(gauge.reading)) * rotation.interval
    return [integral - integral[0], integral - integral[-1]]


def _coupled(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    """Each behind a high-pass of the first order, r' = r + ω∫r dt, with the ω that leaves least."""
    misfit = rotation.misfit()
    for gauge in rotation.gauges:
        for lost in _lost(rotation, gauge):
            effect = rotation.added(gauge, lost).misfit() - misfit
            corner = -float(np.nansum(effect * misfit) / max(float(np.nansum(effect**2)), 1e-300))
            if corner > 0:
                text = f"{_cut_off(gauge, corner / (2 * np.pi))}, which shows as a slide: with that undone"
                yield serious("AC coupling", text), rotation.added(gauge, corner * lost)


def _cut_off(gauge: Gauge, hertz: float) -> str:
    return f"channel {gauge.name} does not hold a constant value (AC-coupled, or a high-pass of {hertz:.2g} Hz)"


def _coupled_alone(rotation: Rotation) -> Finding | None:
    """The same of one transducer, whose record the equation of motion then explains far better."""
    (gauge,) = rotation.gauges
    lost = _lost(rotation, gauge)

    def scale(hertz: float) -> Scale:
        """Of the two ends that the high-pass may be undone from, that which follows the equation better."""
        return min((rotation.added(gauge, 2 * np.pi * hertz * each).scales[0] for each in lost), key=error)

    def error(found: Scale) -> float:
        return found.error / found.value if found.is_known else 1.0

    before = min(error(rotation.scales[0]), CERTAIN)
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
    is_seen = added > LEAST_LOST * float(np.nanmax(np.abs(gauge.reading)))
    if not (is_seen and error(found) < min(FOLLOWS, before / BETTER) and as_expected(found.value)):
        return None
    return serious(
        "AC coupling",
        f"{_cut_off(gauge, hertz)}: with that undone its record follows the equation of motion "
        f"{before / error(found):.2g} times as closely. What it gives as leaning, or as another zero, is that; peaks "
        "are wrong by up to as much. Record its direct (DC) output",
    )


def stuck(rotation: Rotation) -> Iterator[Finding]:
    """
    Name transducers that stand still during an arc, or jump.

    Notes
    -----
    An arc whose angle bends by κ deviates over a window of length T by κT²/√720 at least, at its peak.

    Where most of the others come to rest beyond the critical angle, the specimen fell, and what jumps with it did not
    tear: drums of a column fall faster than a block turns.
    """
    interval = rotation.interval
    fell = [_lies(each.angle(), rotation.block) for each in rotation.gauges]
    for gauge, scale, has_fallen in zip(rotation.gauges, rotation.scales, fell, strict=True):
        of_angle = scale.value if scale.is_known else 1.0
        of_table = scale.base / scale.value if scale.is_known and scale.base_is_known else 1.0
        felt = None if rotation.acceleration is None else of_table * rotation.acceleration
        angle, noise = filled_in(gauge.angle(of_angle)), gauge.noise / abs(gauge.lever * of_angle)
        said = np.zeros(angle.size, dtype=bool) if gauge.flagged is None else gauge.flagged
        flat = _flat(interval, angle, noise, felt, rotation.block)
        where = [place for place in flat if np.isfinite(gauge.reading[place]).any() and not said[place].any()]
        if where:
            longest = max(where, key=lambda place: place.stop - place.start)
            level = gauge.written(float(np.nanmedian(gauge.reading[longest])))
            text = (
                f"channel {gauge.name} stands still {f'{len(where)} times' if len(where) > 1 else 'once'}, at {level} "
                f"for {interval * (longest.stop - longest.start):.2g} s, though the equation of motion turns the "
                "specimen on: its transducer or recorder saturates, or its core sticks. The peak is a lower bound, and "
                "the specimen may have overturned. Give the channel's `range`; repeat the test with a larger one"
            )
            yield serious("end of the range", text)
        elif sum(fell) - has_fallen <= (len(fell) - 1) / 2 and (torn := _torn(rotation, angle, noise)):
            sample, size = torn
            text = (
                f"channel {gauge.name} jumps by {gauge.written(size * abs(gauge.lever))} {interval * sample:.4g} s "
                "after the start, faster than the specimen can turn, and stands still from then on: its cable tore, or "
                "its core came off. The peak is a lower bound, and the specimen may have overturned"
            )
            yield serious("dead channel", text)


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


def _torn(rotation: Rotation, angle: Array, noise: float) -> tuple[int, float] | None:
    """Sample of a jump that no block makes, after which nothing moves, and its size, rad; None without one."""
    block, interval = rotation.block, rotation.interval
    standing = np.abs(angle) < BEYOND * block.critical_angle
    fast = np.flatnonzero((np.abs(np.gradient(angle, interval)) > FASTEST * block.p * block.critical_angle) & standing)
    window = max(round(WINDOW / block.p / interval), 3)
    if not fast.size or angle.size < fast[-1] + 2 * window:
        return None
    after = angle[fast[-1] + window :]
    if float(after.std()) > STANDING * noise:
        return None
    return int(fast[-1]), abs(float(angle[max(fast[0] - 1, 0)] - after.mean()))
