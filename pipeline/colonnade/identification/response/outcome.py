"""The outcome of a test from its measured angle: no rocking, rocking or overturned."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import Outcome, amplitude
from colonnade.signals.stretches import stretches

HELD = 0.5
"""Shortest time, s, for which a specimen caught by its frame rests in it."""

PLATEAU = 0.05
"""Half-width of a plateau as a fraction of its angle: a frame is soft, and a transducer near its range not linear."""


@dataclass(frozen=True)
class Verdict:
    """Outcome, and the time (s) at which the specimen passed its critical angle for good; NaN where it stands."""

    outcome: Outcome
    overturning_time: float


def judge(time: Array, angle: Array, block: Block, *, threshold: float, catch: float | None = None) -> Verdict:
    """
    Judge the outcome of a test.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, at equal steps; rad, about rest. Samples that are not finite are passed over.
    block : Block
    threshold : float
        rad; an angle that stays at or below it is not rocking.
    catch : float, optional
        rad; the angle at which a safety frame catches the specimen.

    Returns
    -------
    verdict : Verdict
        Overturned where the specimen, from the record's end on, passes α on a table at rest, or is beyond and not on
        its way back; or where the catch angle (without one, any angle beyond α) was reached and held for `HELD`, even
        if the specimen was righted later.
    """
    finite = np.isfinite(angle)
    time, angle = time[finite], angle[finite]
    ratio = amplitude(angle, block)
    if not angle.size or np.abs(angle).max() <= threshold:
        return Verdict("no-rocking", np.nan)
    caught = _held(time, angle, block, catch)
    if caught is not None:
        return Verdict("overturned", _passing(time, ratio, caught))
    tail = time >= time[-1] - 0.02
    slope = np.polyfit(time[tail], np.abs(angle[tail]), 1)[0] if tail.sum() > 1 else 0.0
    # On a base at rest (linear model) |θ| − α + ω/p keeps its sign: outwards of the unstable equilibrium it falls.
    beyond = float(np.mean(np.abs(angle[tail]) - block.critical_angle_at(angle[tail])))
    if beyond + slope / block.p > 0:
        return Verdict("overturned", _passing(time, ratio, time.size - 1))
    return Verdict("rocking", np.nan)


def _held(time: Array, angle: Array, block: Block, catch: float | None) -> int | None:
    """Index at which the first plateau on the frame begins; None without one."""
    magnitude = np.abs(angle)
    lowest = (1 - PLATEAU) * catch if catch is not None else block.critical_angle
    on_frame = magnitude >= lowest
    for start, stop in zip(*stretches(on_frame), strict=True):
        settled = _settled(time[start:stop], magnitude[start:stop])
        if settled is not None:
            return int(start) + settled
    return None


def _settled(time: Array, magnitude: Array) -> int | None:
    """First index from which the angle stays within the plateau's width for `HELD`, None if it never does."""
    last = np.searchsorted(time, time + HELD)
    for index in range(0, time.size, max(time.size // 400, 1)):
        if last[index] >= time.size:
            return None
        window = magnitude[index : last[index] + 1]
        if np.ptp(window) <= 2 * PLATEAU * window.mean():
            return index
    return None


def _passing(time: Array, ratio: Array, index: int) -> float:
    """Time of the last outward pass of α before a sample; that sample's own where α was never passed before it."""
    below = np.flatnonzero(ratio[: index + 1] <= 1)
    if below.size == 0:
        return float(time[0])
    last = int(below[-1])
    if last >= index:
        return float(time[index])
    share = (1 - ratio[last]) / (ratio[last + 1] - ratio[last])
    return float(time[last] + share * (time[last + 1] - time[last]))
