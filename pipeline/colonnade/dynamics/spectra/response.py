"""Response spectrum of a motion: the largest response of damped oscillators, exact for a motion linear in time."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, exp, pi, sin, sqrt

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array

DAMPING = 0.05
"""Fraction of critical damping that is usual."""

FEWEST_PER_PERIOD = 100
"""Instants a period at which the response is looked at: its peak is missed by 0.05 % (1 − cos(π/100)) at most."""


@dataclass(frozen=True)
class ResponseSpectrum:
    """
    Largest responses of oscillators on one motion.

    Attributes
    ----------
    period : ndarray, shape (n,)
        Of the undamped oscillator, s.
    displacement : ndarray, shape (n,)
        Largest |u| relative to the base, m.
    pseudo_acceleration : ndarray, shape (n,)
        ω² times that, m/s².
    """

    period: Array
    displacement: Array
    pseudo_acceleration: Array


def response_spectrum(
    acceleration: ArrayLike, interval: float, period: ArrayLike, *, damping: float = DAMPING
) -> ResponseSpectrum:
    """
    Compute the response spectrum of a base acceleration.

    Parameters
    ----------
    acceleration : array_like, shape (m,)
        Of the base, m/s², linear between its samples; it starts from zero within one interval before the first.
    interval : float
        s.
    period : array_like, shape (n,)
        Of the oscillators, s, positive.
    damping : float, optional
        Fraction of critical damping, from 0 to less than 1.

    Returns
    -------
    spectrum : ResponseSpectrum

    Raises
    ------
    ValueError
        If a period or the interval is not positive, the damping is out of range, or a sample is not finite.

    Notes
    -----
    u'' + 2ζω u' + ω² u = −a has, for a linear between two samples, a closed form that is linear in state and samples
    (Nigam and Jennings 1969). u alone follows a recursion of second order, which is run as a digital filter. For short
    periods the motion is given further samples on its own lines, which changes nothing but where u is looked at.

    Examples
    --------
    >>> response_spectrum(np.ones(2000), 0.01, [0.5], damping=0.0).displacement.round(4).tolist()
    [0.0127]
    """
    values, periods = np.asarray(acceleration, dtype=np.float64), np.asarray(period, dtype=np.float64)
    if not (interval > 0 and np.all(periods > 0)):
        raise ValueError("the interval or a period is not positive; times above 0 s were expected")
    if not 0 <= damping < 1:
        raise ValueError(f"the damping is {damping}; a fraction of critical damping from 0 to below 1 was expected")
    if not np.isfinite(values).all():
        raise ValueError("a sample of the acceleration is not finite; fill gaps first")
    from_zero = np.concatenate(([0.0], values))
    finer: dict[int, Array] = {}
    largest = np.empty_like(periods)
    for index, each in enumerate(periods.ravel()):
        parts = max(ceil(FEWEST_PER_PERIOD * interval / each), 1)
        if parts not in finer:
            finer[parts] = _subdivided(from_zero, parts)
        numerator, denominator = _recursion(2 * pi / each, damping, interval / parts)
        response = scipy.signal.lfilter(numerator, denominator, finer[parts])
        largest.flat[index] = np.abs(response).max(initial=0.0)
    return ResponseSpectrum(periods, largest, (2 * pi / periods) ** 2 * largest)


def _recursion(omega: float, damping: float, step: float) -> tuple[Array, Array]:
    """
    Coefficients of u over a, as a filter of second order.

    The state x = (u, u') goes from sample to sample by x₁ = A x₀ + P a₀ + Q a₁. With F the matrix of the oscillator and
    g = (0, −1): A = exp(F h), Q = F⁻²(A − I − F h) g / h, P = F⁻¹(A − I) g − Q.
    """
    damped = omega * sqrt(1 - damping**2)
    decay, cosine, sine = exp(-damping * omega * step), cos(damped * step), sin(damped * step) / damped
    transition = decay * np.array(
        [
            [cosine + damping * omega * sine, sine],
            [-(omega**2) * sine, cosine - damping * omega * sine],
        ]
    )
    system = np.array([[0.0, 1.0], [-(omega**2), -2 * damping * omega]])
    load = np.array([0.0, -1.0])
    whole = np.linalg.solve(system, (transition - np.eye(2)) @ load)
    second = np.linalg.solve(system, whole - step * load) / step
    first = whole - second
    numerator = np.array(
        [
            second[0],
            first[0] - transition[1, 1] * second[0] + transition[0, 1] * second[1],
            transition[0, 1] * first[1] - transition[1, 1] * first[0],
        ]
    )
    return numerator, np.array([1.0, -np.trace(transition), np.linalg.det(transition)])


def _subdivided(values: Array, parts: int) -> Array:
    """Return the motion with `parts` samples an interval on its own lines."""
    if parts == 1:
        return values
    fine = np.arange((values.size - 1) * parts + 1) / parts
    return np.asarray(np.interp(fine, np.arange(values.size), values))
