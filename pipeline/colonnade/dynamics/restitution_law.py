"""Restitution that depends on the speed of the impact, as a table for the kernels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided
from colonnade.validation import described, number, samples, sided

POINTS = 1025
"""Of a table made from a function."""


@dataclass(frozen=True, eq=False)
class RestitutionLaw:
    """
    Coefficient of restitution over the speed of the impact, linear between its points.

    Attributes
    ----------
    speeds : ndarray, shape (m,)
        |ω| just before an impact, rad/s, rising; below the first and above the last e stays as it is there.
    values : ndarray, shape (m,)
        e at these speeds, between 0 and 1, for both sides of the block.
    function : callable, optional
        What the table was made from, float to float.

    Examples
    --------
    >>> law = RestitutionLaw.table([0.0, 1.0], [1.0, 0.9])
    >>> float(law(0.5)), float(law(3.0))
    (0.95, 0.9)
    >>> falling = RestitutionLaw.of(lambda speed: 0.95 - 0.01 * speed, largest_speed=2.0)
    >>> round(float(falling(1.0)), 3), float(falling.reaching(np.array([3.0])).speeds[-1])
    (0.94, 6.0)
    """

    speeds: Array
    values: Array
    function: Callable[[float], float] | None = None

    def __post_init__(self) -> None:
        for name in ("speeds", "values"):
            samples(name, getattr(self, name), dimensions=(0, 1, 2), fewest=0, finite=False)
        if not (self.function is None or callable(self.function)):
            raise ValueError(f"function is {described(self.function)}; a function of the speed, or None, was expected")
        if self.speeds.ndim != 1 or self.speeds.size == 0 or self.speeds.shape != self.values.shape:
            raise ValueError(
                f"A restitution law has speeds of shape {self.speeds.shape} and values of shape {self.values.shape}; "
                "one value for each of at least one speed was expected"
            )
        if not (np.isfinite(self.speeds).all() and self.speeds[0] >= 0.0 and (np.diff(self.speeds) > 0.0).all()):
            raise ValueError("The speeds of a restitution law have to be rising numbers from 0 rad/s on")
        wrong = ~((self.values >= 0.0) & (self.values <= 1.0))
        if wrong.any():
            first = int(np.argmax(wrong))
            raise ValueError(
                f"The values of the restitution law give e = {self.values[first]} at {self.speeds[first]:g} rad/s; "
                "a number between 0 and 1 was expected"
            )

    @classmethod
    def table(cls, speeds: ArrayLike, values: ArrayLike) -> RestitutionLaw:
        """
        Build a law from points.

        Parameters
        ----------
        speeds : array_like, shape (m,)
            |ω| just before an impact, rad/s, rising.
        values : array_like, shape (m,)
            e at these speeds, between 0 and 1.

        Returns
        -------
        law : RestitutionLaw

        Raises
        ------
        ValueError
            If speeds do not rise from 0 or above, a value is not between 0 and 1, or their numbers differ.
        """
        return cls(samples("speeds", speeds, fewest=0, finite=False), samples("values", values, fewest=0, finite=False))

    @classmethod
    def of(cls, function: Callable[[float], float], *, largest_speed: float) -> RestitutionLaw:
        """
        Sample a function of the speed at `POINTS` equal steps.

        Parameters
        ----------
        function : callable
            Gives e, between 0 and 1, of |ω| just before an impact, rad/s.
        largest_speed : float
            Up to which it is sampled from 0, rad/s.

        Returns
        -------
        law : RestitutionLaw

        Raises
        ------
        ValueError
            If the function gives a value that is not between 0 and 1.

        Notes
        -----
        Between the points e is off by at most step² |e''| / 8.
        """
        if not callable(function):
            raise ValueError(f"function is {described(function)}; a function of the speed (rad/s) was expected")
        largest = number("largest_speed", largest_speed, "a positive number of rad/s", above=0.0)
        speeds = np.linspace(0.0, largest, POINTS)
        values = [number("restitution", function(float(speed)), "a number from the function") for speed in speeds]
        return cls(speeds, np.array(values), function)

    def reaching(self, velocities: Array) -> RestitutionLaw:
        """
        Return this law, or the same function sampled further if a velocity is beyond its last point.

        Parameters
        ----------
        velocities : ndarray, shape (n,)
            ω just before impacts, rad/s.

        Returns
        -------
        law : RestitutionLaw
            It reaches to twice the largest of them.
        """
        largest = float(np.abs(samples("velocities", velocities, fewest=0)).max(initial=0.0))
        if self.function is None or not largest > self.speeds[-1]:
            return self
        return RestitutionLaw.of(self.function, largest_speed=2.0 * largest)

    def __call__(self, speed: ArrayLike) -> Array:
        """Give e at |ω| (rad/s), shape of `speed`."""
        speeds = samples("speed", speed, dimensions=(0, 1, 2, 3), fewest=0)
        return np.asarray(np.interp(speeds, self.speeds, self.values), dtype=np.float64)


Given = Sided | RestitutionLaw | Callable[[float], float] | None
"""e as it may be given: one value, a pair, a law or a function of the speed; None for the rigid-body value."""

Restitution = tuple[float, float] | RestitutionLaw
"""e of impacts that end an arc at θ < 0, and at θ > 0; or e over the speed of the impact."""


def law_of(block: Block, restitution: Given, largest_speed: float | None = None) -> Restitution:
    """
    Put e into the form that the kernels take; a function is sampled up to a speed (rad/s), by default a few times that
    of a fall from α. ValueError if e is not between 0 and 1.
    """
    if isinstance(restitution, RestitutionLaw):
        return restitution
    if callable(restitution):
        return RestitutionLaw.of(restitution, largest_speed=largest_speed or 4.0 * block.p * block.critical_angle)
    given = block.restitution if restitution is None else restitution
    return sided("restitution", given, "a number between 0 and 1", low=0.0, high=1.0)


def restitution_table(restitution: Restitution) -> tuple[Array, Array]:
    """Give e as the kernels take it: speeds, shape (m,), and e there on the one side and then on the other, (2 m,)."""
    if isinstance(restitution, RestitutionLaw):
        return restitution.speeds, np.tile(restitution.values, 2)
    return np.zeros(1), np.array(restitution)
