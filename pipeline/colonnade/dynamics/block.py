"""The free-standing block: its critical angle, pole distance, inertia and rigid-body restitution."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.units.text import Digested
from colonnade.validation import instance, number, samples, sided, whole

STANDARD_GRAVITY = 9.81
"""Default gravity of a campaign, m/s²; a laboratory's own value may be given."""

Sided = float | tuple[float, float]
"""One value for both sides, or a pair (for θ < 0, for θ > 0)."""

MOST_COLUMNS = 1000
"""Of a frame or a colonnade."""
LEAST, LARGEST = 1e-60, 1e60
"""Of a length, a mass or an inertia in SI: products of several stay in the range of floating-point numbers."""


@dataclass(frozen=True)
class Side:
    """The block as it rocks about one edge of its base."""

    critical_angle: float
    """α, rad: the rotation that brings the centre of mass above the pole."""
    pole_distance: float
    """R, m, from the pole to the centre of mass."""
    inertia: float
    """I₀, kg m², about the pole."""

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
    half_depth, height : float
        m, along y, of a round base its radius; from the base to the top.
    inertia_x, inertia_z : float
        kg m², about the axes through the centre of mass.
    top : (float, float)
        m, half width and half depth of the flat top, on which other blocks may stand; of a round one its radius, twice.
    """

    base: Literal["rectangle", "circle"]
    half_depth: float
    inertia_x: float
    inertia_z: float
    height: float
    top: tuple[float, float]

    def is_uniform(self, side: Side, mass: float) -> bool:
        """Whether a side is that of an upright prism or cylinder of uniform density."""
        half_width, square = self.top[0], 4 / 3 if self.base == "rectangle" else 5 / 4
        inertia = mass * (square * half_width**2 + self.height**2 / 3)
        found = side.half_width, side.pole_distance * cos(side.critical_angle), side.inertia
        return np.allclose(found, (half_width, self.height / 2, inertia), atol=0.0)


@dataclass(frozen=True, repr=False)
class Block(Digested):
    """
    A rigid block that rocks in the plane x–z about the two edges of its base. Its α, R, I₀, p and e are those of the
    governing side, the one with the smaller critical angle.

    Attributes
    ----------
    mass : float
        kg; of a frame that of its columns and its beam.
    gravity : float
        m/s².
    negative, positive : Side
        Rocking at θ < 0 (about the pole at −x) and at θ > 0 (about the pole at +x). Equal for a symmetric block.
    solid : Solid or None
        For motion in space; None if only plane quantities are known. Not compared: plane rocking is the same.
    beam_ratio : float
        γ, dimensionless: mass of the beam over that of all columns of a frame; 0 for a block. The pole
        distance of a frame is that of a column, its inertia that of all columns and, at 2 R, the beam.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> round(block.critical_angle, 4), round(block.pole_distance, 4), round(block.inertia, 4)
    (0.1864, 0.232, 1.8734)
    >>> round(block.p, 3), round(block.restitution, 4), round(block.uplift_acceleration, 3), block.is_symmetric
    (5.631, 0.9485, 1.85, True)
    >>> uneven = Block.measured(mass=26.1, pole_distance=0.232, critical_angle=(0.18, 0.19), inertia=1.873)
    >>> uneven.governing.critical_angle, uneven.critical_angle_at([-0.1, 0.1]).tolist()
    (0.18, [0.18, 0.19])
    >>> uneven.sides == (uneven.negative, uneven.positive), round(uneven.side_p(uneven.positive), 3)
    (True, 5.632)
    >>> uneven.p_at([-0.1, 0.1]).round(3).tolist()
    [5.632, 5.632]
    >>> Block.cylinder(diameter=0.1, height=0.5, mass=30.0)
    <Block: critical_angle 0.1974 rad, p 5.378 rad/s, restitution 0.9422, mass 30 kg, is_symmetric True>
    """

    _ESSENCE = "critical_angle rad, p rad/s, restitution, mass kg, is_symmetric"

    mass: float
    gravity: float
    negative: Side
    positive: Side
    solid: Solid | None = field(default=None, compare=False)
    beam_ratio: float = 0.0

    def __post_init__(self) -> None:
        expect_positive(mass=self.mass, gravity=self.gravity)
        instance("negative", self.negative, Side)
        instance("positive", self.positive, Side)
        if self.solid is not None:
            instance("solid", self.solid, Solid)
        number("beam_ratio", self.beam_ratio, "a share of the mass of the columns from 0 on", low=0.0, high=LARGEST)

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
            sqrt(m g R / I₀), rad/s; the beam of a frame, which rises twice as far, counts twice in m.
        """
        instance("side", side, Side)
        return sqrt(self._mass_at(1) * self.gravity * side.pole_distance / side.inertia)

    def _mass_at(self, power: float) -> float:
        """Mass by its distance from the pole to a power: that of a frame's beam is 2 R."""
        return self.mass * (1 + float(2**power) * self.beam_ratio) / (1 + self.beam_ratio)

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

    def p_at(self, angle: ArrayLike) -> Array:
        """
        Frequency parameter p of the side that each angle is on, as `critical_angle_at`.

        Parameters
        ----------
        angle : array_like
            θ, rad.

        Returns
        -------
        p : ndarray
            rad/s.
        """
        return self._at(angle, *(self.side_p(side) for side in self.sides))

    @staticmethod
    def _at(angle: ArrayLike, negative: float, positive: float) -> Array:
        plain = samples("angle", angle, dimensions=(0, 1, 2), fewest=0, finite=False)
        return np.where(plain < 0, negative, positive)

    @property
    def restitution(self) -> float:
        """
        Rigid-body coefficient of restitution without bounce, e = 1 − (2 m R b / I₀) sin α (Housner 1963).

        At least 0: where the formula is negative, the block stands after one impact. For a frame see `frame`.
        """
        side = self.governing
        lost = 2 * self._mass_at(2) * side.pole_distance * side.half_width / side.inertia * sin(side.critical_angle)
        return max(1 - lost, 0.0)

    @property
    def uplift_acceleration(self) -> float:
        """Base acceleration g tan α above which the block starts to rock, m/s²."""
        return self.gravity * sin(self.critical_angle) / cos(self.critical_angle)

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
        mass, gravity : float
            kg; m/s².

        Returns
        -------
        block : Block

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.
        """
        expect_positive(width=width, depth=depth, height=height, mass=mass, gravity=gravity)
        half_width, centre_height = width / 2, height / 2
        inertia = mass * (width**2 + height**2) / 12 + mass * (half_width**2 + centre_height**2)
        about_x, about_z = mass * (depth**2 + height**2) / 12, mass * (width**2 + depth**2) / 12
        solid = Solid("rectangle", depth / 2, about_x, about_z, height, (half_width, depth / 2))
        return cls._symmetric(half_width, centre_height, inertia, mass, gravity, solid)

    @classmethod
    def cylinder(cls, *, diameter: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY) -> Block:
        """
        Build a solid upright cylinder that rocks about its base circle; errors are those of `prism`.

        Parameters
        ----------
        diameter, height, mass, gravity : float
            m, m, kg and m/s².

        Returns
        -------
        block : Block

        Examples
        --------
        >>> round(Block.cylinder(diameter=0.097, height=0.456, mass=26.0).restitution, 4)
        0.9349
        """
        expect_positive(diameter=diameter)
        return cls.cone(base_diameter=diameter, top_diameter=diameter, height=height, mass=mass, gravity=gravity)

    @classmethod
    def cone(
        cls, *, base_diameter: float, top_diameter: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY
    ) -> Block:
        """
        Build a solid truncated cone, standing on the circle of `base_diameter`; errors are those of `prism`.

        Parameters
        ----------
        base_diameter, top_diameter, height, mass, gravity : float
            m, m, m, kg and m/s².

        Returns
        -------
        block : Block

        Notes
        -----
        The radius r changes linearly: centre of mass ∫z r² / ∫r², inertia about the base ∫(r⁴/4 + z² r²) / ∫r².

        Examples
        --------
        >>> round(Block.cone(base_diameter=0.12, top_diameter=0.08, height=0.456, mass=26.0).p, 3)
        5.812
        """
        expect_positive(
            base_diameter=base_diameter, top_diameter=top_diameter, height=height, mass=mass, gravity=gravity
        )
        base, top = base_diameter / 2, top_diameter / 2
        area = (base**2 + base * top + top**2) / 3
        first = height * (base**2 + 2 * base * top + 3 * top**2) / 12
        second = height**2 * (base**2 + 3 * base * top + 6 * top**2) / 30
        fourth = (base**4 + base**3 * top + base**2 * top**2 + base * top**3 + top**4) / 20
        inertia = mass * ((fourth + second) / area + base**2)
        transverse = mass * ((fourth + second) / area - (first / area) ** 2)
        solid = Solid("circle", base, transverse, 2.0 * mass * fourth / area, height, (top, top))
        return cls._symmetric(base, first / area, inertia, mass, gravity, solid)

    @classmethod
    def _symmetric(
        cls, half_width: float, centre_height: float, inertia: float, mass: float, gravity: float, solid: Solid
    ) -> Block:
        side = Side(atan2(half_width, centre_height), hypot(half_width, centre_height), inertia)
        return cls(mass, gravity, side, side, solid)

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
        mass, gravity : float
            kg; m/s².
        pole_distance, critical_angle, inertia : float or pair of float
            R in m, α in rad, I₀ in kg m² about the pole; a pair is (for θ < 0, for θ > 0).

        Returns
        -------
        block : Block

        Raises
        ------
        ValueError
            If a value is out of its range, or the inertia less than that of the mass alone at the pole distance.
        """
        given = {"critical_angle": critical_angle, "pole_distance": pole_distance, "inertia": inertia}
        pairs = [sided(name, value, "a positive number", above=0.0) for name, value in given.items()]
        negative, positive = (Side(*values) for values in zip(*pairs, strict=True))
        block = cls(mass, gravity, negative, positive)
        for side in block.sides:
            least = mass * side.pole_distance**2
            if side.inertia < 0.9 * least:  # no body has less, whatever the errors of measurement
                raise ValueError(
                    f"inertia is {side.inertia:g} kg m² with a pole_distance of {side.pole_distance:g} m and a mass of "
                    f"{mass:g} kg; at least m R² = {least:.4g} kg m² was expected. Is the pole distance in m, and the "
                    "inertia that about the pole?"
                )
        return block

    @classmethod
    def frame(cls, column: Block, *, beam_mass: float, columns: int = 2) -> Block:
        """
        Build equal columns under a rigid beam that lies freely on them, which rock as one block.

        Parameters
        ----------
        column : Block
            One of the columns, made by `prism` or `cylinder`.
        beam_mass : float
            kg, from 0.
        columns : int, optional
            Their number, from 1.

        Returns
        -------
        block : Block
            Its angle is that of every column.

        Raises
        ------
        ValueError
            If the column is a cone, is measured or has unequal sides, or a number is out of its range.

        Notes
        -----
        A column that turns about an edge of its base carries the beam, which does not turn, on the opposite edge of its
        top, 2 R from the pole. With γ its mass over that of all columns, and m, R, I₀ of one, the frame is a block of
        the same α with p̂ = p sqrt((1 + 2γ)/(1 + 4γ m R²/I₀)) (Makris and Vassiliou 2013). At an impact the angular
        momentum of a column and its share of the beam about the new pole is kept: (I₀ − 2 m R² sin²α + 4γ m R² cos 2α)ω
        before, (I₀ + 4γ m R²) ω after, so that e = 1 − 2 (1 + 4γ) m R² sin²α/(I₀ + 4γ m R²).

        Examples
        --------
        >>> column = Block.prism(width=0.9, depth=0.9, height=6.0, mass=12000.0)
        >>> frame = Block.frame(column, beam_mass=24000.0, columns=2)
        >>> round(frame.p / column.p, 4), round(column.restitution, 4), round(frame.restitution, 4)
        (0.866, 0.967, 0.9587)
        """
        instance("column", column, Block)
        mass = number("beam_mass", beam_mass, "a mass in kg from 0 on", low=0.0, high=LARGEST)
        count = whole("columns", columns, 1, MOST_COLUMNS)
        side, solid = column.negative, column.solid
        if solid is None or not column.is_symmetric or not solid.is_uniform(side, column.mass):
            raise ValueError(
                "column is not an upright prism or cylinder of uniform density: a block of `Block.prism` or "
                "`Block.cylinder` was expected, as a beam on a cone or a measured body lies at another distance"
            )
        ratio = mass / (count * column.mass)
        inertia = count * (side.inertia + 4 * ratio * column.mass * side.pole_distance**2)
        both = replace(side, inertia=inertia)
        return cls(count * column.mass + mass, column.gravity, both, both, beam_ratio=ratio)

    def override(
        self,
        *,
        critical_angle: Sided | None = None,
        pole_distance: Sided | None = None,
        inertia: Sided | None = None,
    ) -> Block:
        """
        Return a block in which measured values, where given, replace the ones computed from dimensions.

        Parameters
        ----------
        critical_angle, pole_distance, inertia : float or pair of float, optional
            α in rad, R in m, I₀ in kg m² about the pole; a pair is (for θ < 0, for θ > 0).

        Returns
        -------
        block : Block

        Examples
        --------
        >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
        >>> round(block.override(inertia=1.9).p, 3)
        5.592
        """
        given = {"critical_angle": critical_angle, "pole_distance": pole_distance, "inertia": inertia}
        negative, positive = self.sides
        for name, value in given.items():
            if value is not None:
                left, right = sided(name, value, "a positive number", above=0.0)
                negative, positive = replace(negative, **{name: left}), replace(positive, **{name: right})
        return replace(self, negative=negative, positive=positive)


def expect_positive(**values: float) -> None:
    """Refuse a length, a mass, an inertia or gravity that is not positive, by its name."""
    for name, value in values.items():
        number(name, value, f"a positive number from {LEAST:g} to {LARGEST:g}", low=LEAST, high=LARGEST)


def pair(value: Sided) -> tuple[float, float]:
    """Spread one value to both sides, or pass a pair through."""
    return sided("value", value, "a number")
