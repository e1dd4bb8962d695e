"""Rocking angle from gyroscopes: rates integrated, with the drift held by transducers or by the rests."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.fusion.inertial import Gyroscope
from colonnade.identification.fusion.smoother import smooth
from colonnade.signals.stretches import stretches

QUIET = 4.5
"""A specimen stands where a rate stays below this many times its noise; the noise alone does over some 10⁵ samples."""

REST_ERROR = 1e-5
"""rad, and rad/s: standard error with which a standing specimen is upright and still."""

NEAR_UPRIGHT = 0.05
"""Fraction of α; a still specimen that is further from upright is held, or leans on its frame."""

LARGEST_BIAS = 0.1
"""rad/s: standard deviation of what a gyroscope reads at rest, before anything is known of it."""

AGREEMENT_TIME = 0.05
"""s over which a rate is compared with the change of an angle."""


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
    Integrate a rate, its bias and random walk held by an angle that is known now and then.

    Parameters
    ----------
    rate : ndarray, shape (n,)
        θ̇, rad/s; NaN where missing.
    noise : float
        Standard deviation of each sample of it were it white, rad/s.
    interval : float
        s.
    tracked, tracked_error : ndarray, shape (n,)
        θ of other transducers or at rest and its standard error, sample by sample independent; NaN where unknown. rad.

    Returns
    -------
    angle, standard_error : ndarray, shape (n,)
        rad.

    Notes
    -----
    A rate that disagrees with the tracked angle by more than both errors is taken to be that much noisier; see
    `disagreement`.
    """
    missing = ~np.isfinite(rate)
    middle = _middle(rate)
    noise *= disagreement(rate, noise, interval, tracked, tracked_error)
    deviation = np.maximum(noise, float(np.nanstd(rate)) * np.sqrt(_gap_lengths(missing)))
    process = np.zeros((rate.size, 2, 2))
    process[:, 0, 0] = (deviation * interval) ** 2
    inputs = np.column_stack((middle * interval, np.zeros(rate.size)))
    readings = np.column_stack((np.nan_to_num(tracked), np.zeros(rate.size)))
    variances = np.full((rate.size, 2), np.inf)
    known = np.isfinite(tracked)
    variances[known, 0] = tracked_error[known] ** 2
    transition = np.array([[1.0, interval], [0.0, 1.0]])
    states, errors = smooth(transition, inputs, process, readings, variances, np.array([np.pi, LARGEST_BIAS]) ** 2)
    return states[:, 0], errors[:, 0]


def _middle(rate: Array) -> Array:
    """Mean of each sample and the next, missing ones as zero; the last is not used."""
    filled = np.nan_to_num(rate)
    return np.append((filled[1:] + filled[:-1]) / 2, 0.0)


def _gap_lengths(missing: Mask) -> Array:
    """Steps of the gap that each step is in, 0 outside; over a gap a rate is unknown as a whole, not step by step."""
    broken = missing | np.append(missing[1:], False)
    lengths = np.zeros(missing.size)
    for start, stop in zip(*stretches(broken), strict=True):
        lengths[start:stop] = stop - start
    return lengths


def disagreement(rate: Array, noise: float, interval: float, tracked: Array, tracked_error: Array) -> float:
    """
    How far a rate is from the change of an angle, over what the noise of both allows.

    Returns
    -------
    factor : float
        Root mean square of the difference over `AGREEMENT_TIME`, about its median, as bias does not count; at least
        1. See `angle_from_rate` for the arguments.
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
    interval : float
        s.
    block : Block
    duration : float
        Shortest rest, s.
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
