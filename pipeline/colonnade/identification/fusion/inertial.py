"""Rocking angle from gyroscopes and accelerometers: integrated, with the drift held by what is known of the angle."""

from __future__ import annotations

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kernel import kernel_in_place
from colonnade.dynamics.kinematics import pole_position
from colonnade.identification.fusion.sensors import Accelerometer, Gyroscope, Readings
from colonnade.signals.samples import stretches

QUIET = 4.5
"""A specimen stands where a rate stays below this many times its noise; the noise alone does over some 10⁵ samples."""

REST_ERROR = 1e-5
"""rad, and rad/s: standard error with which a standing specimen is upright and still."""

NEAR_UPRIGHT = 0.05
"""Fraction of α; a still specimen that is further from upright is held, or leans on its frame."""

LARGEST_BIAS = 0.1
"""rad/s, rad/s²: standard deviation of what is read at rest, before anything is known of it."""

LARGEST_RATE = 10.0
"""rad/s: standard deviation of a specimen's angular velocity, before anything is known of it."""

AGREEMENT_TIME = 0.05
"""s over which a rate is compared with the change of an angle."""

LARGEST_AMPLIFICATION = 10.0
"""Rotation is taken from accelerometers where it costs this factor in the error of the mean, over the pole distance."""

PASSES = 3
"""Of the angle from accelerometers: the second has centripetal accelerations, the third the errors that it leaves."""


def smooth(
    derivative: Array, deviation: Array, interval: float, tracked: Array, tracked_error: Array, start: Array
) -> tuple[Array, Array]:
    """
    Integrate a measured derivative of an angle, its bias held by an angle that is known now and then.

    Parameters
    ----------
    derivative, deviation : ndarray, shape (n,)
        Of the order s − 1, with its bias; standard deviation of the noise of each step to the next sample.
    interval : float
        s.
    tracked, tracked_error : ndarray, shape (n,)
        The angle, NaN where unknown, and its standard error, sample by sample independent. rad.
    start : ndarray, shape (s,)
        Standard deviations of the angle, its lower derivatives and minus the bias, before anything is known.

    Returns
    -------
    states, deviations : ndarray, shape (n, s)
        Angle, lower derivatives and minus the bias; their standard deviations.

    Notes
    -----
    A Kalman filter forwards, then back by Rauch, Tung & Striebel (1965): the least-squares solution over the record.
    """
    transition = np.ascontiguousarray(scipy.linalg.expm(interval * np.eye(start.size, k=1)))
    push = transition[:, -1] - np.eye(start.size)[-1]
    middle = _middle(derivative)
    variances = np.where(np.isfinite(tracked), tracked_error**2, np.inf)
    states, ahead = np.zeros((2, middle.size, start.size))
    covariances, ahead_covariances = np.zeros((2, middle.size, start.size, start.size))
    ahead_covariances[0] = np.diag(start**2)
    given = (transition, push, middle, deviation**2, np.nan_to_num(tracked), variances)
    room = np.zeros((3, start.size, start.size))
    _smooth(*given, states, covariances, ahead, ahead_covariances, room)
    return states, np.sqrt(np.maximum(np.diagonal(covariances, axis1=1, axis2=2), 0.0))


@kernel_in_place
def _smooth(
    transition: Array,
    push: Array,
    inputs: Array,
    process: Array,
    readings: Array,
    variances: Array,
    states: Array,
    covariances: Array,
    ahead: Array,
    ahead_covariances: Array,
    room: Array,
) -> None:
    """Fill states and covariances, before (`ahead`) and after the reading, from the covariances ahead of the first."""
    count, size = states.shape
    gains, product = room[0], room[1]
    # Forwards: each state from the one before, then from the reading of its angle.
    for index in range(count):
        state, covariance, expected = states[index], covariances[index], ahead_covariances[index]
        if index > 0:
            _multiply(transition, covariances[index - 1], product)
            _multiply(product, transition.T, expected)
            for i in range(size):
                ahead[index, i] = inputs[index - 1] * push[i]
                for j in range(size):
                    ahead[index, i] += transition[i, j] * states[index - 1, j]
                    expected[i, j] += process[index - 1] * push[i] * push[j]
        share = 1.0 / (expected[0, 0] + variances[index])
        for i in range(size):
            state[i] = ahead[index, i] + share * expected[0, i] * (readings[index] - ahead[index, 0])
            for j in range(size):
                covariance[i, j] = expected[i, j] - share * expected[0, i] * expected[0, j]
    # Backwards: each state from what is known of the one after.
    for index in range(count - 2, -1, -1):
        # The gain C Fᵀ P⁻¹ is the transpose of the solution of P x = F C, as C and P are symmetric.
        _multiply(transition, covariances[index], gains)
        _solve(ahead_covariances[index + 1], gains, product)
        for i in range(size):
            for j in range(size):
                states[index, i] += gains[j, i] * (states[index + 1, j] - ahead[index + 1, j])
                product[i, j] = covariances[index + 1, i, j] - ahead_covariances[index + 1, i, j]
        _multiply(gains.T, product, room[2])
        _multiply(room[2], gains, product)
        for i in range(size):
            for j in range(size):
                covariances[index, i, j] += product[i, j]


