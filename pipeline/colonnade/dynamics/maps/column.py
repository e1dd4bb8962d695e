"""One column of a stability map: all amplitudes at one frequency, and the limits between their outcomes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import ceil, log2, pi

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Codes
from colonnade.dynamics.maps.plan import MapPlan
from colonnade.dynamics.models.registry import PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic import OUTCOMES, Harmonic, harmonic_outcomes
from colonnade.dynamics.rock import rock

Runs = Callable[[Array], Codes]
"""Returns the outcomes at some A."""


@dataclass(frozen=True)
class MapColumn:
    """
    A column.

    Attributes
    ----------
    outcome : ndarray of int8, shape (m,)
        Index into `OUTCOMES` at the A of the map.
    overturning_fraction : ndarray, shape (m,)
        Share of the cell around each A, halfway to its neighbours, that overturns.
    lower, upper : float
        Limits in A; NaN if the column has none.
    intervals : ndarray, shape (k, 2)
        Every interval of A that overturns, from and to, with edges to the plan's `edge`.
    """

    outcome: Codes
    overturning_fraction: Array
    lower: float
    upper: float
    intervals: Array


def map_column(plan: MapPlan, index: int) -> MapColumn:
    """
    Compute one column of a map.

    Parameters
    ----------
    plan : MapPlan
    index : int
        Of its Ω in the plan.

    Returns
    -------
    column : MapColumn
        The same to the last bit, whatever the order and the process in which columns are computed.

    Notes
    -----
    `lower` is the start of the first overturning interval at least `width` wide; `upper` the end of the last surviving
    interval by the same rule, NaN if that reaches the largest A.
    """
    runs = _runs(plan, float(plan.frequency_ratio[index]))
    scan = plan.scan
    codes = runs(scan)
    intervals = _intervals(scan, codes == 2, runs, plan.edge)
    low, high = float(scan[0]), float(scan[-1])
    lower = _first_wide(intervals, plan.width)
    upper = _last_wide_end(_gaps(intervals, low, high), plan.width, high)
    fraction = _fraction(plan.amplitude_ratio, intervals)
    chosen = np.searchsorted(scan, plan.amplitude_ratio)
    return MapColumn(codes[chosen], fraction, lower, upper, intervals)


def _runs(plan: MapPlan, frequency_ratio: float) -> Runs:
    block = plan.block
    if plan.motion is not None and plan.motion_frequency is not None:
        motion = plan.motion
        dt = motion.dt * plan.motion_frequency * 2 * pi / (frequency_ratio * block.p)
        unit = motion.acceleration * (block.uplift_acceleration / motion.peak)
        return _sampled(plan, unit, dt)

    harmonic = Harmonic.cycles(
        frequency_ratio * block.p, plan.cycles, phase=plan.phase, ramp=plan.ramp, ramp_shape=plan.ramp_shape
    )

    if plan.model not in PLANE_MODELS:
        from colonnade.dynamics.maps.space import sampled

        wave, dt = sampled(harmonic)
        return _sampled(plan, block.uplift_acceleration * wave, dt)

    def sine(amplitudes: Array) -> Codes:
        return harmonic_outcomes(block, harmonic, amplitudes, plan.restitution, plan.model)

    return sine


def _sampled(plan: MapPlan, unit: Array, dt: float) -> Runs:
    """Run a sampled base motion, with its acceleration at A = 1 (m/s²) and its step (s), at some A."""
    if plan.space is not None:
        from colonnade.dynamics.maps.space import outcomes

        return partial(outcomes, plan.space, unit, dt, gravity=plan.block.gravity)

    def runs(amplitudes: Array) -> Codes:
        found = [
            rock(plan.block, Motion(unit * amplitude, dt), restitution=plan.restitution, model=plan.model).outcome
            for amplitude in amplitudes
        ]
        return np.array([OUTCOMES.index(outcome) for outcome in found], dtype=np.int8)

    return runs


def _intervals(scan: Array, overturned: NDArray[np.bool_], runs: Runs, edge: float) -> Array:
    """Intervals of overturning, shape (k, 2): every change between neighbours of the scan halved down to `edge`."""
    changes = np.flatnonzero(overturned[1:] != overturned[:-1])
    low, high, before = scan[changes], scan[changes + 1], overturned[changes]
    if changes.size:
        for _ in range(max(0, ceil(log2(float((high - low).max()) / edge)))):
            middle = 0.5 * (low + high)
            as_before = (runs(middle) == 2) == before
            low, high = np.where(as_before, middle, low), np.where(as_before, high, middle)
    edges = 0.5 * (low + high)
    first = scan[:1] if overturned[0] else scan[:0]
    last = scan[-1:] if overturned[-1] else scan[:0]
    return np.concatenate([first, edges, last]).reshape(-1, 2)


def _gaps(intervals: Array, low: float, high: float) -> Array:
    """What the intervals leave of [low, high], shape (k, 2)."""
    bounds = np.concatenate([[low], intervals.ravel(), [high]]).reshape(-1, 2)
    return bounds[bounds[:, 1] > bounds[:, 0]]


def _first_wide(intervals: Array, width: float) -> float:
    wide = intervals[intervals[:, 1] - intervals[:, 0] >= width]
    return float(wide[0, 0]) if wide.size else float("nan")


def _last_wide_end(intervals: Array, width: float, largest: float) -> float:
    wide = intervals[intervals[:, 1] - intervals[:, 0] >= width]
    return float(wide[-1, 1]) if wide.size and wide[-1, 1] < largest else float("nan")


def _fraction(amplitudes: Array, intervals: Array) -> Array:
    """Share of the cells around the amplitudes that the intervals cover, shape (m,)."""
    middles = 0.5 * (amplitudes[1:] + amplitudes[:-1])
    edges = np.concatenate([amplitudes[:1], middles, amplitudes[-1:]])
    if intervals.size == 0:
        return np.zeros(amplitudes.size)
    lengths = np.cumsum(intervals[:, 1] - intervals[:, 0])
    knots = intervals.ravel()
    covered = np.column_stack([np.concatenate([[0.0], lengths[:-1]]), lengths]).ravel()
    share: Array = np.diff(np.interp(edges, knots, covered)) / np.diff(edges)
    return np.clip(share, 0.0, 1.0, out=share)
