"""The stability map of a block over frequency and amplitude of its base motion, and its steady responses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import inf, pi, tan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.contact.body import InSpace
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models import DEFAULT, model_of, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import OUTCOMES, SAMPLES_A_CYCLE, Harmonic, outcomes_of
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE, of_sides
from colonnade.dynamics.search import (
    MOST_STEPS,
    WIDTH,
    OverFrequency,
    Runs,
    checked_ratios,
    checked_widths,
    limits_of,
    onset_of,
    over_frequency,
    scan_over,
)
from colonnade.validation import instance, number

EDGE = 1e-4
"""In A: how closely the edges of intervals are found."""

MOST_CYCLES = 100_000
"""Of a sine, and of each of its ramps."""


class MapPlan:
    """
    All that the columns of a map have in common; arguments as for `stability_map`, whose values it checks.

    Parameters
    ----------
    space : InSpace, optional
        Body and law of contact of a model in space, whose restitution they are.

    Raises
    ------
    ValueError
        If an argument is out of its range, an axis does not increase or the model is not known.
    """

    def __init__(
        self,
        block: Block,
        *,
        frequency_ratio: ArrayLike,
        amplitude_ratio: ArrayLike,
        restitution: Sided | None = None,
        cycles: float = 20,
        phase: float = 0.0,
        ramp: float = 0,
        model: str = DEFAULT,
        width: float = WIDTH,
        edge: float = EDGE,
        space: InSpace | None = None,
    ) -> None:
        instance("block", block, Block)
        if space is None:
            plane_model_of(model)
        self.block, self.model, self.space = block, model, space
        self.frequency_ratio = checked_ratios("frequency_ratio", frequency_ratio)
        self.amplitude_ratio = amplitudes = checked_ratios("amplitude_ratio", amplitude_ratio, fewest=2)
        cells = self.frequency_ratio.size * amplitudes.size
        if cells > MOST_STEPS:
            raise ValueError(
                f"amplitude_ratio and frequency_ratio make {cells} cells; at most {MOST_STEPS} were expected"
            )
        self.restitution = of_sides(block, restitution)
        expected = f"at least one cycle and at most {MOST_CYCLES}"
        self.cycles = number("cycles", cycles, expected, low=1.0, high=MOST_CYCLES)
        expected = f"a number of cycles from 0 for none to {MOST_CYCLES}"
        self.ramp = number("ramp", ramp, expected, low=0.0, high=MOST_CYCLES)
        self.phase = number("phase", phase, "a finite angle in rad") % (2 * pi)
        self.width, self.edge = checked_widths(width, edge, float(amplitudes[-1] - amplitudes[0]))
        # The A that every column runs: those of the map, and between them as many as make steps of width / 4.
        self.scan = scan_over(amplitudes, self.width)

    @property
    def options(self) -> dict[str, Any]:
        """Everything else that the result depends on, apart from block and axes, by name."""
        return {
            **{name: getattr(self, name) for name in ("model", "cycles", "phase", "ramp", "width", "edge")},
            "restitution_negative": self.restitution[0],
            "restitution_positive": self.restitution[1],
            "scan_step": float(np.diff(self.scan).max()),
            "rest_angle": DEFAULT_REST_ANGLE,
            "no_rocking_ratio": NO_ROCKING_RATIO,
            "critical_angle": self.block.critical_angle,
            "p": self.block.p,
            **({} if self.space is None else self.space.options | {"samples_a_cycle": SAMPLES_A_CYCLE}),
        }


def map_part(plan: MapPlan, columns: Sequence[int]) -> StabilityMap:
    """
    Compute some columns of a map.

    Parameters
    ----------
    plan : MapPlan
    columns : sequence of int
        By their Ω in the plan.

    Returns
    -------
    chart : StabilityMap
        Of these Ω; the same to the last bit, whatever the order and the process in which columns are computed.
    """
    block, scan, amplitudes = plan.block, plan.scan, plan.amplitude_ratio
    chosen, omegas = np.searchsorted(scan, amplitudes), plan.frequency_ratio[list(columns)]
    # Of a model in the plane the onset is known: 1, but α / tan α for the linear one.
    onsets = np.full(
        omegas.size, model_of(plan.model).uplift_threshold(block.critical_angle) / tan(block.critical_angle)
    )
    limits = []
    for place, omega in enumerate(omegas.tolist()):
        motion = Harmonic.cycles(omega * block.p, plan.cycles, phase=plan.phase, ramp=plan.ramp)
        runs = runs_of(plan, motion)
        limits.append(limits_of(scan, runs, width=plan.width, edge=plan.edge))
        if plan.space is not None:
            onsets[place] = onset_of(scan, limits[-1].codes, runs, edge=plan.edge)
    return StabilityMap(
        **over_frequency(omegas, limits),
        options=plan.options,
        amplitude_ratio=amplitudes,
        outcome=np.stack([each.codes[chosen] for each in limits]),
        overturning_fraction=np.stack([_fraction(amplitudes, each.intervals) for each in limits]),
        no_rocking=onsets,
    )


def runs_of(plan: MapPlan, motion: Harmonic) -> Runs:
    """Give what runs a plan's block under a sine at some A."""
    block, space = plan.block, plan.space
    if space is None:
        forcing = motion.forcing()
        return partial(outcomes_of, block=block, forcing=forcing, restitution=plan.restitution, model=plan.model)
    unit, dt = motion.sampled(block.uplift_acceleration)

    def outcomes(amplitudes: Array) -> Codes:
        found = [space.run(Motion(unit * amplitude, dt), block.gravity).outcome for amplitude in amplitudes]
        return np.array([OUTCOMES.index(outcome) for outcome in found], dtype=np.int8)

    return outcomes


