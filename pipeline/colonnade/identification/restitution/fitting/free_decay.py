"""Free rocking from release to rest as a function of a few unknowns, with its derivatives."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from math import exp, log

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kernel import kernel
from colonnade.identification.restitution.arcs.energy import lift
from colonnade.identification.restitution.arcs.rocking_arc import (
    LOCAL,
    angle_and_sensitivity,
    angle_of_arcs,
    changes_by_energy,
    free_arcs,
    normal_equations,
)

ALWAYS = ("restitution", "peak", "time", "zero_offset")
"""Unknowns of every fit: ln e, |θ| of the first peak (rad), its time (s), zero offset (rad)."""

OPTIONAL = ("critical_angle", "p")
"""Unknowns that may be freed: the logarithm of the factor on the block's α, and on its p."""

STEP = 1e-6
"""Of the differences that give derivatives."""


def first_values(energy: Array, size: Array, *, peak: float, time: float) -> dict[str, float]:
    """
    Return unknowns to start from, of the block as given.

    Parameters
    ----------
    energy, size : ndarray, shape (n,)
        Of successive peaks, in any units: their energy gives e, weighted by their size.
    peak, time : float
        Of the first peak, rad and s.
    """
    # An error of the angle is one of the logarithm in proportion to 1 / |θ|.
    slope, _ = np.polyfit(np.arange(size.size), np.log(energy), 1, w=size)
    values = dict.fromkeys((*ALWAYS, *OPTIONAL), 0.0)
    return values | {"restitution": log(min(max(exp(slope / 2), 0.3), 0.9999)), "peak": peak, "time": time}


@lru_cache(maxsize=16)
def _of_sides(block: Block) -> tuple[Array, Array]:
    """Critical angles (rad) and p (rad/s) of the sides θ < 0 and θ > 0, each shape (2,)."""
    sides = block.sides
    return np.array([side.critical_angle for side in sides]), np.array([block.side_p(side) for side in sides])