@kernel_in_place
def _multiply(left: Array, right: Array, product: Array) -> None:
    """Fill a product of small matrices: numba takes twenty seconds to compile numpy's."""
    for i in range(left.shape[0]):
        for j in range(right.shape[1]):
            product[i, j] = 0.0
            for k in range(right.shape[0]):
                product[i, j] += left[i, k] * right[k, j]


@kernel_in_place
def _solve(matrix: Array, right: Array, factor: Array) -> None:
    """Replace `right` by the solution for it of a small, symmetric, positive definite matrix, factored as L D Lᵀ."""
    size = right.shape[0]
    for i in range(size):
        for j in range(i + 1):
            value = matrix[i, j]
            for k in range(j):
                value -= factor[i, k] * factor[j, k] * factor[k, k]
            factor[i, j] = value / factor[j, j] if j < i else value
    for column in range(size):
        for i in range(size):
            for k in range(i):
                right[i, column] -= factor[i, k] * right[k, column]
        for i in range(size - 1, -1, -1):
            right[i, column] /= factor[i, i]
            for k in range(i + 1, size):
                right[i, column] -= factor[k, i] * right[k, column]


def _middle(values: Array) -> Array:
    """Mean of each sample and the next, missing ones as zero; the last is not used."""
    filled = np.nan_to_num(values)
    return np.append((filled[1:] + filled[:-1]) / 2, 0.0)


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
    start_deviations = np.array([np.pi, LARGEST_BIAS])
    states, errors = smooth(rate, deviation, interval, tracked, tracked_error, start_deviations)
    return states[:, 0], errors[:, 0]


def disagreement(rate: Array, noise: float, interval: float, tracked: Array, tracked_error: Array) -> float:
    """
    How far a rate is from the change of an angle, over what the noise of both allows; at least 1.

    RMS of the difference over `AGREEMENT_TIME`, about its median, as bias does not count.
    """
    count = max(round(AGREEMENT_TIME / interval), 1)
    if tracked.size <= count:
        return 1.0
    difference = tracked - np.concatenate(([0.0], np.cumsum(_middle(rate) * interval)[:-1]))
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


def angle_from_accelerations(
    given: Readings[Accelerometer], base: Array, interval: float, block: Block
) -> tuple[Array, Array] | None:
    """
    Angle of a specimen that has accelerometers only.

    Parameters
    ----------
    given : Readings of Accelerometer
        Specific force less gravity at rest, m/s²; a sample that any of them misses is bridged.
    base : ndarray, shape (3, n)
        Acceleration of the table, m/s².
    interval : float
        s.
    block : Block

    Returns
    -------
    angle, standard_error : ndarray, shape (n,), or None
        rad; None if the accelerometers do not separate rotation from translation.

    Notes
    -----
    In the specimen's axes each reads d·A + θ̈ (z dₓ − x d_z) − θ̇² (x dₓ + z d_z), with A the specific force at the
    centre of its base. Differences give θ̈; what is left along x, a cos θ − g sin θ where the pole stays on the table,
    gives the tilt. θ̈ is integrated twice, and held by the tilt. A slide reads as tilt and is not separated from it.
    """
    directions = np.array([each.direction for each in given.sensors])[:, [0, 2]]
    places = np.array([each.at for each in given.sensors])[:, [0, 2]]
    sigma, missing = given.white(interval), np.isnan(given.values).any(axis=0)
    turning = places[:, 1] * directions[:, 0] - places[:, 0] * directions[:, 1]
    solving = _solving(np.column_stack((directions, turning)), sigma, block)
    if solving is None:
        return None
    errors = np.sqrt((solving**2 * sigma**2).sum(axis=1))
    pull = (places * directions).sum(axis=1)[:, None]
    states = deviations = np.zeros((missing.size, 3))
    start = np.array([np.pi, LARGEST_RATE, LARGEST_BIAS])
    tilt_error, resultant = float(errors[0]) / block.gravity, np.hypot(base[0], block.gravity)
    for _ in range(PASSES):
        squared = states[:, 1] ** 2
        along, _, angular = solving @ np.nan_to_num(given.values + squared * pull)
        along = along - squared * np.sign(states[:, 0]) * pole_position(block)
        tilt = np.arctan2(base[0], block.gravity) - np.arcsin(np.clip(along / resultant, -1.0, 1.0))
        tilt[missing] = np.nan
        deviation = np.where(missing, max(float(angular.std()), float(errors[2])), errors[2])
        states, deviations = smooth(angular, deviation, interval, tilt, np.full(tilt.size, tilt_error), start)
        tilt_error = max(tilt_error, float(np.sqrt(np.nanmean((tilt - states[:, 0]) ** 2))))
    return states[:, 0], deviations[:, 0]


def _solving(columns: Array, sigma: Array, block: Block) -> Array | None:
    """Matrix (3, m) from readings to A along x and z and θ̈; None if θ̈ and A along x are not separated."""
    present = np.abs(columns).max(axis=0) > 1e-9
    weighted = np.where(present, columns, 0.0) / sigma[:, None]
    rank = np.linalg.matrix_rank(weighted, tol=1e-9 * float(np.abs(weighted).max()))
    if not (present[0] and present[2]) or rank < present.sum():
        return None
    solving = np.linalg.pinv(weighted) / sigma
    error = float(np.sqrt((solving[2] ** 2 * sigma**2).sum()))
    alone = 1 / float(np.sqrt((1 / sigma**2).sum()))
    return solving if error * block.pole_distance < LARGEST_AMPLIFICATION * alone else None
