"""Features of a measured angle: its noise, the outcome, the impacts and the peak."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, amplitude
from colonnade.identification.response.outcome import Verdict, judge
from colonnade.identification.restitution.arcs.arcs import find_impacts
from colonnade.signals.rest import drift

NOISE_FACTOR = 6.0
"""Standard errors of the angle below which a rotation may be noise, over records of some 10⁴ samples."""

DRIFT_FACTOR = 1.5
"""A specimen that stands has no angle: what differs between the rests before and after is the transducers' drift."""

LARGEST_DRIFT = 0.02
"""Fraction of α; a specimen that is further off at an end of its record is held tilted, or has overturned."""


@dataclass(frozen=True)
class AngleFeatures:
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
    Sum up a measured angle.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, rad; NaN where missing.
    error : float
        Standard error of the angle, rad.
    block : Block
    rest_duration : float
        Of the rests before and after, s.
    catch : float or None
        Angle of the safety frame, rad.

    Returns
    -------
    features : AngleFeatures
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