@dataclass(frozen=True)
class Decay:
    """
    Unknowns of a free rocking, and what is known of it.

    Attributes
    ----------
    values : dict of str to float
        By name, of all of `ALWAYS` and `OPTIONAL`.
    side : int
        Of the first peak: 0 for θ < 0, 1 for θ > 0.
    count : int
        Number of arcs.
    block : Block
    linearised : bool
    deviations : ndarray, shape (count − 1,), optional
        ln e of each impact less their mean's; zero beyond its end.
    """

    values: dict[str, float]
    side: int
    count: int
    block: Block
    linearised: bool
    deviations: Array = field(default_factory=lambda: np.empty(0))

    def moved(self, steps: dict[str, float]) -> Decay:
        """Return the decay with steps added to its unknowns."""
        return replace(self, values={name: value + steps.get(name, 0.0) for name, value in self.values.items()})

    @cached_property
    def sides(self) -> NDArray[np.int_]:
        """Side of each arc, shape (count,), 0 or 1 as `side`."""
        return (self.side + np.arange(self.count)) % 2

    @cached_property
    def critical(self) -> Array:
        """Critical angles of the sides θ < 0 and θ > 0, rad, shape (2,)."""
        return np.asarray(_of_sides(self.block)[0] * exp(self.values["critical_angle"]))

    @cached_property
    def p(self) -> Array:
        """Frequency parameters of both sides, rad/s, shape (2,)."""
        return np.asarray(_of_sides(self.block)[1] * exp(self.values["p"]))

    def arcs(self) -> tuple[Array, Array, Array]:
        """Peaks (|θ|, rad), their times and the ends of the arcs (s), shape (count,)."""
        return self._arcs

    @cached_property
    def _arcs(self) -> tuple[Array, Array, Array]:
        return free_arcs(
            np.exp(self.values["restitution"] + self.by_impact),
            self.values["peak"],
            self.values["time"],
            self.side,
            self.critical,
            self.p,
            self.count,
            self.linearised,
        )

    def angle(self, time: Array) -> tuple[Array, Array, NDArray[np.int64]]:
        """Angle (rad), its sensitivity to the unknowns of its arc, and the number of that arc, at times (s)."""
        return angle_and_sensitivity(
            time,
            *self.arcs(),
            self.side,
            self.values["zero_offset"],
            self.critical,
            self.p,
            self.linearised,
        )

    def angle_alone(self, time: Array) -> Array:
        """Angle at times (s), rad."""
        return angle_of_arcs(
            time,
            *self.arcs(),
            self.side,
            self.values["zero_offset"],
            self.critical,
            self.p,
            self.linearised,
        )

    def derivatives(self, names: tuple[str, ...]) -> Array:
        """Derivatives of the unknowns of each arc with respect to those named, shape (count, 5, len(names))."""
        result = np.zeros((self.count, LOCAL, len(names)))
        for column, name in enumerate(names):
            if name == "zero_offset":
                result[:, 2, column] = 1.0
            elif name == "time":
                result[:, 1, column] = 1.0
            elif name == "restitution":
                # Of that of each impact before the arc there is as much as there are impacts.
                by_energy, longer = self._by_energy
                impacts = np.arange(self.count)
                result[:, 0, column] = impacts * by_energy
                result[:, 1, column] = 2 * np.cumsum(impacts * longer) - impacts * longer
            elif name == "peak":
                by_energy, longer = self._by_energy
                result[:, 0, column] = by_energy / by_energy[0]
                result[:, 1, column] = (2 * np.cumsum(longer) - longer - longer[0]) / by_energy[0]
            else:
                (high, late, _), (low, early, _) = (self.moved({name: step}).arcs() for step in (STEP, -STEP))
                result[:, 0, column] = (high - low) / (2 * STEP)
                result[:, 1, column] = (late - early) / (2 * STEP)
                result[:, 3 + OPTIONAL.index(name), column] = 1.0
        return result

    @cached_property
    def _by_energy(self) -> tuple[Array, Array]:
        """Change of each arc's peak (rad), and of half its duration (s), by half of ln of its energy."""
        return changes_by_energy(self.arcs()[0], self.side, self.critical, self.p, self.linearised)

    def derivatives_by_impact(self) -> tuple[Array, Array]:
        """Derivatives of each arc's peak (rad) and of its time (s) by ln e of each impact, shape (count, count − 1)."""
        by_energy, longer = self._by_energy
        later = np.tri(self.count, self.count - 1, -1)
        half_longer = later * longer[:, None]
        return later * by_energy[:, None], 2 * np.cumsum(half_longer, axis=0) - half_longer

    def moved_by_impact(self, steps: dict[str, float], deviations: Array) -> Decay:
        """Return the decay with steps added to its unknowns, and to ln e of each impact, shape (count − 1,)."""
        return replace(self.moved(steps), deviations=self.by_impact + deviations)

    @cached_property
    def by_impact(self) -> Array:
        """`deviations` of all impacts, shape (count − 1,)."""
        return np.concatenate((self.deviations, np.zeros(self.count)))[: self.count - 1]

    def followed(self, time: Array) -> tuple[Array, NDArray[np.int64]]:
        """Angle at times (s), rad, shape (n,), and the number of the arc of each."""
        angle, _, arc = self.angle(time)
        return angle, arc

    def jacobian(self, time: Array, names: tuple[str, ...]) -> tuple[Array, Array]:
        """Derivatives of the angle by the unknowns named, shape (n, k), and by ln e of each impact, (n, count − 1)."""
        _, sensitivity, arc = self.angle(time)
        fixed = np.einsum("nl,nlk->nk", sensitivity, self.derivatives(names)[arc])
        return fixed, _by_impact(sensitivity, arc, *self.derivatives_by_impact())

    def normal_equations(
        self, time: Array, residual: Array, further: Array, names: tuple[str, ...]
    ) -> tuple[Array, Array]:
        """
        Sum products of the derivatives of the angle over the samples counted.

        Parameters
        ----------
        time, residual : ndarray, shape (n,)
            s; rad, NaN where not counted.
        further : ndarray, shape (n,)
            A column that comes between the derivatives by the unknowns named and those by ln e of each impact.
        names : tuple of str

        Returns
        -------
        products : ndarray, shape (k + count, k + count)
        gradient : ndarray, shape (k + count,)
            Products with the residual.
        """
        _, sensitivity, arc = self.angle(time)
        local = np.column_stack((sensitivity, further))
        products, gradients = normal_equations(local, residual, arc, self.count)
        unknowns = len(names)
        derivatives = np.zeros((self.count, LOCAL + 1, unknowns + self.count))
        derivatives[:, :LOCAL, :unknowns] = self.derivatives(names)
        derivatives[:, LOCAL, unknowns] = 1.0
        derivatives[:, 0, unknowns + 1 :], derivatives[:, 1, unknowns + 1 :] = self.derivatives_by_impact()
        flat = derivatives.reshape(-1, unknowns + self.count)
        return flat.T @ (products @ derivatives).reshape(flat.shape), flat.T @ gradients.ravel()

    def landing_speeds(self) -> Array:
        """Angular velocity at the end of each arc, before the impact, rad/s, shape (count,)."""
        peaks, _, _ = self.arcs()
        critical, p = self.critical[self.sides], self.p[self.sides]
        if self.linearised:
            return np.asarray(p * np.sqrt(2 * peaks * (critical - peaks / 2)))
        return np.asarray(p * np.sqrt(2 * lift(peaks, critical)))


@kernel
def _by_impact(sensitivity: Array, arc: NDArray[np.int64], by_peak: Array, by_time: Array) -> Array:
    """Derivatives of the angle by ln e of each impact, shape (n, m), from those of the peak and time of each arc."""
    derivatives = np.zeros((by_peak.shape[1], arc.size))
    for m in range(by_peak.shape[1]):
        # Only what follows an impact depends on its e.
        for n in range(np.searchsorted(arc, m + 1), arc.size):
            derivatives[m, n] = sensitivity[n, 0] * by_peak[arc[n], m] + sensitivity[n, 1] * by_time[arc[n], m]
    return derivatives.T
