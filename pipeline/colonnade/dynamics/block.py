"""The free-standing block: its critical angle, pole distance, inertia and rigid-body restitution."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.density import cone_volume, expect_inertia, expect_metres, prism_volume
from colonnade.validation import described, instance, number, samples, sided

STANDARD_GRAVITY = 9.81
"""Default gravity of a campaign, m/s²; a laboratory's own value may be given."""

LEAST, LARGEST = 1e-60, 1e60
"""Of a length, a mass or an inertia in SI: products of several stay in the range of floating-point numbers."""

Sided = float | tuple[float, float]
"""One value for both sides, or a pair (for θ < 0, for θ > 0)."""


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
        _positive(pole_distance=self.pole_distance, inertia=self.inertia)

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
        _positive(half_depth=self.half_depth, inertia_x=self.inertia_x, inertia_z=self.inertia_z)


@dataclass(frozen=True)
class Block:
    """
    A rigid block that rocks in the plane x–z about the two edges of its base.

    Attributes
    ----------
    mass : float
        kg.
    gravity : float
        m/s².
    negative, positive : Side
        Rocking at θ < 0 (about the pole at −x) and at θ > 0 (about the pole at +x). Equal for a symmetric block.
    solid : Solid or None
        For motion in space; None if only plane quantities are known. Not compared: plane rocking is the same.

    Notes
    -----
    `critical_angle`, `pole_distance`, `inertia`, `p` and `restitution` are those of the governing side, the one with
    the smaller critical angle; for a symmetric block both are the same.
    """

    mass: float
    gravity: float
    negative: Side
    positive: Side
    solid: Solid | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        _positive(mass=self.mass, gravity=self.gravity)
        instance("negative", self.negative, Side)
        instance("positive", self.positive, Side)
        if self.solid is not None:
            instance("solid", self.solid, Solid)

    @classmethod
    def prism(
        cls, *, width: float, depth: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY
    ) -> Block:
        """
        Build a solid rectangular block of uniform density.

        Parameters
        ----------
        width, depth, height : float
            Along x, y, z, m. The depth does not enter plane rocking.
        mass : float
            kg.
        gravity : float, optional
            m/s².

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.

        Warns
        -----
        UnlikelyBlockWarning
            If the lengths look as if they were in millimetres or centimetres.
        """
        _positive(width=width, depth=depth, height=height, mass=mass, gravity=gravity)
        expect_metres(mass / prism_volume(width, depth, height), width / height, width=width, height=height)
        half_width, centre_height = width / 2, height / 2
        inertia = mass * (width**2 + height**2) / 12 + mass * (half_width**2 + centre_height**2)
        solid = Solid("rectangle", depth / 2, mass * (depth**2 + height**2) / 12, mass * (width**2 + depth**2) / 12)
        return cls._symmetric(half_width, centre_height, inertia, mass, gravity, solid)

    @classmethod
    def cylinder(cls, *, diameter: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY) -> Block:
        """
        Build a solid upright cylinder that rocks about its base circle; lengths in m, mass in kg.

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.
        """
        _positive(diameter=diameter, height=height, mass=mass, gravity=gravity)
        expect_metres(
            mass / cone_volume(diameter, diameter, height), diameter / height, diameter=diameter, height=height
        )
        return cls._turned(diameter, diameter, height, mass, gravity)

    @classmethod
    def cone(
        cls, *, base_diameter: float, top_diameter: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY
    ) -> Block:
        """
        Build a solid truncated cone, standing on the circle of `base_diameter`; lengths in m, mass in kg.

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.

        Notes
        -----
        Moments of the cross-sections are integrated over the height, where the radius changes linearly:
        centre of mass ∫z r² / ∫r², transverse inertia about the base ∫(r⁴/4 + z² r²) / ∫r².
        """
        _positive(base_diameter=base_diameter, top_diameter=top_diameter, height=height, mass=mass, gravity=gravity)
        density = mass / cone_volume(base_diameter, top_diameter, height)
        expect_metres(density, base_diameter / height, base_diameter=base_diameter, height=height)
        return cls._turned(base_diameter, top_diameter, height, mass, gravity)

    @classmethod
    def _turned(cls, base_diameter: float, top_diameter: float, height: float, mass: float, gravity: float) -> Block:
        base, top = base_diameter / 2, top_diameter / 2
        area = (base**2 + base * top + top**2) / 3
        first = height * (base**2 + 2 * base * top + 3 * top**2) / 12
        second = height**2 * (base**2 + 3 * base * top + 6 * top**2) / 30
        fourth = (base**4 + base**3 * top + base**2 * top**2 + base * top**3 + top**4) / 20
        inertia = mass * ((fourth + second) / area + base**2)
        transverse = mass * ((fourth + second) / area - (first / area) ** 2)
        solid = Solid("circle", base, transverse, 2.0 * mass * fourth / area)
        return cls._symmetric(base, first / area, inertia, mass, gravity, solid)

    @classmethod
    def measured(
        cls,
        *,
        mass: float,
        pole_distance: Sided,
        critical_angle: Sided,
        inertia: Sided,
        gravity: float = STANDARD_GRAVITY,
    ) -> Block:
        """
        Build a block of any shape from measured properties.

        Parameters
        ----------
        mass : float
            kg.
        pole_distance, critical_angle, inertia : float or pair of float
            R in m, α in rad, I₀ in kg m² about the pole; a pair is (for θ < 0, for θ > 0).
        gravity : float, optional
            m/s².

        Raises
        ------
        ValueError
            If a value is not positive, an angle is not below π/2, or the inertia is smaller than that of the mass
            alone at the pole distance, which no body has.
        """
        _positive(mass=mass, gravity=gravity)
        angles = sided("critical_angle", critical_angle, "an angle between 0 and π/2 rad", above=0.0, below=pi / 2)
        distances = sided("pole_distance", pole_distance, "a positive number", above=0.0)
        inertias = sided("inertia", inertia, "a positive number", above=0.0)
        for distance, about_pole in zip(distances, inertias, strict=True):
            expect_inertia(about_pole, mass, distance)
        negative, positive = (Side(*values) for values in zip(angles, distances, inertias, strict=True))
        return cls(mass, gravity, negative, positive)

    @classmethod
    def _symmetric(
        cls, half_width: float, centre_height: float, inertia: float, mass: float, gravity: float, solid: Solid
    ) -> Block:
        side = Side(atan2(half_width, centre_height), hypot(half_width, centre_height), inertia)
        return cls(mass, gravity, side, side, solid)

    def override(
        self,
        *,
        critical_angle: Sided | None = None,
        pole_distance: Sided | None = None,
        inertia: Sided | None = None,
    ) -> Block:
        """Return a block in which measured values, where given, replace the ones computed from dimensions."""
        sides = []
        for index, side in enumerate(self.sides):
            given = {"critical_angle": critical_angle, "pole_distance": pole_distance, "inertia": inertia}
            changed = {
                name: sided(name, value, "a positive number", above=0.0)[index]
                for name, value in given.items()
                if value is not None
            }
            sides.append(replace(side, **changed))
        return replace(self, negative=sides[0], positive=sides[1])

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
        """Frequency parameter of one side, rad/s."""
        instance("side", side, Side)
        return sqrt(self.mass * self.gravity * side.pole_distance / side.inertia)

    def critical_angle_at(self, angle: ArrayLike) -> Array:
        """Critical angle α of the side that each angle is on, rad; an angle of 0 or NaN counts as θ > 0."""
        return self._at(angle, *(side.critical_angle for side in self.sides))

    def pole_distance_at(self, angle: ArrayLike) -> Array:
        """Pole distance R of the side that each angle is on, m; as `critical_angle_at`."""
        return self._at(angle, *(side.pole_distance for side in self.sides))

    def p_at(self, angle: ArrayLike) -> Array:
        """Frequency parameter p of the side that each angle is on, rad/s; as `critical_angle_at`."""
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


def pair(value: Sided) -> tuple[float, float]:
    """
    Spread one value to both sides, or pass a pair through.

    Examples
    --------
    >>> pair(0.2), pair((0.2, 0.3))
    ((0.2, 0.2), (0.2, 0.3))
    """
    return sided("value", value, "a number")


def _positive(**values: float) -> None:
    for name, value in values.items():
        number(name, value, "a positive number", above=0.0)
        if not LEAST <= value <= LARGEST:
            raise ValueError(f"{name} is {value:g}; a number from {LEAST:g} to {LARGEST:g} was expected")
