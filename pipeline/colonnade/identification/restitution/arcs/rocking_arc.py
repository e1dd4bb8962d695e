"""
The angle of free rocking between two impacts, in closed form, with its sensitivities.

With ψ = α − |θ| the full equation is ψ'' = p² sin ψ. From a peak ψ_m at t_m it has the solution (Jacobi's functions)

    sin(ψ/2) = dn(u + K, k),  u = p (t − t_m),  k' = sin(ψ_m/2),

and dn is a row of equal pulses: dn(x, k) = c Σ sech(c (x − 2 n K)), c = π/2K', and few of them count as K is long
(Whittaker and Watson 1927, § 22.6, with Jacobi's imaginary transformation). The linearised equation gives
ψ = ψ_m cosh u. An impact multiplies the angular velocity by e.
"""

from __future__ import annotations

from math import acosh, asin, cosh, exp, log, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

LOCAL = 5
"""Unknowns of one arc: peak |θ|, its time, zero offset, ln α, ln p."""

SMALLEST_PULSE = 1e-17
"""Pulses of dn lower than this share are not summed."""


@kernel
def _arithmetic_geometric_mean(smaller: float) -> float:
    """Common limit of the arithmetic and geometric means of 1 and a smaller number."""
    larger = 1.0
    while larger - smaller > 1e-15 * larger:
        larger, smaller = 0.5 * (larger + smaller), sqrt(larger * smaller)
    return larger


@kernel
def _pulses(half_sine: float) -> tuple[float, float]:
    """Return c and exp(−c K) of the arc whose peak has sin(ψ_m/2) = half_sine."""
    quarter = 0.5 * pi / _arithmetic_geometric_mean(half_sine)
    complementary = 0.5 * pi / _arithmetic_geometric_mean(sqrt(1.0 - half_sine * half_sine))
    scale = 0.5 * pi / complementary
    return scale, exp(-scale * quarter)


@kernel
def _half_sine(scale: float, decay: float, u: float) -> float:
    """Sum the pulses to sin(ψ/2) at u."""
    growth = exp(scale * abs(u))
    total, power = 0.0, decay
    while power * growth > SMALLEST_PULSE:
        near, far = power * growth, power / growth
        total += near / (1.0 + near * near) + far / (1.0 + far * far)
        power *= decay * decay
    return 2.0 * scale * total


@kernel
def _changing_half_sine(scale: float, decay: float, by_scale: float, by_decay: float, u: float) -> tuple[float, float]:
    """Sum as `_half_sine`, and its change where c and ln of the decay change by so much."""
    growth, grown = exp(scale * abs(u)), by_scale * abs(u)
    total, change, power, fallen = 0.0, 0.0, decay, by_decay
    while power * growth > SMALLEST_PULSE:
        near, far = power * growth, power / growth
        near_share, far_share = near / (1.0 + near * near), far / (1.0 + far * far)
        total += near_share + far_share
        # d [x / (1 + x²)] = x / (1 + x²) · (1 − x²) / (1 + x²) d ln x
        change += near_share * (1.0 - 2.0 * near * near_share) * (fallen + grown)
        change += far_share * (1.0 - 2.0 * far * far_share) * (fallen - grown)
        power *= decay * decay
        fallen += 2.0 * by_decay
    return 2.0 * scale * total, 2.0 * (by_scale * total + scale * change)


@kernel
def _distance(peak: float, scale: float, decay: float, u: float, linearised: bool) -> float:
    """Return ψ at u of the arc that has ψ = peak at u = 0."""
    if linearised:
        return peak * cosh(u)
    return 2.0 * asin(min(_half_sine(scale, decay, u), 1.0))


@kernel
def _speed(peak: float, distance: float, linearised: bool) -> float:
    """Return |dψ/du| from the energy."""
    if linearised:
        return sqrt(max(distance * distance - peak * peak, 0.0))
    low, high = sin(0.5 * peak), sin(0.5 * distance)
    return 2.0 * sqrt(max((high - low) * (high + low), 0.0))


@kernel
def half_duration(peak: float, critical: float, linearised: bool) -> float:
    """
    Phase p t from a peak to the impact.

    Parameters
    ----------
    peak, critical : float
        |θ| of the peak and α, rad; 0 < peak < critical.
    linearised : bool
    """
    start = critical - peak
    if linearised:
        return acosh(critical / start)
    scale, decay = _pulses(sin(0.5 * start))
    u = acosh(critical / start)
    for _ in range(30):
        reached = _distance(start, scale, decay, u, False)
        step = (reached - critical) / max(_speed(start, reached, False), 1e-300)
        u = max(u - step, 0.5 * u)
        if abs(step) <= 1e-14 * u:
            break
    return u