def _fraction(amplitudes: Array, intervals: Array) -> Array:
    """Share of the cells around the amplitudes that the intervals cover, shape (m,)."""
    edges = np.concatenate([amplitudes[:1], 0.5 * (amplitudes[1:] + amplitudes[:-1]), amplitudes[-1:]])
    starts, lengths = intervals[:, 0], intervals[:, 1] - intervals[:, 0]
    covered = np.clip(edges[:, None] - starts, 0.0, lengths).sum(axis=1)
    return np.asarray(np.clip(np.diff(covered) / np.diff(edges), 0.0, 1.0))


@dataclass(frozen=True, repr=False, kw_only=True)
class StabilityMap(OverFrequency):
    """
    Outcomes over Ω and A, and the limits between them.

    Attributes
    ----------
    frequency_ratio, amplitude_ratio : ndarray, shape (n,) and (m,)
        Ω = ω / p and A = a / (g tan α).
    outcome : ndarray of int8, shape (n, m)
        0 no-rocking, 1 rocking, 2 overturned.
    overturning_fraction : ndarray, shape (n, m)
        Share of the cell around each A that overturns.
    no_rocking, lower, upper : ndarray, shape (n,)
        A up to which the block does not uplift, in space searched to the plan's `edge`; from which it first overturns
        over at least `width`; up to which it last survives over at least `width`. NaN if there is no such limit up to
        the largest A.
    interval_frequency_ratio, interval_start, interval_end : ndarray, shape (k,)
        Every interval of A that overturns, islands included, by its Ω.
    options : dict
        All that the limits depend on: model, cycles, phase, ramp, scan step, width, edge,
        restitution, rest rule.

    Examples
    --------
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> chart = colonnade.stability_map(block, frequency_ratio=[2.0, 4.0], amplitude_ratio=[0.5, 2.0, 4.0])
    >>> chart.no_rocking.round(2).tolist(), chart.islands.shape[1]
    ([0.99, 0.99], 3)
    >>> chart
    <StabilityMap: frequency_ratio 2 to 4, lower 1.02 to 1.69, upper 1.02 to 2.82>
    """

    amplitude_ratio: Array
    outcome: Codes
    overturning_fraction: Array
    no_rocking: Array


def stability_map(
    block: Block,
    *,
    frequency_ratio: ArrayLike,
    amplitude_ratio: ArrayLike,
    restitution: Sided | None = None,
    cycles: float = 20,
    phase: float = 0.0,
    ramp: float = 0,
    model: str = DEFAULT,
    width: float = WIDTH,
    edge: float = EDGE,
) -> StabilityMap:
    """
    Compute the stability map of a block, from rest, under a harmonic base motion.

    Parameters
    ----------
    block : Block
    frequency_ratio, amplitude_ratio : array_like, shape (n,) and (m,)
        Ω = ω / p and A = a / (g tan α), positive and increasing.
    restitution : float or pair of float, optional
        e, see `rock`; default the rigid-body value.
    cycles : float, optional
        Number of cycles at full amplitude, at least 1.
    phase : float, optional
        rad: the base acceleration is a sin(ω t + phase).
    ramp : float, optional
        Number of cycles over which the amplitude rises before, and falls after.
    model : str, optional
        A plane one.
    width : float, optional
        In A: intervals narrower than this make no limit.
    edge : float, optional
        In A: how closely the edges of intervals are found.

    Returns
    -------
    chart : StabilityMap

    Raises
    ------
    ValueError
        If an argument is out of its range, an axis does not increase or the model is not known.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> chart = stability_map(block, restitution=0.976, frequency_ratio=[2.0, 6.0], amplitude_ratio=[0.5, 1.5, 3.0])
    >>> chart.outcome.tolist()
    [[0, 2, 2], [0, 1, 1]]
    """
    plan = MapPlan(
        block,
        frequency_ratio=frequency_ratio,
        amplitude_ratio=amplitude_ratio,
        restitution=restitution,
        cycles=cycles,
        phase=phase,
        ramp=ramp,
        model=model,
        width=width,
        edge=edge,
    )
    return map_part(plan, range(plan.frequency_ratio.size))


