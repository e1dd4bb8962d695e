"""What one more measurement would tell: simulated for members in which Span 2.5 misbehaves."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from span_two_and_a_half.criterion import Criterion, misfit, place_of_growth
from span_two_and_a_half.design import SEED, SPANS, STRANGE, Cell, nominal, table_motion
from span_two_and_a_half.trial import Wrong, draw, generator, predict, predicted_block, recorded, response, table, truth

REPEATABILITY = (0.001, 0.01)
"""Relative standard deviations of the table's motion from one repeat to the next."""

MEMBERS = 24
"""Of each cell, at most."""

REFITTED = (0.003, 0.01)
"""Of e: how far it may be moved to make the prediction fit."""

RESOLUTIONS: dict[str, tuple[str, float]] = {
    "e": ("e by free vibrations, to ± 0.001", 0.001),
    "critical angle": ("α by tilting the table until the prism lifts, to ± 0.2 %", 0.002),
    "p": ("p by α and dimensions, to ± 0.2 %", 0.002),
    "gain": ("the table's displacement, to ± 0.2 %", 0.002),
    "offset": ("the table's displacement at its end, ± 1 mm after 7 s", 1e3 * 2 * 0.001 / 7.0**2 / 9.81),
    "drift": ("the table's displacement at its end, ± 1 mm after 7 s", 1e3 * 6 * 0.001 / 7.0**2 / 9.81),
    "noise": ("a second accelerometer, to ± 0.5 mg", 0.5),
    "clock": ("one pulse on both recorders at each end, to ± 1 ms in 7 s", 0.001 / 7.0),
    "tilt": ("a machinist's level, to ± 0.1 mrad", 0.0001),
    "speed": ("a gyroscope: e of each impact, its slope to ± 0.003", 0.003),
    "scatter": ("a gyroscope: e of each impact to ± 0.003", 0.003),
}
"""By cause: the measurement that shows it directly, and its standard deviation in the unit of the cause's sizes."""

DECIDES = 3.0
"""ln of the likelihood ratio (20 to 1) that decides, expected from a direct measurement: ½ (size / deviation)²."""


def decided_from(cause: str) -> float:
    """Give the size from which the direct measurement of a cause decides."""
    return float(RESOLUTIONS[cause][1] * np.sqrt(2.0 * DECIDES))


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
