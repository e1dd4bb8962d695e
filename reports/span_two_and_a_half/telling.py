"""What one more measurement would tell: simulated for members in which Span 2.5 misbehaves."""

from __future__ import annotations

from dataclasses import replace
from math import log2, sqrt
from typing import Any, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from span_two_and_a_half.criterion import Criterion, misfit, place_of_growth
from span_two_and_a_half.design import CAUSES, SEED, SPANS, STRANGE, Cell, nominal, table_motion
from span_two_and_a_half.trial import Wrong, draw, generator, predict, predicted_block, recorded, response, table, truth

REPEATABILITY = (0.001, 0.01)
"""Relative standard deviations of the table's motion from one repeat to the next."""

MEMBERS = 12
"""Of each cell, at most."""

REFITTED = (0.003, 0.01)
"""Of e: how far it may be moved to make the prediction fit."""

IMPACTS, EACH_IMPACT, SPEEDS = 50, 0.003, 0.2
"""Impacts of a test that a gyroscope sees; standard deviation of e of each; that of their speeds, over p α."""

DURATION = 7.0
"""s of a test."""


class Direct(NamedTuple):
    """
    What shows a cause directly.

    Attributes
    ----------
    instrument, what : str
    deviation : float
        Standard deviation of what it gives, in the unit of the cause's sizes. 0 shows any size.
    """

    instrument: str
    what: str
    deviation: float


_TABLE = "displacement of the table"
_GYROSCOPE = "gyroscope on the prism"

DIRECT: dict[str, list[Direct]] = {
    "e": [
        Direct("free vibrations again", "e to ± 0.001", 0.001),
        Direct(_GYROSCOPE, f"e of {IMPACTS} impacts, each to ± {EACH_IMPACT:g}", EACH_IMPACT / sqrt(IMPACTS)),
    ],
    "critical angle": [Direct("tilting until it lifts", "α to ± 0.1 %", 0.001)],
    "p": [Direct("weight and dimensions", "p to ± 0.05 %", 0.0005)],
    "gain": [Direct(_TABLE, "to ± 0.2 %", 0.002)],
    "offset": [Direct(_TABLE, "± 1 mm at the end", 1e3 * 2.0 * 0.001 / DURATION**2 / STANDARD_GRAVITY)],
    "drift": [Direct(_TABLE, "± 1 mm at the end", 1e3 * 6.0 * 0.001 / DURATION**2 / STANDARD_GRAVITY)],
    "noise": [Direct("a second accelerometer", "RMS to ± 0.5 mg", 0.5)],
    "filter": [Direct("the record before its filter", "any filter", 0.0)],
    "clock": [Direct("a pulse on both recorders at both ends", "± 1 ms", 0.001 / DURATION)],
    "tilt": [Direct("level on the table", "± 0.1 mrad", 0.0001)],
    "speed": [Direct(_GYROSCOPE, "slope of e", EACH_IMPACT / sqrt(IMPACTS) / SPEEDS)],
    "scatter": [Direct(_GYROSCOPE, "scatter of e", EACH_IMPACT * (2.0 / IMPACTS) ** 0.25)],
}
"""By cause: instruments that show it, and how well. Assumed, as the laboratory's own are not known."""

DECIDES = 3.0
"""ln of the likelihood ratio (20 to 1) that decides, expected from a direct measurement: ½ (size / deviation)²."""


def decided_from(direct: Direct) -> float:
    """Give the size from which a direct measurement is expected to decide."""
    return direct.deviation * sqrt(2.0 * DECIDES)


def resolved(instrument: str, grade: int = 1) -> list[str]:
    """Name the causes that an instrument decides at a size, the usual one by default."""
    found = []
    for cause, each in DIRECT.items():
        size = CAUSES[cause].sizes[grade]
        if any(direct.instrument == instrument and size >= decided_from(direct) for direct in each):
            found.append(cause)
    return found


def instrument_information(instrument: str) -> float:
    """
    Give what an instrument tells between all causes of `DIRECT`, bits, if one of them is at work at its usual size.

    All are as likely. What it decides it tells apart from all others; the others it leaves as they are.
    """
    count, left = len(DIRECT), len(DIRECT) - len(resolved(instrument))
    return log2(count) - (left * log2(left) / count if left else 0.0)


def tell(cell: Cell, number: int, intensity: float) -> dict[str, Any]:
    """
    Simulate further measurements for a member whose nonlinear prediction shows the pattern at Span 2.5.

    Returns
    -------
    told : dict
        For each repeatability of the table: whether the measured response `repeats` (misfit below 0.1) and whether the
        pattern comes `again` with the prediction on the repeat's own record. For each range of e: whether some e within
        it makes the prediction fit at Span 2.5 (`refitted`).
    """
    wrong, which = draw(cell, number), SPANS.index(STRANGE)
    motion = table(table_motion(), intensity, STRANGE)
    random = generator(cell, number, SEED, which)
    measured = response(truth(wrong, motion, random), motion.dt)
    seen = recorded(wrong, motion, which, random)
    told: dict[str, Any] = {}
    for place, deviation in enumerate(REPEATABILITY):
        fresh = generator(cell, number, SEED, which, 1 + place)
        again = _repeated(wrong, fresh)
        moved = Motion(motion.acceleration * (1.0 + deviation * fresh.standard_normal()), motion.dt)
        second = response(truth(again, moved, fresh), motion.dt)
        runs = predict(recorded(again, moved, which, fresh), tangent=again.tangent)
        told[f"repeats {deviation:g}"] = misfit(measured, second) < Criterion().nrmse
        told[f"again {deviation:g}"] = bool(
            np.isfinite(place_of_growth(second, response(runs["nonlinear"], motion.dt), Criterion()))
        )
    block, e = predicted_block(wrong.tangent), nominal()[1]
    for reach in REFITTED:
        tried = e + np.linspace(-reach, reach, 21)
        told[f"refitted {reach:g}"] = any(
            misfit(measured, response(rock(block, seen, restitution=each, model="nonlinear"), motion.dt))
            < Criterion().nrmse
            for each in tried.tolist()
        )
    return told


def _repeated(wrong: Wrong, random: np.random.Generator) -> Wrong:
    """Draw again what is another one in each test: the zero of the accelerometer and its drift."""
    signs = random.choice([-1.0, 1.0], 2)
    return replace(
        wrong,
        offset=tuple(signs[0] * each for each in wrong.offset),
        drift=tuple(signs[1] * each for each in wrong.drift),
    )


def summarised(found: list[dict[str, Any]]) -> dict[str, Any]:
    """Count."""
    if not found:
        return {"members": 0}
    return {"members": len(found), **{name: sum(bool(each[name]) for each in found) for name in found[0]}}


def information(shares: Array) -> float:
    """
    Give the information that an outcome has on which of several causes is at work, bits, if all are as likely.

    Parameters
    ----------
    shares : ndarray, shape (causes, outcomes)
        Probabilities of the outcomes under each cause.

    Examples
    --------
    >>> information(np.array([[1.0, 0.0], [0.0, 1.0]]))
    1.0
    """
    mean = shares.mean(axis=0)

    def entropy(p: Array) -> float:
        return float(-np.sum(np.where(p > 0.0, p * np.log2(np.where(p > 0.0, p, 1.0)), 0.0)))

    return entropy(mean) - float(np.mean([entropy(each) for each in shares]))
