"""Whether transducers on a rocking specimen agree with each other, with the table and with the equation of motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.factors import UNKNOWN, as_expected, cause
from colonnade.identification.plausibility.scale import Scale, scale_of
from colonnade.signals.stretches import filled_in

SMALL = 0.05
"""rad; slope of a transducer's reading over the angle is taken between ± this."""

STANDING = 8.0
"""Times the noise below which a transducer does not move."""

DEAD = 0.1
"""Share of what the others give below which a transducer is dead."""

STEPS = 5
"""Towards the rotation that two transducers share."""

BETTER = 4.0
"""Times less that has to be left unexplained with two transducers exchanged."""

PLAIN_UNITS = {1.0: "m", 1e-2: "cm", 1e-3: "mm", 1e-6: "µm", 0.0254: "inches"}
"""Units by the gain that a channel has which is given none."""

FOLLOWS = 0.9
"""Correlation with which one transducer turns with another."""


@dataclass(frozen=True)
class Rotation:
    """
    Transducers that see the rotation.

    Attributes
    ----------
    names : tuple of str
        Of their channels, m.
    readings, responses : ndarray, shapes (m, n) and (m, k)
        Relative to the table, and as they have to be at `angles`; m or rad.
    angles : ndarray, shape (k,)
        θ, rad, increasing through 0.
    noise : ndarray, shape (m,)
        Standard deviation.
    gains : ndarray, shape (m,)
        Physical over recorded value.
    """

    names: tuple[str, ...]
    readings: Array
    responses: Array
    angles: Array
    noise: Array
    gains: Array

    @property
    def levers(self) -> Array:
        """Reading over angle about rest, shape (m,)."""
        return np.array([self.lever(self.angles, response) for response in self.responses])

    @staticmethod
    def lever(angles: Array, response: Array) -> float:
        """Give the slope about rest of what a transducer reads (m or rad) over the angle (rad)."""
        low, high = np.interp((-SMALL, SMALL), angles, response)
        return float(high - low) / (2 * SMALL)

    def only(self, chosen: Sequence[int]) -> Rotation:
        """Some of them."""
        picked = list(chosen)
        return replace(
            self,
            names=tuple(self.names[index] for index in picked),
            readings=self.readings[picked],
            responses=self.responses[picked],
            noise=self.noise[picked],
            gains=self.gains[picked],
        )

    def exchanged(self, first: int, second: int, *, with_gains: bool) -> Rotation:
        """The same with the readings of two exchanged: as recorded, or with the gains that made them."""
        order = list(range(len(self.names)))
        order[first], order[second] = second, first
        factors = np.ones(len(order)) if with_gains else self.gains / self.gains[order]
        return replace(
            self, readings=factors[:, None] * self.readings[order], noise=np.abs(factors) * self.noise[order]
        )


