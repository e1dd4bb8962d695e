"""The stability map of a block over frequency and amplitude of its base motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Codes
from colonnade.digest import Digested
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.maps.column import MapColumn, map_column
from colonnade.dynamics.maps.limits import islands_of
from colonnade.dynamics.maps.plan import EDGE, WIDTH, MapPlan, plan_map
from colonnade.dynamics.models.registry import DEFAULT
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.validation import whole

MOST_THREADS = 1024


@dataclass(frozen=True, repr=False)
class StabilityMap(Digested):
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
        A up to which the block does not uplift; from which it first overturns over at least `width`; up to which it
        last survives over at least `width`. NaN if there is no such limit up to the largest A.
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
    >>> chart.digest()["Ω"]
    '2 to 4 in 2'
    """

    frequency_ratio: Array
    amplitude_ratio: Array
    outcome: Codes
    overturning_fraction: Array
    no_rocking: Array
    lower: Array
    upper: Array
    interval_frequency_ratio: Array
    interval_start: Array
    interval_end: Array
    options: dict[str, Any]

    def digest(self) -> dict[str, str]:
        """
        Return model, axes, and the range of the lower limit.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        known = self.lower[np.isfinite(self.lower)]
        omegas, amplitudes = self.frequency_ratio, self.amplitude_ratio
        lower = f"A = {known.min():.3g} to {known.max():.3g}" if known.size else "above the largest A"
        return {
            "model": str(self.options["model"]),
            "Ω": f"{omegas[0]:.3g} to {omegas[-1]:.3g} in {omegas.size}",
            "A": f"{amplitudes[0]:.3g} to {amplitudes[-1]:.3g} in {amplitudes.size}",
            "lower limit": lower,
        }

    @property
    def islands(self) -> Array:
        """Overturning intervals narrower than `width`: rows of Ω, start and end in A, shape (k, 3)."""
        return islands_of(self.interval_frequency_ratio, self.interval_start, self.interval_end, self.options["width"])


def stability_map(
    block: Block,
    *,
    frequency_ratio: ArrayLike,
    amplitude_ratio: ArrayLike,
    restitution: Sided | RestitutionLaw | Callable[[float], float] | None = None,
    cycles: float = 20,
    phase: float = 0.0,
    ramp: float = 0,
    model: str = DEFAULT,
    width: float = WIDTH,
    edge: float = EDGE,
    motion: Motion | None = None,
    motion_frequency: float | None = None,
    threads: int = 1,
) -> StabilityMap:
    """
    Compute the stability map of a block, from rest, under a harmonic or a stretched recorded base motion.

    Parameters
    ----------
    block : Block
    frequency_ratio, amplitude_ratio : array_like, shape (n,) and (m,)
        Ω = ω / p and A = a / (g tan α), positive and increasing.
    restitution : float, pair of float, RestitutionLaw or function, optional
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
    motion : Motion, optional
        A recorded base motion in place of the sine: scaled to A, stretched to Ω. `cycles`, `phase` and ramps are then
        those of the recording.
    motion_frequency : float, optional
        Hz, the frequency of the recorded motion that Ω stretches.
    threads : int, optional
        Columns computed at a time. The result is the same to the last bit.

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
    plan = plan_map(
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
        motion=motion,
        motion_frequency=motion_frequency,
    )
    threads = whole("threads", threads, 1, MOST_THREADS)
    indices = range(plan.frequency_ratio.size)
    if threads == 1:
        return assemble(plan, [map_column(plan, index) for index in indices])
    with ThreadPoolExecutor(threads) as pool:
        return assemble(plan, list(pool.map(partial(map_column, plan), indices)))


def assemble(plan: MapPlan, columns: Sequence[MapColumn]) -> StabilityMap:
    """
    Put the columns of a plan together, in the order of its Ω.

    Raises
    ------
    ValueError
        If there are not as many columns as the plan has Ω.
    """
    if len(columns) != plan.frequency_ratio.size:
        raise ValueError(f"{len(columns)} columns were given; the plan has {plan.frequency_ratio.size}")
    intervals = np.concatenate([column.intervals for column in columns])
    return StabilityMap(
        plan.frequency_ratio,
        plan.amplitude_ratio,
        np.stack([column.outcome for column in columns]),
        np.stack([column.overturning_fraction for column in columns]),
        np.array([column.no_rocking for column in columns]),
        np.array([column.lower for column in columns]),
        np.array([column.upper for column in columns]),
        np.repeat(plan.frequency_ratio, [len(column.intervals) for column in columns]),
        intervals[:, 0],
        intervals[:, 1],
        plan.options,
    )
