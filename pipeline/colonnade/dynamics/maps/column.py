"""One column of a stability map: all amplitudes at one frequency, and the limits between their outcomes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from math import pi

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.maps.limits import Runs, limits_of, onset_of
from colonnade.dynamics.maps.plan import MapPlan
from colonnade.dynamics.models.registry import PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import OUTCOMES, Harmonic, harmonic_outcomes
from colonnade.dynamics.rock import rock


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
    no_rocking, lower, upper : float
        Limits in A; NaN if the column has none. In space the onset of rocking is searched, to the plan's `edge`.
    intervals : ndarray, shape (k, 2)
        Every interval of A that overturns, from and to, with edges to the plan's `edge`.
    """

    outcome: Codes
    overturning_fraction: Array
    no_rocking: float
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
    """
    runs = _runs(plan, float(plan.frequency_ratio[index]))
    scan = plan.scan
    codes = runs(scan)
    limits = limits_of(scan, codes, runs, width=plan.width, edge=plan.edge)
    fraction = _fraction(plan.amplitude_ratio, limits.intervals)
    chosen = np.searchsorted(scan, plan.amplitude_ratio)
    onset = plan.onset if plan.space is None else onset_of(scan, codes, runs, edge=plan.edge)
    return MapColumn(codes[chosen], fraction, onset, limits.lower, limits.upper, limits.intervals)


def _runs(plan: MapPlan, frequency_ratio: float) -> Runs:
    block = plan.block
    if plan.motion is not None and plan.motion_frequency is not None:
        motion = plan.motion
        dt = motion.dt * plan.motion_frequency * 2 * pi / (frequency_ratio * block.p)
        unit = motion.acceleration * (block.uplift_acceleration / motion.peak)
        return _sampled(plan, unit, dt)

    harmonic = Harmonic.cycles(frequency_ratio * block.p, plan.cycles, phase=plan.phase, ramp=plan.ramp)

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
