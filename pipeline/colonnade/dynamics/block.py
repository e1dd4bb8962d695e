"""The free-standing block: its critical angle, pole distance, inertia and rigid-body restitution."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import atan2, hypot, pi

from colonnade.digest import Digested, written
from colonnade.dynamics.density import cone_volume, expect_inertia, expect_metres, prism_volume
from colonnade.dynamics.side import Side, Solid, TwoSided, expect_positive
from colonnade.validation import instance, sided

STANDARD_GRAVITY = 9.81
"""Default gravity of a campaign, m/s²; a laboratory's own value may be given."""

Sided = float | tuple[float, float]
"""One value for both sides, or a pair (for θ < 0, for θ > 0)."""


@dataclass(frozen=True, repr=False)
class Block(Digested, TwoSided):
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
    >>> uneven.pole_distance_at([-0.1]).tolist(), uneven.p_at([-0.1, 0.1]).round(3).tolist()
    ([0.232], [5.632, 5.632])
    >>> block.digest()["p"]
    '5.631 rad/s'
    """

    solid: Solid | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        expect_positive(mass=self.mass, gravity=self.gravity)
        instance("negative", self.negative, Side)
        instance("positive", self.positive, Side)
        if self.solid is not None:
            instance("solid", self.solid, Solid)

    def digest(self) -> dict[str, str]:
        """
        Return α, R, I₀, p and the rigid-body e of the governing side, and the mass.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        return {
            "α": written(self.critical_angle, "rad"),
            "R": written(self.pole_distance, "m"),
            "I₀": written(self.inertia, "kg m²"),
            "p": written(self.p, "rad/s"),
            "rigid-body e": written(self.restitution),
            "mass": written(self.mass, "kg"),
        } | ({} if self.is_symmetric else {"sides": "differ"})

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

        Returns
        -------
        block : Block

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.

        Warns
        -----
        UnlikelyBlockWarning
            If the lengths look as if they were in millimetres or centimetres.
        """
        expect_positive(width=width, depth=depth, height=height, mass=mass, gravity=gravity)
        expect_metres(mass / prism_volume(width, depth, height), width / height, width=width, height=height)
        half_width, centre_height = width / 2, height / 2
        inertia = mass * (width**2 + height**2) / 12 + mass * (half_width**2 + centre_height**2)
        solid = Solid("rectangle", depth / 2, mass * (depth**2 + height**2) / 12, mass * (width**2 + depth**2) / 12)
        return cls._symmetric(half_width, centre_height, inertia, mass, gravity, solid)

    @classmethod
    def cylinder(cls, *, diameter: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY) -> Block:
        """
        Build a solid upright cylinder that rocks about its base circle.

        Parameters
        ----------
        diameter, height : float
            m.
        mass : float
            kg.
        gravity : float, optional
            m/s².

        Returns
        -------
        block : Block

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.

        Examples
        --------
        >>> round(Block.cylinder(diameter=0.097, height=0.456, mass=26.0).restitution, 4)
        0.9349
        """
        expect_positive(diameter=diameter, height=height, mass=mass, gravity=gravity)
        expect_metres(
            mass / cone_volume(diameter, diameter, height), diameter / height, diameter=diameter, height=height
        )
        return cls._turned(diameter, diameter, height, mass, gravity)

    @classmethod
    def cone(
        cls, *, base_diameter: float, top_diameter: float, height: float, mass: float, gravity: float = STANDARD_GRAVITY
    ) -> Block:
        """
        Build a solid truncated cone, standing on the circle of `base_diameter`.

        Parameters
        ----------
        base_diameter, top_diameter, height : float
            m.
        mass : float
            kg.
        gravity : float, optional
            m/s².

        Returns
        -------
        block : Block

        Raises
        ------
        ValueError
            If a dimension, the mass or gravity is not positive.

        Notes
        -----
        Moments of the cross-sections are integrated over the height, where the radius changes linearly:
        centre of mass ∫z r² / ∫r², transverse inertia about the base ∫(r⁴/4 + z² r²) / ∫r².

        Examples
        --------
        >>> round(Block.cone(base_diameter=0.12, top_diameter=0.08, height=0.456, mass=26.0).p, 3)
        5.812
        """
        expect_positive(
            base_diameter=base_diameter, top_diameter=top_diameter, height=height, mass=mass, gravity=gravity
        )
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

        Returns
        -------
        block : Block

        Raises
        ------
        ValueError
            If a value is not positive, an angle is not below π/2, or the inertia is smaller than that of the mass
            alone at the pole distance, which no body has.
        """
        expect_positive(mass=mass, gravity=gravity)
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


def pair(value: Sided) -> tuple[float, float]:
    """
    Spread one value to both sides, or pass a pair through.

    Examples
    --------
    >>> pair(0.2), pair((0.2, 0.3))
    ((0.2, 0.2), (0.2, 0.3))
    """
    return sided("value", value, "a number")
