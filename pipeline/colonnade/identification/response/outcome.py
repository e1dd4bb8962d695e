"""What a measured angle shows: the outcome of a test, its impacts and peak, and how the record ends."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, Outcome, amplitude
from colonnade.findings import Finding, serious, warning
from colonnade.identification.response.base_motion import table_moves
from colonnade.identification.restitution.arcs import find_impacts
from colonnade.signals.rest import drift, find_rest

HELD = 0.5
"""Shortest time, s, for which a specimen caught by its frame rests in it."""

PLATEAU = 0.05
"""Half-width of a plateau as a fraction of its angle: a frame is soft, and a transducer near its range not linear."""

NOISE_FACTOR = 6.0
"""Standard errors of the angle below which a rotation may be noise, over records of some 10⁴ samples."""

DRIFT_FACTOR = 1.5
"""A specimen that stands has no angle: what differs between the rests before and after is the transducers' drift."""

LARGEST_DRIFT = 0.02
"""Fraction of α; a specimen that is further off at an end of its record is held tilted, or has overturned."""

RETURNING, FURTHEST = 1.6, 2.0
"""|θ|/α from which no block comes back; rad, beyond which it lies."""

UPRIGHT = 0.02
"""|θ|/α below which a specimen at rest stands: drifts and dust are in it."""

LASTING = 0.05
"""|θ|/α above which it matters that a record ends in motion."""

CYCLES = 3.0
"""Over p: length of the end of a record on which small rocking shows its middle."""

SMALL = 0.3
"""|θ|/α of rocking whose period is shorter than that."""

LOST = ("end of the range", "dead channel")
"""Kinds of findings of a transducer that lost the specimen."""


class Verdict(NamedTuple):
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
    if not angle.size or np.abs(angle).max() <= threshold:
        return Verdict("no-rocking", np.nan)
    fell = _held(time, np.abs(angle), block.critical_angle if catch is None else (1 - PLATEAU) * catch)
    if fell is None:
        tail = time >= time[-1] - 0.02
        slope = np.polyfit(time[tail], np.abs(angle[tail]), 1)[0] if tail.sum() > 1 else 0.0
        # On a base at rest (linear model) |θ| − α + ω/p keeps its sign: outwards of the unstable equilibrium it falls.
        beyond = float(np.mean(np.abs(angle[tail]) - block.critical_angle_at(angle[tail])))
        if not beyond + slope / block.p > 0:
            return Verdict("rocking", np.nan)
        fell = time.size - 1
    # It passed α for good after the last sample below it.
    ratio = amplitude(angle[: fell + 1], block)
    last = int(np.flatnonzero(ratio <= 1).max(initial=-1))
    if not 0 <= last < fell:
        return Verdict("overturned", float(time[max(last, 0)]))
    return Verdict("overturned", float(np.interp(1.0, ratio[last : last + 2], time[last : last + 2])))


def _held(time: Array, magnitude: Array, least: float) -> int | None:
    """First index from which a specimen on its frame stays within a plateau's width for `HELD`; None without one."""
    half = round(HELD * (time.size - 1) / max(2 * float(time[-1] - time[0]), 1e-12))
    if 2 * half >= time.size:
        return None
    low, high = (
        each(magnitude, 2 * half + 1)[half : time.size - half]
        for each in (scipy.ndimage.minimum_filter1d, scipy.ndimage.maximum_filter1d)
    )
    held = np.flatnonzero((low >= least) & (high - low <= PLATEAU * (high + low)))
    return int(held[0]) if held.size else None


class AngleFeatures(NamedTuple):
    """
    A rocking angle in a few numbers.

    Attributes
    ----------
    verdict : Verdict
    threshold : float
        Noise threshold of the rotation, rad.
    standard_error : float
        Of the angle, with the drift between the rests, rad.
    drift : float
        Between the rests, rad; 0 if it is not known.
    impact_times : ndarray
        s, up to overturning.
    peak_time, peak_angle, peak_ratio : float
        s, rad and |θ|/α; the ratio is NaN of a specimen that overturned.
    """

    verdict: Verdict
    threshold: float
    standard_error: float
    drift: float
    impact_times: Array
    peak_time: float
    peak_angle: float
    peak_ratio: float