AT_REST, IRREGULAR, OVERTURNED = 0, -1, -2
"""Orders of responses that do not repeat as rocking."""

LARGEST_ORDER = 8
"""Longest repeat looked for, in cycles of the base."""

REPEATS = 3
"""How often a response has to repeat."""

SAME = 1e-4
"""States that differ by less, as fractions of α and of α p, are the same."""


@dataclass(frozen=True)
class SteadyResponse:
    """
    Steady responses over Ω and A.

    Attributes
    ----------
    frequency_ratio, amplitude_ratio : ndarray, shape (n,) and (m,)
    order : ndarray of int8, shape (n, m)
        k ≥ 1: the response repeats every k cycles of the base (sub-harmonic 1/k for k > 1); 0 at rest, −1 irregular,
        −2 overturned.
    amplitude : ndarray, shape (n, m)
        Largest |θ|/α over the last `LARGEST_ORDER` · `REPEATS` cycles; NaN where the block overturned.
    """

    frequency_ratio: Array
    amplitude_ratio: Array
    order: NDArray[np.int8]
    amplitude: Array


def steady_response(plan: MapPlan, columns: Sequence[int], settling: int) -> SteadyResponse:
    """
    Find the steady responses, from rest, at some Ω and all A of a map, by a model in the plane.

    Parameters
    ----------
    plan : MapPlan
        Its sine rises over `ramp` cycles and does not fall; its `cycles` do not count.
    columns : sequence of int
        By their Ω in the plan.
    settling : int
        Cycles at full amplitude before the response is looked at. A deviation dies out as e² a cycle where there are
        two impacts in it: at e = 0.976 to 4e-9 within 400 cycles.

    Returns
    -------
    response : SteadyResponse
    """
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    block, sides = plan.block, sides_of(plan.block, plan.restitution)
    linearised = plane_model_of(plan.model).is_linearised
    omegas, levels = plan.frequency_ratio[list(columns)], tan(block.critical_angle) * plan.amplitude_ratio
    first = round(plan.ramp) + settling
    count = first + LARGEST_ORDER * (REPEATS + 1)
    order = np.zeros((omegas.size, levels.size), dtype=np.int8)
    amplitude = np.full(order.shape, np.nan)
    for row, omega in enumerate(omegas * block.p):
        cycle = 2 * pi / omega
        times = cycle * np.arange(count)
        forcing = Harmonic(omega, plan.phase, (plan.ramp * cycle, count * cycle, count * cycle)).forcing(*times)
        at = np.searchsorted(forcing.times, times)
        since = int(at[first + LARGEST_ORDER])
        for column, level in enumerate(levels.tolist()):
            scaled = forcing._replace(levels=level * forcing.levels)
            angles, velocities, _, _, end = propagate(scaled, sides, is_linearised=linearised, since=since, floor=inf)
            if np.isfinite(end.time):
                order[row, column] = OVERTURNED
                continue
            amplitude[row, column] = end.peak
            states = np.column_stack([angles[at], velocities[at] / block.p])[first:] / block.critical_angle
            order[row, column] = AT_REST if end.peak == 0.0 else _order(states)
    return SteadyResponse(omegas, plan.amplitude_ratio, order, amplitude)


def _order(states: Array) -> int:
    """Return the smallest number of cycles after which the states, one a cycle, repeat; `IRREGULAR` if none."""
    for order in range(1, LARGEST_ORDER + 1):
        last = states[-(REPEATS + 1) * order :]
        if np.abs(last[order:] - last[:-order]).max() < SAME:
            return order
    return IRREGULAR
