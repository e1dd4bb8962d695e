"""The Cramér–Rao error of e: the smallest standard error that an unbiased estimator can have on a record."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from monte_carlo.design import Draw, pink_power

STEP = 1e-5
"""Of central differences: of ln e, ln α, ln p; of α; of 1/p."""

MOST_SAMPLES = 1000
"""Of longer records evenly spaced samples are taken, each for those about it."""


def cramer_rao_error(draw: Draw) -> float:
    """
    Smallest standard error of the mean e.

    Unknown are e of each impact or its change with the speed, release, zero, drift, α, p and gain.

    Notes
    -----
    The scatter of e and the errors of α, p and gain are as known as their standard deviations. The information is that
    of all samples before the filter, with noise of known spectrum. A low-pass takes information away, mostly on when
    the impacts were, so that for filtered records the bound is lower than what is left to reach. For noise of power 1/f
    it is Whittle's approximation.
    """
    rocking, time = draw.rocking, draw.clock()
    stride = max(time.size // MOST_SAMPLES, 1)
    time = time[stride // 2 :: stride]
    alpha, p, e = np.array(rocking.critical_angle), np.array(rocking.p), rocking.restitution

    def change(scale: float, **by: float) -> np.ndarray:
        ends = []
        for sign in (1, -1):
            x = sign * STEP
            moved = replace(
                rocking,
                restitution=e * np.exp(x * np.isin(np.arange(e.size), [by.get("impact", -1)])),
                critical_angle=tuple(alpha * np.exp(x * by.get("alpha", 0))),
                p=tuple(p * np.exp(x * by.get("p", 0))),
                release_angle=rocking.release_angle + x * scale * by.get("release", 0),
                release_time=rocking.release_time + x * scale * by.get("time", 0),
            )
            ends.append(moved.angle(time))
        return (ends[0] - ends[1]) / (2 * STEP)

    impacts = np.array([change(1.0, impact=number) for number in range(e.size)])
    columns = [
        impacts.sum(axis=0),
        change(alpha.min(), release=1),
        change(1 / p.max(), time=1),
        np.full(time.size, alpha.min()),
        alpha.min() * np.linspace(-1, 1, time.size),
    ]
    prior = [0.0] * 5
    if draw.width:
        columns += [change(1.0, alpha=1), change(1.0, p=1), rocking.angle(time)]
        prior += [draw.width**-2] * 3
    if rocking.by_speed:
        course = rocking.course()[1]
        columns.append(impacts.T @ (course - course.mean()))
        prior.append(0.0)
    if draw.scatter:
        columns += list(impacts)
        # ln e scatters by so much.
        prior += [(draw.scatter / draw.truth) ** -2] * e.size
    jacobian = np.column_stack(columns) / (draw.noise * draw.block.critical_angle)
    jacobian = _whitened(jacobian, draw.pink, stride) if draw.pink else jacobian * np.sqrt(stride)
    information = jacobian.T @ jacobian + np.diag(prior)
    scale = np.sqrt(np.diag(information))
    covariance = np.linalg.pinv(information / np.outer(scale, scale), hermitian=True)
    return float(draw.truth * np.sqrt(covariance[0, 0]) / scale[0])


def _whitened(jacobian: np.ndarray, pink: float, stride: int) -> np.ndarray:
    """Columns over the square root of the noise's power, of unit variance, in frequencies; shape (2 m, k)."""
    count = jacobian.shape[0]
    transform = np.fft.rfft(jacobian, 2 * count, axis=0)[1:]
    # Each sample stands for the mean of `stride` recorded ones.
    power = (1 - pink + pink * pink_power(stride * count)[:count]) / stride
    white = transform / np.sqrt(power * count)[:, None]
    return np.vstack((white.real, white.imag))