def angle_features(
    time: Array, angle: Array, error: float, block: Block, *, rest_duration: float, catch: float | None
) -> AngleFeatures:
    """
    Sum up a measured angle (n,), rad, with its standard error.

    `rest_duration` is that of the rests before and after, s; `catch` the angle of the safety frame, rad.
    """
    drifted = drift(time, angle, duration=rest_duration, noise=error)
    if drifted > LARGEST_DRIFT * block.critical_angle:
        drifted = 0.0
    threshold = max(NOISE_FACTOR * error + DRIFT_FACTOR * drifted, NO_ROCKING_RATIO * block.critical_angle)
    verdict = judge(time, angle, block, threshold=threshold, catch=catch)
    standing = time <= verdict.overturning_time if np.isfinite(verdict.overturning_time) else np.isfinite(time)
    ratio = np.where(standing & np.isfinite(angle), amplitude(angle, block), -1.0)
    peak = int(np.argmax(ratio))
    return AngleFeatures(
        verdict,
        threshold,
        float(np.hypot(error, drifted / np.sqrt(3))),
        drifted,
        find_impacts(time[standing], angle[standing], lowest=threshold),
        float(time[peak]),
        float(angle[peak]),
        np.nan if verdict.outcome == "overturned" else float(ratio[peak]),
    )


def ending(
    time: Array, angle: Array, base: Array | None, verdict: Verdict, block: Block, *, error: float, duration: float
) -> Finding | None:
    """
    Say what the end of a record means, if the specimen does not stand where it began.

    `angle` (n,), rad, has the standard `error`; `base` is the acceleration of the table, m/s², None if it stands still;
    `duration` is that of a rest, s.
    """
    highest = float(amplitude(angle[np.isfinite(angle)], block).max(initial=0.0))
    if highest * block.critical_angle > FURTHEST or (highest > RETURNING and verdict.outcome == "rocking"):
        return serious(
            "impossible angle",
            f"The angle reaches {highest:.2g} α, as no block that comes back does: degrees read as radians, a wrong "
            "gain, or a code for overload or missing values such as -9999, which has to be empty in the file.",
            follows=("gain", "unit", *LOST),
        )
    if verdict.outcome == "overturned":
        return None
    rest = find_rest(time, {"": (angle, error)}, end=True, duration=max(duration, CYCLES / block.p))
    tail = angle[(time >= rest.start) & np.isfinite(angle)]
    if not tail.size:
        return None
    lasting = float(amplitude(tail, block).max())
    share = float(amplitude(np.array([tail.max() + tail.min()]) / 2, block)[0])
    interval = float(np.median(np.diff(time)))
    shaken = base is not None and not rest.quiet and table_moves(base[time >= rest.start], interval, block)
    # On a table at rest the motion only dies.
    dies = not rest.quiet and (lasting > SMALL or tail.min() < 0.0 < tail.max())
    if lasting <= LASTING if shaken else (dies or share < UPRIGHT):
        return None
    return (serious if share > LASTING and not shaken else warning)(
        "rest",
        f"At its end ({time[-1]:.4g} s) the specimen is at {share:.2g} α, where no block stands by itself, or moves by "
        f"{lasting:.2g} α while the table shakes. The record ends too early, and the outcome is that on a table at "
        "rest from then on; or its zero was taken while it leaned or was held (`zero`); or a transducer saturates, "
        "sticks or tore off, or the block walked under it; or a safety frame holds it (the set-up's `catch`). Angles "
        "and peaks are wrong by up to as much, and it may have overturned.",
        follows=LOST,
    )
