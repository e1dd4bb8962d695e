"""Motion of the specimen from everything that was on it: transducers and gyroscopes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion.pose import SpecimenMotion, fit_pose
from colonnade.identification.fusion.sensors import (
    Gyroscope,
    Readings,
    Transducer,
    UnseenRotationError,
    angular_velocity,
)
from colonnade.signals.samples import stretches

QUIET = 4.5
"""A specimen stands where a rate stays below this many times its noise; the noise alone does over some 10⁵ samples."""

REST_ERROR = 1e-5
"""rad: standard error with which a standing specimen is upright."""

NEAR_UPRIGHT = 0.05
"""Fraction of α; a still specimen that is further from upright is held, or leans on its frame."""

LARGEST_BIAS = 0.1
"""rad/s: standard deviation of what is read at rest, before anything is known of it."""

LEAST_NOISE = 1e-6
"""rad/s, of a rate: no gyroscope is better."""

AGREEMENT_TIME = 0.05
"""s over which a rate is compared with the change of an angle."""

SEEN = 0.1
"""Part of a gyroscope's axis along y from which on its rate is used for the rocking angle."""

LARGEST_DISAGREEMENT = 3.0
"""Times the noise by which a rate may differ from the change of the angle before it is left out."""

Angle = tuple[Array, Array]
"""θ and its standard error, shape (n,), rad."""


@dataclass(frozen=True)
class Circumstances:
    """
    How a test went.

    Attributes
    ----------
    interval, rest_duration : float
        Between samples, and of the shortest rest, s.
    ends_at_rest : bool
        Whether it ends at rest for sure, or starts so.
    displacement : ndarray, shape (3, n)
        Of the table, m.
    """

    interval: float
    rest_duration: float
    ends_at_rest: bool
    displacement: Array


def specimen_motion(
    positions: Readings[Transducer],
    gyroscopes: Readings[Gyroscope],
    block: Block,
    outline: Outline,
    test: Circumstances,
) -> SpecimenMotion:
    """
    Fuse what the transducers on a specimen read.

    Parameters
    ----------
    positions, gyroscopes : Readings
        Displacement transducers and inclinometers; rates. Either may be empty.
    block : Block
    outline : Outline
    test : Circumstances

    Raises
    ------
    UnseenRotationError
        A ValueError, if nothing sees the rotation.

    Notes
    -----
    Positions are fitted sample by sample. Gyroscopes are integrated, their drift held by that angle or, without one, by
    the rests.
    """
    fitted, refusal = None, UnseenRotationError("No transducer on the specimen measures its rotation")
    if positions.sensors:
        try:
            fitted = fit_pose(
                positions.values, positions.sensors, block, outline, noise=positions.noise, base=test.displacement
            )
        except UnseenRotationError as error:
            refusal = error
    notes = [] if fitted is None else [fitted.separation]
    turning = np.array([abs(each.direction[1]) > SEEN for each in gyroscopes.sensors], dtype=np.bool_)
    found: Angle | None = None
    if turning.any():
        tracked = None
        if fitted is not None:
            # Its error were its noise white.
            kept = min(2 * float(positions.cutoff_hz.min()) * test.interval, 1.0)
            tracked = fitted.angle, fitted.standard_error["rocking_angle"] / np.sqrt(kept)
        found, text = _from_rates(gyroscopes.only(turning), tracked, block, test)
        notes.append(text)
    if fitted is None:
        if found is None:
            raise refusal
        still = np.zeros(test.displacement.shape[1])
        fitted = SpecimenMotion({}, {}, np.full_like(positions.values, np.nan), Pose(*[still] * 6), "")
        if positions.sensors:
            notes.append(f"the displacement transducers are not used: {refusal}")
    values, errors, pose = fitted.values, fitted.standard_error, fitted.pose
    if found is not None:
        values, errors = values | {"rocking_angle": found[0]}, errors | {"rocking_angle": found[1]}
        pose = replace(pose, angle=found[0])
    rates = gyroscopes.values - angular_velocity(gyroscopes.sensors, pose, test.interval)
    residual, separation = np.concatenate((fitted.residual, rates)), "; ".join(notes)
    entered = np.append(np.full(len(positions.sensors), bool(fitted.values)), turning & (found is not None))
    return SpecimenMotion(values, errors, residual, pose, separation, entered, found is not None)


