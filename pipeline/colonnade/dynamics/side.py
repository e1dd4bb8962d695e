"""What a block is to each edge of its base, and to motion in space."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin, sqrt
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.validation import described, instance, number, samples

LEAST, LARGEST = 1e-60, 1e60
"""Of a length, a mass or an inertia in SI: products of several stay in the range of floating-point numbers."""


@dataclass(frozen=True)
class Side:
    """
    The block as it rocks about one edge of its base.

    Attributes
    ----------
    critical_angle : float
        α, rad: the rotation that brings the centre of mass above the pole.
    pole_distance : float
        R, m, from the pole to the centre of mass.
    inertia : float
        I₀, kg m², about the pole.
    """

    critical_angle: float
    pole_distance: float
    inertia: float

    def __post_init__(self) -> None:
        number("critical_angle", self.critical_angle, "an angle between 0 and π/2 rad", above=0.0, below=pi / 2)
        expect_positive(pole_distance=self.pole_distance, inertia=self.inertia)

    @property
    def half_width(self) -> float:
        """Distance b = R sin α of the pole from the vertical through the centre of mass, m."""
        return self.pole_distance * sin(self.critical_angle)


@dataclass(frozen=True)
class Solid:
    """
    What plane rocking does not ask of a block, but motion in space does.

    Attributes
    ----------
    base : {"rectangle", "circle"}
    half_depth : float
        m, along y; of a round base its radius.
    inertia_x, inertia_z : float
        kg m², about the axes through the centre of mass.
    """

    base: Literal["rectangle", "circle"]
    half_depth: float
    inertia_x: float
    inertia_z: float

    def __post_init__(self) -> None:
        if self.base not in ("rectangle", "circle"):
            raise ValueError(f'base is {described(self.base)}; "rectangle" or "circle" was expected')
        expect_positive(half_depth=self.half_depth, inertia_x=self.inertia_x, inertia_z=self.inertia_z)


@dataclass(frozen=True)
class TwoSided:
    """
    What follows for a block from its two sides.

    Attributes
    ----------
    mass : float
        kg.
    gravity : float
        m/s².
    negative, positive : Side
        Rocking at θ < 0 (about the pole at −x) and at θ > 0 (about the pole at +x).
    """

    mass: float
    gravity: float
    negative: Side
    positive: Side

    @property
    def sides(self) -> tuple[Side, Side]:
        """`negative` and `positive`, in this order."""
        return self.negative, self.positive

    @property
    def governing(self) -> Side:
        """The side with the smaller critical angle."""
        return min(self.sides, key=lambda side: side.critical_angle)

    @property
    def is_symmetric(self) -> bool:
        """Whether both sides are the same."""
        return self.negative == self.positive

    @property
    def critical_angle(self) -> float:
        """Critical angle α of the governing side, rad."""
        return self.governing.critical_angle

    @property
    def pole_distance(self) -> float:
        """Pole distance R of the governing side, m."""
        return self.governing.pole_distance

    @property
    def inertia(self) -> float:
        """Inertia I₀ about the pole of the governing side, kg m²."""
        return self.governing.inertia

    @property
    def p(self) -> float:
        """Frequency parameter p = sqrt(m g R / I₀) of the governing side, rad/s."""
        return self.side_p(self.governing)

    def side_p(self, side: Side) -> float:
        """
        Frequency parameter of one side.

        Parameters
        ----------
        side : Side
            One of `sides`.

        Returns
        -------
        p : float
            sqrt(m g R / I₀), rad/s.
        """
        instance("side", side, Side)
        return sqrt(self.mass * self.gravity * side.pole_distance / side.inertia)

    def critical_angle_at(self, angle: ArrayLike) -> Array:
        """
        Critical angle of the side that each angle is on.

        Parameters
        ----------
        angle : array_like
            θ, rad; an angle of 0 or NaN counts as θ > 0.

        Returns
        -------
        critical_angle : ndarray, shape of `angle`
            α, rad.
        """
        return self._at(angle, *(side.critical_angle for side in self.sides))

    def pole_distance_at(self, angle: ArrayLike) -> Array:
        """
        Pole distance of the side that each angle is on.

        Parameters
        ----------
        angle : array_like
            θ, rad; an angle of 0 or NaN counts as θ > 0.

        Returns
        -------
        pole_distance : ndarray, shape of `angle`
            R, m.
        """
        return self._at(angle, *(side.pole_distance for side in self.sides))

    def p_at(self, angle: ArrayLike) -> Array:
        """
        Frequency parameter of the side that each angle is on.

        Parameters
        ----------
        angle : array_like
            θ, rad; an angle of 0 or NaN counts as θ > 0.

        Returns
        -------
        p : ndarray, shape of `angle`
            rad/s.
        """
        return self._at(angle, *(self.side_p(side) for side in self.sides))

    @staticmethod
    def _at(angle: ArrayLike, negative: float, positive: float) -> Array:
        plain = samples("angle", angle, dimensions=(0, 1, 2), fewest=0, finite=False)
        return np.where(plain < 0, negative, positive)

    @property
    def restitution(self) -> float:
        """Rigid-body coefficient of restitution without bounce, e = 1 − (2 m R b / I₀) sin α (Housner 1963)."""
        side = self.governing
        return 1 - 2 * self.mass * side.pole_distance * side.half_width / side.inertia * sin(side.critical_angle)

    @property
    def uplift_acceleration(self) -> float:
        """Base acceleration g tan α above which the block starts to rock, m/s²."""
        return self.gravity * sin(self.critical_angle) / cos(self.critical_angle)


def expect_positive(**values: float) -> None:
    """Refuse a length, a mass, an inertia or gravity that is not positive, by its name."""
    for name, value in values.items():
        number(name, value, "a positive number", above=0.0)
        if not LEAST <= value <= LARGEST:
            raise ValueError(f"{name} is {value:g}; a number from {LEAST:g} to {LARGEST:g} was expected")