@kernel
def half_duration_of(peaks: Array, critical: Array, linearised: bool) -> Array:
    """Apply `half_duration` to each of several peaks, shape (n,)."""
    phases = np.empty(peaks.size)
    for n in range(peaks.size):
        phases[n] = half_duration(peaks[n], critical[n], linearised)
    return phases


@kernel
def kinetic(peak: float, critical: float, linearised: bool) -> float:
    """Return (ω/p)²/2 just before the impact that ends an arc of this peak (|θ|, α, rad)."""
    if linearised:
        return peak * (critical - 0.5 * peak)
    return 2.0 * sin(critical - 0.5 * peak) * sin(0.5 * peak)


@kernel
def peak_of(energy: float, critical: float, linearised: bool) -> float:
    """Return |θ| of the peak after an impact left with (ω/p)²/2 = energy; the inverse of `kinetic`; NaN if over α."""
    if linearised:
        left = critical * critical - 2.0 * energy
        return 2.0 * energy / (critical + sqrt(left)) if left > 0.0 else np.nan
    square = sin(0.5 * critical) ** 2 - 0.5 * energy
    if not square > 0.0:
        return np.nan
    # α − ψ_m from the difference of the half sines' squares: without cancellation at small angles.
    low = asin(sqrt(square))
    return 2.0 * asin(min(0.5 * energy / sin(0.5 * critical + low), 1.0))


@kernel
def free_arcs(
    restitution: Array,
    first_peak: float,
    first_time: float,
    first_side: int,
    critical: Array,
    p: Array,
    count: int,
    linearised: bool,
) -> tuple[Array, Array, Array]:
    """
    Follow free rocking from peak to peak.

    Parameters
    ----------
    restitution : ndarray, shape (count − 1,)
        e of each impact.
    first_peak, first_time : float
        |θ| (rad) and time (s) of the first peak.
    first_side : int
        0 where it has θ < 0, 1 where θ > 0.
    critical, p : ndarray, shape (2,)
        α (rad) and p (rad/s) of the sides θ < 0 and θ > 0.
    count : int
        Number of arcs.
    linearised : bool

    Returns
    -------
    peaks, times, ends : ndarray, shape (count,)
        |θ| of each peak, its time, and the time of the impact that ends its arc; NaN from where the block overturns.
    """
    peaks, times, ends = np.full(count, np.nan), np.full(count, np.nan), np.full(count, np.nan)
    side, peak, time = first_side, first_peak, first_time
    for n in range(count):
        if not 0.0 < peak < critical[side]:
            break
        half = half_duration(peak, critical[side], linearised) / p[side]
        if n > 0:
            time = ends[n - 1] + half
        peaks[n], times[n], ends[n] = peak, time, time + half
        if n < count - 1:
            ratio = restitution[n] * p[side] / p[1 - side]
            energy = ratio * ratio * kinetic(peak, critical[side], linearised)
            side = 1 - side
            peak = peak_of(energy, critical[side], linearised)
    return peaks, times, ends


@kernel
def changes_by_energy(
    peaks: Array, first_side: int, critical: Array, p: Array, linearised: bool
) -> tuple[Array, Array]:
    """Change of each arc's peak (rad), and of half its duration (s), by half of ln of its energy."""
    by_energy, longer = np.empty(peaks.size), np.empty(peaks.size)
    for n in range(peaks.size):
        side, peak = (first_side + n) % 2, peaks[n]
        alpha, step = critical[side], 1e-6 * peak
        slope = alpha - peak if linearised else sin(alpha - peak)
        by_energy[n] = 2.0 * kinetic(peak, alpha, linearised) / slope
        change = half_duration(peak + step, alpha, linearised) - half_duration(peak - step, alpha, linearised)
        longer[n] = change / (2.0 * step) / p[side] * by_energy[n]
    return by_energy, longer


