"""The coefficient of restitution as the models take it: one value, one a side, or over the speed of the impact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided
from colonnade.validation import samples, sided


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

    Examples
    --------
    >>> law = RestitutionLaw.table([0.0, 1.0], [1.0, 0.9])
    >>> float(law(0.5)), float(law(3.0))
    (0.95, 0.9)
    """

    speeds: Array
    values: Array

    def __post_init__(self) -> None:
        for name in ("speeds", "values"):
            samples(name, getattr(self, name), fewest=0, finite=False)
        if self.speeds.size == 0 or self.speeds.shape != self.values.shape:
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

    def __call__(self, speed: ArrayLike) -> Array:
        """Give e at |ω| (rad/s), shape of `speed`."""
        speeds = samples("speed", speed, dimensions=(0, 1, 2, 3), fewest=0)
        return np.asarray(np.interp(speeds, self.speeds, self.values), dtype=np.float64)


Given = Sided | RestitutionLaw | None
"""e as it may be given: one value, a pair, or a law; None for the rigid-body value."""


def of_sides(block: Block, restitution: Sided | None) -> tuple[float, float]:
    """Give e of impacts that end an arc at θ < 0, and at θ > 0; ValueError if it is not between 0 and 1."""
    given = block.restitution if restitution is None else restitution
    return sided("restitution", given, "a number between 0 and 1", low=0.0, high=1.0)