def _from_rates(
    gyroscopes: Readings[Gyroscope], tracked: Angle | None, block: Block, test: Circumstances
) -> tuple[Angle | None, str]:
    """Angle and its error, and what was done; None if the rates contradict what tracks the angle."""
    rate, noise = mean_rate(gyroscopes.sensors, gyroscopes.values, gyroscopes.noise)
    _, white = mean_rate(gyroscopes.sensors, gyroscopes.values, gyroscopes.white(test.interval))
    count = "one gyroscope" if len(gyroscopes.sensors) == 1 else f"{len(gyroscopes.sensors)} gyroscopes"
    if tracked is not None:
        factor = disagreement(rate, white, test.interval, *tracked)
        if factor > LARGEST_DISAGREEMENT:
            text = f"{count} not used: the difference is {factor:.2g} times the noise; check gain, sign and axis"
            return None, text
        found = angle_from_rate(rate, white, test.interval, *tracked)
        return found, f"{count} combined with them, which remove its drift"
    known, rests = upright(
        rate, noise, white, test.interval, block, duration=test.rest_duration, from_end=test.ends_at_rest
    )
    where = f"drift removed at {len(rests)} rest{'s' if len(rests) > 1 else ''}"
    if not rests:
        known[-1 if test.ends_at_rest else 0] = 0.0
        where = f"no rest was found, so it is taken as upright at the {'end' if test.ends_at_rest else 'start'}"
    angle, error = angle_from_rate(rate, white, test.interval, known, np.full(rate.size, REST_ERROR))
    return (angle, error), (
        f"angle only, from {count}, integrated, {where}: its standard error grows to "
        f"{1e3 * float(error.max()):.2g} mrad; slide and uplift are not measured and are taken as zero"
    )


def smooth(rate: Array, deviation: Array, interval: float, tracked: Array, tracked_error: Array) -> tuple[Array, Array]:
    """
    Integrate a measured rate, its bias held by an angle that is known now and then.

    Parameters
    ----------
    rate, deviation : ndarray, shape (n,)
        rad/s, NaN where missing; standard deviation of the noise of each step to the next sample.
    interval : float
        s.
    tracked, tracked_error : ndarray, shape (n,)
        The angle, NaN where unknown, and its standard error, sample by sample independent. rad.

    Returns
    -------
    angle, error : ndarray, shape (n,)
        rad; its standard error.

    Notes
    -----
    What the integral lacks is a random walk and a bias times time: both by least squares over the whole record, as of a
    Kalman filter run forwards and back.
    """
    time, integral = interval * np.arange(rate.size), _integral(rate, interval)
    stiffness = (interval * np.maximum(deviation[:-1], LEAST_NOISE)) ** -2.0
    weight = np.where(np.isfinite(tracked), tracked_error**-2.0, 0.0)
    normal = np.zeros((2, rate.size))
    normal[0] = weight + np.append(np.pi**-2, stiffness) + np.append(stiffness, 0.0)
    normal[1, :-1] = -stiffness
    missing = np.nan_to_num(tracked) - integral
    walk, of_bias = scipy.linalg.solveh_banded(normal, (weight * np.array([missing, time])).T, lower=True).T
    precision = LARGEST_BIAS**-2 + float((weight * time) @ (time - of_bias))
    bias = float((weight * time) @ (missing - walk)) / precision
    # What is known of each sample by those before and after it.
    backwards = np.array([normal[0, ::-1], np.append(normal[1, -2::-1], 0.0)])
    before, after = (scipy.linalg.cholesky_banded(each, lower=True)[0] ** 2 for each in (normal, backwards))
    variance = 1 / (before + after[::-1] - normal[0]) + (time - of_bias) ** 2 / precision
    return integral + walk + bias * (time - of_bias), np.sqrt(variance)


def _integral(rate: Array, interval: float) -> Array:
    """Integral from the first sample on; missing samples count as zero."""
    return np.asarray(scipy.integrate.cumulative_trapezoid(np.nan_to_num(rate), dx=interval, initial=0.0))


