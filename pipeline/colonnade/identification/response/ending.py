"""How a record ends: at rest where it began, at rest elsewhere, or in motion."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import amplitude
from colonnade.findings import Finding, serious, warning
from colonnade.identification.response.outcome import Verdict
from colonnade.identification.restitution.arcs.arcs import find_impacts
from colonnade.signals.filters import lowpass
from colonnade.signals.rest import find_rest

RETURNING, FURTHEST = 1.6, 2.0
"""|θ|/α from which no block comes back; rad, beyond which it lies."""

UPRIGHT = 0.02
"""|θ|/α below which a specimen at rest stands: drifts and dust are in it."""

LASTING = 0.05
"""|θ|/α above which it matters that a record ends in motion."""

SHAKEN = 0.1
"""Of its peak acceleration, above which the table has not come to rest."""

ROCKS_AT_MOST = 10.0
"""Over p: angular frequency up to which a table rocks a block; above it a base derived from displacement is noise."""

CYCLES = 3.0
"""Over p: length of the end of a record on which small rocking shows its middle."""

SMALL = 0.3
"""|θ|/α of rocking whose period is shorter than that."""

FEWEST_PASSES = 3
"""Times that a specimen passes the angle at which it comes to rest, if that is its true zero."""


def ending(
    time: Array, angle: Array, base: Array | None, verdict: Verdict, block: Block, *,
    error: float, duration: float, lever: float | None,
) -> Finding | None:  # fmt: skip
    """
    Say what the end of a record means, if the specimen does not stand where it began.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s; rad; NaN where missing.
    base : ndarray, shape (n,), or None
        Acceleration of the table, m/s²; None if it stands still.
    verdict : Verdict
    block : Block
    error : float
        Standard error of the angle, rad.
    duration : float
        Of a rest, s.
    lever : float or None
        Height of the transducer that alone gives the angle, m; None if several separate it from a slide.
    """
    highest = float(amplitude(angle[np.isfinite(angle)], block).max(initial=0.0))
    if highest * block.critical_angle > FURTHEST or (highest > RETURNING and verdict.outcome == "rocking"):
        return serious(
            "impossible angle",
            f"The angle reaches {highest:.2g} α, as no block that comes back does: degrees read as radians, a wrong "
            "gain, or a code for overload or missing values such as -9999, which has to be empty in the file.",
            follows=("gain", "unit", "end of the range", "dead channel"),
        )
    if verdict.outcome == "overturned":
        return None
    rest = find_rest(time, {"": (angle, error)}, end=True, duration=max(duration, CYCLES / block.p))
    tail = angle[(time >= rest.start) & np.isfinite(angle)]
    if not tail.size:
        return None
    shaken = base is not None and _share_at_end(time, base, block, rest.start) > SHAKEN
    lasting = float(amplitude(tail, block).max())
    if not rest.quiet and (shaken or lasting > SMALL):
        # On a table at rest the motion only dies.
        return _in_motion(lasting, float(time[-1]), verdict) if shaken and lasting > LASTING else None
    level = float(tail.max() + tail.min()) / 2
    share = float(amplitude(np.array([level]), block)[0])
    if share < UPRIGHT or (not rest.quiet and tail.min() < 0.0 < tail.max()):
        return None
    before = time < rest.start
    passes = find_impacts(time[before], angle[before] - level, lowest=max(10 * error, 0.1 * abs(level))).size
    if passes >= FEWEST_PASSES:
        return _elsewhere(level, share, lever)
    if not rest.quiet:
        return None
    cause = (
        "a transducer that saturates or sticks there, or a safety frame (the set-up's `catch`)"
        if share > 0.8 * highest
        else "a transducer that tore off or lost its signal"
    )
    return serious(
        "rest",
        f"At its end the specimen is at rest at {share:.2g} α, where no block stands by itself: {cause}; or a zero "
        "taken while it leaned (`zero`). It may have overturned; the peak and the outcome are not to be used.",
        follows=("end of the range", "dead channel", "AC coupling"),
    )


def _share_at_end(time: Array, base: Array, block: Block, start: float) -> float:
    """Largest acceleration that can rock the block from `start` on, over the largest of the record."""
    interval = float(np.median(np.diff(time)))
    cutoff = min(ROCKS_AT_MOST * block.p / (2 * np.pi), 0.4 / interval)
    felt = np.abs(lowpass(np.nan_to_num(base), interval, cutoff))
    return float(felt[time >= start].max() / felt.max(initial=np.finfo(float).tiny))


def _elsewhere(level: float, share: float, lever: float | None) -> Finding:
    """It rocked about another zero than the one that was taken off."""
    walked = "" if lever is None else f", or the block walked by {abs(1e3 * level * lever):.2g} mm under its transducer"
    build = serious if share > LASTING else warning
    return build(
        "zero",
        f"The specimen rocks about, and comes to rest at, {share:.2g} α: its zero was taken while it leaned or was "
        f"held (`zero`){walked}. Angles and peaks of either side are wrong by up to as much.",
        follows=("end of the range", "dead channel", "AC coupling"),
    )


def _in_motion(lasting: float, end: float, verdict: Verdict) -> Finding:
    return warning(
        "record ends in motion",
        f"The record ends at {end:.4g} s while the table shakes and the specimen moves by {lasting:.2g} α. What it did "
        f'next is not known: the outcome "{verdict.outcome}" is that on a table at rest from then on, and a later peak '
        "is missed. Record until it rests.",
    )