def suspicions(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> list[Finding]:
    """
    Say which transducers cannot be right, with the probable cause.

    Parameters
    ----------
    interval : float
        Of the record, s.
    rotation : Rotation
    acceleration : ndarray, shape (n,), or None
        Of the table along x, m/s².
    block : Block

    Returns
    -------
    suspicions : list of Finding
        Empty if all agree, or if the specimen does not rock enough to show it.

    Notes
    -----
    Each transducer's scale is found separately, see `scale_of`, so that a wrong one can be named.
    """
    scales = _scales(interval, rotation, acceleration, block)
    known = [index for index, scale in enumerate(scales) if scale.is_known]
    if not known:
        return []
    right = [index for index in known if as_expected(scales[index].value)]
    swapped = _swapped(interval, rotation, acceleration, block)
    if swapped:
        return [swapped]
    return [
        *_gains(rotation, scales, known, right),
        *_dead(rotation, scales, right),
        *_signs(rotation, scales, known),
    ]


def base_scale(interval: float, rotation: Rotation, acceleration: Array, block: Block) -> float | None:
    """
    How many times too large the table's acceleration is, by what it does to the specimen; None if unknown.

    See `suspicions` for the arguments. Negative where its sign, or that of all transducers, is wrong.
    """
    found = [
        scale.value / scale.base
        for scale in _scales(interval, rotation, acceleration, block)
        if scale.is_known and scale.base_is_known and as_expected(scale.value)
    ]
    if not found:
        return None
    # Transducers that turn against each other do not show the sign; see `suspicions`.
    return float(np.median(np.abs(found))) * (-1.0 if max(found) < 0 else 1.0)


def _scales(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> list[Scale]:
    angles = rotation.readings / rotation.levers[:, None]
    noises = rotation.noise / np.abs(rotation.levers)
    return [scale_of(interval, angle, noise, acceleration, block) for angle, noise in zip(angles, noises, strict=True)]


def _swapped(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Finding | None:
    """Say of two transducers that with their readings exchanged they agree on one rotation, and far better."""
    for first, second in combinations(range(len(rotation.names)), 2):
        before = _residual(rotation, (first, second))
        for with_gains, what in ((False, "columns"), (True, "places")):
            exchanged = rotation.exchanged(first, second, with_gains=with_gains)
            after = _residual(exchanged, (first, second))
            if not before > BETTER * after:
                continue
            again = _scales(interval, exchanged, acceleration, block)
            if all(again[index].is_known and as_expected(again[index].value) for index in (first, second)):
                return serious(
                    "swapped channels",
                    f"channels {rotation.names[first]} and {rotation.names[second]} look swapped: with their {what} "
                    f"exchanged, their residual about one rotation falls from {1e3 * before:.2g} to "
                    f"{1e3 * after:.2g} mm",
                )
    return None


def _residual(rotation: Rotation, used: tuple[int, ...]) -> float:
    """RMS of readings less those of one common rotation."""
    some = rotation.only(used)
    levers, angle = some.levers, np.zeros(some.readings.shape[1])
    # The responses are nearly straight, so that steps along their levers settle at once.
    for _ in range(STEPS):
        misfit = some.readings - np.array([np.interp(angle, some.angles, response) for response in some.responses])
        angle = angle + levers @ misfit / float(levers @ levers)
    return float(np.sqrt(np.nanmean(misfit**2)))


def _gains(rotation: Rotation, scales: Sequence[Scale], known: list[int], right: list[int]) -> list[Finding]:
    wrong = [index for index in known if index not in right]
    common = float(np.median([scales[index].value for index in wrong])) if wrong else 1.0
    alike = [index for index in wrong if as_expected(scales[index].value / common)]
    if not right and len(alike) == len(rotation.names) > 1:
        return [
            serious(
                "gain",
                f"channels {' and '.join(rotation.names)} all show {common:.3g} times the rotation that the equation "
                f"of motion gives for this specimen: {cause(common, 'displacement')}, in all of them; or the "
                "specimen's dimensions, or the sampling rate",
                follows=("unit", "specimen"),
            )
        ]
    others = f", and that {', '.join(rotation.names[index] for index in right)} shows" if right else ""
    return [
        serious(
            "gain",
            f"channel {rotation.names[index]} shows {scales[index].value:.3g} times the rotation that the equation of "
            f"motion gives{others}: {_why(scales[index].value, float(rotation.gains[index]))}",
            follows=("unit",),
        )
        for index in wrong
    ]


def _why(scale: float, gain: float) -> str:
    """Probable cause of a scale; an odd one of a channel that is given no gain is that of a transducer in volts."""
    known = cause(scale, "displacement")
    if known == UNKNOWN and gain in PLAIN_UNITS:
        return f"its values are probably not {PLAIN_UNITS[gain]} but volts, and its `gain` is missing"
    return known


def _dead(rotation: Rotation, scales: Sequence[Scale], right: list[int]) -> list[Finding]:
    """Name transducers that stand still while others turn."""
    if not right:
        return []
    levers = rotation.levers
    angle = np.median([filled_in(rotation.readings[index]) / levers[index] for index in right], axis=0)
    others = ", ".join(rotation.names[index] for index in right)
    found = []
    for index, name in enumerate(rotation.names):
        expected = float(np.std(levers[index] * angle))
        shown = float(np.nanstd(rotation.readings[index]))
        if (
            not scales[index].is_known
            and expected > STANDING * max(rotation.noise[index], 1e-12)
            and shown < 0.1 * expected
        ):
            found.append(
                serious(
                    "dead channel",
                    f"channel {name} hardly moves ({1e3 * shown:.2g} mm RMS), although the rotation measured by "
                    f"{others} would give {1e3 * expected:.2g} mm: it is dead, or its gain is far too small. Check "
                    "cable and sensor",
                )
            )
    return found


def _signs(rotation: Rotation, scales: Sequence[Scale], known: list[int]) -> list[Finding]:
    """Name transducers that turn against the others, or all of them if they turn against the table."""
    sides = _sides(rotation, known)
    against = {index: scales[index].base < 0 for index in sides if scales[index].base_is_known}
    if len(set(sides.values())) > 1:
        return [_against_each_other(rotation, sides, against)]
    if not against or not all(against.values()):
        return []
    names = " and ".join(rotation.names[index] for index in sides)
    channels, which = (
        (f"channels {names} turn", "all of them") if len(sides) > 1 else (f"channel {names} turns", "this channel")
    )
    return [
        serious(
            "sign",
            f"{channels} opposite to the table's acceleration: the sign of the table's acceleration is wrong, or that "
            f"of {which} (`direction`, or the sign of the gain)",
        )
    ]


def _sides(rotation: Rotation, known: list[int]) -> dict[int, float]:
    """Sign with which each transducer that follows the first one turns with it."""
    angles = rotation.readings / rotation.levers[:, None]
    leader = known[0]
    sides = {leader: 1.0}
    for index in known[1:]:
        both = np.isfinite(angles[leader]) & np.isfinite(angles[index])
        agreement = float(np.corrcoef(angles[leader][both], angles[index][both])[0, 1])
        if abs(agreement) > FOLLOWS:
            sides[index] = float(np.sign(agreement))
    return sides


def _against_each_other(rotation: Rotation, sides: dict[int, float], against: dict[int, bool]) -> Finding:
    """Name the wrong ones of two groups: those that turn against the table if that is known, else the fewer."""
    groups = [[index for index in sides if sides[index] == side] for side in (1.0, -1.0)]
    fewer, more = sorted(groups, key=len)
    sure = len(fewer) < len(more)
    if against:
        fewer = [index for index in sides if against.get(index)] or fewer
        more, sure = [index for index in sides if index not in fewer], True
    names, others = (", ".join(rotation.names[index] for index in group) for group in (fewer, more))
    which = f"the sign of {names} is wrong" if sure else f"the sign of one of the two is wrong, {names} or {others}"
    return serious(
        "sign", f"channel {names} turns opposite to {others}: {which} (`direction`, or the sign of the gain)"
    )