def mean_rate(gyroscopes: list[Gyroscope], readings: Array, sigma: Array) -> tuple[Array, float]:
    """Angular velocity θ̇ (n,) of gyroscopes (m, n) by least squares, and its noise; rad/s."""
    along = np.array([each.direction[1] for each in gyroscopes])[:, None]
    weights = np.where(np.isfinite(readings), along / sigma[:, None] ** 2, 0.0)
    seen = (weights * along).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        rate = np.where(seen > 0, (weights * np.nan_to_num(readings)).sum(axis=0) / seen, np.nan)
    return rate, float(1 / np.sqrt((along[:, 0] ** 2 / sigma**2).sum()))


def angle_from_rate(
    rate: Array, noise: float, interval: float, tracked: Array, tracked_error: Array
) -> tuple[Array, Array]:
    """
    Angle and standard error, shape (n,), rad, of a rate θ̇ (rad/s; NaN where missing) with white noise; see `smooth`.

    A rate that disagrees with the tracked angle by more than both errors is taken to be that much noisier.
    """
    noise *= disagreement(rate, noise, interval, tracked, tracked_error)
    # Over a gap a rate is unknown as a whole, not step by step.
    missing, steps = ~np.isfinite(rate), np.zeros(rate.size)
    for start, stop in zip(*stretches(missing | np.append(missing[1:], False)), strict=True):
        steps[start:stop] = stop - start
    deviation = np.maximum(noise, float(np.nanstd(rate)) * np.sqrt(steps))
    return smooth(rate, deviation, interval, tracked, tracked_error)


def disagreement(rate: Array, noise: float, interval: float, tracked: Array, tracked_error: Array) -> float:
    """
    How far a rate is from the change of an angle, over what the noise of both allows; at least 1.

    RMS of the difference over `AGREEMENT_TIME`, about its median, as bias does not count.
    """
    count = max(round(AGREEMENT_TIME / interval), 1)
    if tracked.size <= count:
        return 1.0
    difference = tracked - _integral(rate, interval)
    change = difference[count:] - difference[:-count]
    allowed = tracked_error[count:] ** 2 + tracked_error[:-count] ** 2 + count * (noise * interval) ** 2
    known = np.isfinite(change) & np.isfinite(rate[count:]) & np.isfinite(rate[:-count])
    if known.sum() < count:
        return 1.0
    return max(1.0, float(np.sqrt(np.mean((change[known] - np.median(change[known])) ** 2 / allowed[known]))))


def upright(
    rate: Array, noise: float, white: float, interval: float, block: Block, *, duration: float, from_end: bool
) -> tuple[Array, list[tuple[int, int]]]:
    """
    Find the stretches on which a specimen stands upright, from its rate alone.

    Parameters
    ----------
    rate : ndarray, shape (n,)
        θ̇, rad/s.
    noise, white : float
        Its standard deviation as it is, and were it white, rad/s.
    interval, duration : float
        s; the shortest rest.
    from_end : bool
        The last still stretch is at rest for sure, as after a free vibration, rather than the first.

    Returns
    -------
    known : ndarray, shape (n,)
        0 where the specimen stands upright, NaN elsewhere.
    rests : list of (start, stop)
        Indices of these stretches.

    Notes
    -----
    A still stretch counts where the angle, integrated from the sure one, is upright within its standard error; one that
    is held tilted, or leans on its frame, does not.
    """
    shortest = max(round(duration / interval), 1)
    known = np.full(rate.size, np.nan)
    starts, stops = stretches(np.abs(rate) <= QUIET * noise)
    long = stops - starts >= shortest
    if not long.any():
        return known, []
    first = int(stops[long][-1]) - shortest if from_end else int(starts[long][0])
    sure = slice(first, first + shortest)
    # A slow motion hides in the noise of a sample; it does not in the mean over the shortest rest.
    averages = np.convolve(np.nan_to_num(rate - float(rate[sure].mean())), np.full(shortest, 1 / shortest), mode="same")
    still = (np.abs(rate) <= QUIET * noise) & (np.abs(averages) <= QUIET * white * np.sqrt(2 / shortest))
    known[sure] = 0.0
    angle, error = angle_from_rate(rate, white, interval, known, np.full(rate.size, REST_ERROR))
    rests = []
    for start, stop in zip(*(each.tolist() for each in stretches(still)), strict=True):
        near = NEAR_UPRIGHT * block.critical_angle + min(4 * float(error[start:stop].max()), block.critical_angle / 4)
        if stop - start >= shortest and np.abs(angle[start:stop]).max() < near:
            rests.append((start, stop))
            known[start:stop] = 0.0
    return known, rests or [(first, first + shortest)]
