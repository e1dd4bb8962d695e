"""The Cramér–Rao error of e: the smallest standard error that an unbiased estimator can have on a record."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from monte_carlo.design import Draw, pink_power

STEPS = {"restitution": 1e-6, "release_angle": 1e-6, "release_time": 1e-6, "zero_offset": 1e-6}
"""Of central differences: of e; of α; of 1/p; of α."""

MOST_SAMPLES = 8000
"""Of longer records evenly spaced samples are taken, each for those about it."""


def cramer_rao_error(draw: Draw) -> float:
    """
    Smallest standard error of e where e, release angle, release time and zero offset are unknown.

    Notes
    -----
    The information is that of all samples before the filter, with noise of known spectrum, for one e of all impacts;
    block (p, α) known. A low-pass takes information away, mostly on when the impacts were, so that for filtered records
    the bound is lower than what is left to reach. For noise of power 1/f it is Whittle's approximation.
    """
    rocking, time = draw.rocking, draw.clock()
    stride = max(time.size // MOST_SAMPLES, 1)
    time = time[stride // 2 :: stride]
    scales = {
        "restitution": 1.0,
        "release_angle": rocking.critical_angle,
        "release_time": 1 / rocking.p,
        "zero_offset": rocking.critical_angle,
    }
    columns = []
    for name, step in STEPS.items():
        by, at = step * scales[name], getattr(rocking, name)
        ahead, behind = (replace(rocking, **{name: at + sign * by}).angle(time) for sign in (1, -1))
        columns.append((ahead - behind) / (2 * step))
    jacobian = np.column_stack(columns) / (draw.noise * rocking.critical_angle)
    jacobian = _whitened(jacobian, draw.pink, stride) if draw.pink else jacobian * np.sqrt(stride)
    # Columns of one length, so that the inverse is well conditioned.
    lengths = np.linalg.norm(jacobian, axis=0)
    if not (lengths > 0).all():
        return float("inf")
    covariance = np.linalg.pinv((jacobian / lengths).T @ (jacobian / lengths))
    return float(np.sqrt(covariance[0, 0]) / lengths[0])


def _whitened(jacobian: np.ndarray, pink: float, stride: int) -> np.ndarray:
    """Columns over the square root of the noise's power, of unit variance, in frequencies; shape (2 m, k)."""
    count = jacobian.shape[0]
    transform = np.fft.rfft(jacobian, 2 * count, axis=0)[1:]
    # Each sample stands for the mean of `stride` recorded ones.
    power = (1 - pink + pink * pink_power(stride * count)[:count]) / stride
    white = transform / np.sqrt(power * count)[:, None]
    return np.vstack((white.real, white.imag))