@kernel
def angle_and_sensitivity(
    time: Array,
    peaks: Array,
    times: Array,
    ends: Array,
    first_side: int,
    offset: float,
    critical: Array,
    p: Array,
    linearised: bool,
) -> tuple[Array, Array, NDArray[np.int64]]:
    """
    Angle and its sensitivities at given times.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s, increasing.
    peaks, times, ends : ndarray, shape (m,)
        Of the arcs; the first has no start, and its solution holds however early the time, the last however late.
    first_side : int
    offset : float
        rad.
    critical, p : ndarray, shape (2,)
    linearised : bool

    Returns
    -------
    angle : ndarray, shape (n,)
        rad.
    sensitivity : ndarray, shape (n, 5)
        With respect to the arc's peak |θ|, its time, the offset, ln α and ln p.
    arc : ndarray of int, shape (n,)
        Number of the arc of each sample.
    """
    angle, sensitivity = np.empty(time.size), np.empty((time.size, LOCAL))
    arc = np.empty(time.size, dtype=np.int64)
    i = 0
    for n in range(peaks.size):
        side = (first_side + n) % 2
        sign, start = 2.0 * side - 1.0, critical[side] - peaks[n]
        step, low = 1e-6 * start, sin(0.5 * start)
        scale, decay, by_scale, by_decay = 1.0, 0.0, 0.0, 0.0
        if not linearised:
            scale, decay = _pulses(low)
            (more_scale, more_decay), (less_scale, less_decay) = (
                _pulses(sin(0.5 * (start + step))),
                _pulses(sin(0.5 * (start - step))),
            )
            by_scale, by_decay = (more_scale - less_scale) / (2.0 * step), log(more_decay / less_decay) / (2.0 * step)
        while i < time.size and (n == peaks.size - 1 or not time[i] >= ends[n]):
            u = p[side] * (time[i] - times[n])
            if linearised:
                distance = _distance(start, scale, decay, u, True)
                moved, speed = distance / start, _speed(start, distance, True)
            else:
                high, change = _changing_half_sine(scale, decay, by_scale, by_decay, u)
                distance, moved = pi, 0.0
                if high < 1.0:
                    distance, moved = 2.0 * asin(high), 2.0 * change / sqrt((1.0 - high) * (1.0 + high))
                speed = 2.0 * sqrt(max((min(high, 1.0) - low) * (min(high, 1.0) + low), 0.0))
            speed = speed if u >= 0.0 else -speed
            angle[i] = offset + sign * (critical[side] - distance)
            sensitivity[i, 0] = sign * moved
            sensitivity[i, 1] = sign * speed * p[side]
            sensitivity[i, 2] = 1.0
            sensitivity[i, 3] = sign * critical[side] * (1.0 - moved)
            sensitivity[i, 4] = -sign * speed * u
            arc[i] = n
            i += 1
    return angle, sensitivity, arc


@kernel
def angle_of_arcs(
    time: Array,
    peaks: Array,
    times: Array,
    ends: Array,
    first_side: int,
    offset: float,
    critical: Array,
    p: Array,
    linearised: bool,
) -> Array:
    """Angle alone; arguments as for `angle_and_sensitivity`."""
    angle = np.empty(time.size)
    i = 0
    for n in range(peaks.size):
        side = (first_side + n) % 2
        start, scale, decay = critical[side] - peaks[n], 1.0, 0.0
        if not linearised:
            scale, decay = _pulses(sin(0.5 * start))
        while i < time.size and (n == peaks.size - 1 or not time[i] >= ends[n]):
            distance = _distance(start, scale, decay, p[side] * (time[i] - times[n]), linearised)
            angle[i] = offset + (2.0 * side - 1.0) * (critical[side] - distance)
            i += 1
    return angle


@kernel
def normal_equations(sensitivity: Array, residual: Array, arc: NDArray[np.int64], count: int) -> tuple[Array, Array]:
    """Sum products of sensitivities (m, l, l), and with residuals (m, l), over each arc; NaN ones are passed over."""
    local = sensitivity.shape[1]
    products, gradients = np.zeros((count, local, local)), np.zeros((count, local))
    for i in range(residual.size):
        if np.isnan(residual[i]):
            continue
        n = arc[i]
        for j in range(local):
            gradients[n, j] += sensitivity[i, j] * residual[i]
            for k in range(j + 1):
                products[n, j, k] += sensitivity[i, j] * sensitivity[i, k]
    for n in range(count):
        for j in range(local):
            for k in range(j):
                products[n, k, j] = products[n, j, k]
    return products, gradients
