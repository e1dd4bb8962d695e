"""Specimens: dimensions or measured properties, and the block that they make."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import nan
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.table import Problems, Table
from colonnade.dynamics.block import STANDARD_GRAVITY, Block, pair
from colonnade.dynamics.size import cone_volume
from colonnade.units.text import format_percent, quantity

LARGEST_DEVIATION = 0.01
"""A measured value further than this from the one of the dimensions is reported, as a fraction of the latter."""

OUTER_DIMENSIONS = ("width", "depth", "diameter", "base_diameter", "top_diameter", "height")
"""Keys of lengths that shapes have."""

_BLOCKS: dict[str, Callable[..., Block]] = {"prism": Block.prism, "cylinder": Block.cylinder, "cone": Block.cone}

_VOLUMES: dict[str, Callable[..., float]] = {
    "prism": lambda width, depth, height: width * depth * height,
    "cylinder": lambda diameter, height: cone_volume(diameter, diameter, height),
    "cone": cone_volume,
}

_MEASURED = {"critical_angle": "rad", "pole_distance": "mm", "inertia": "kg m²"}


class SpecimenUncertainty(Table):
    """How well a specimen is known, as relative standard deviations; a key left out is that of the settings."""

    critical_angle: fields.Deviation | None = None
    """Of the critical angle; default: `processing.predict.ensemble.critical_angle`."""
    p: fields.Deviation | None = None
    """Of the frequency parameter; default: `processing.predict.ensemble.p`."""
    angle_gain: fields.Deviation | None = None
    """Of the calibration of the measured rocking angle; default: `processing.predict.ensemble.angle_gain`."""


class Specimen(Table):
    """The base of every specimen; a measured value overrides the one from the dimensions."""

    shape: str
    """Its shape: "prism" (width, depth, height), "cylinder" (diameter, height), "cone" (base_diameter, top_diameter,
    height) or "measured" (critical_angle, pole_distance, inertia)."""
    mass: fields.Mass
    """Mass, such as "26.10 kg"."""
    scale: fields.Scale | None = None
    """Scale of the model: 20 means 1:20."""
    critical_angle: fields.Sided[fields.PositiveAngle] | None = None
    """Rotation that brings the centre of mass above the pole, such as "0.1864 rad"."""
    pole_distance: fields.Sided[fields.Length] | None = None
    """Distance of the centre of mass from the pole, such as "232 mm"."""
    inertia: fields.Sided[fields.Inertia] | None = None
    """Moment of inertia about the pole, such as "1.873 kg m^2"."""
    restitution: fields.Sided[fields.Restitution] | None = None
    """Coefficient of restitution, a plain number such as 0.976; without it the identified one is used."""
    uncertainty: SpecimenUncertainty | None = None
    """How well its critical angle, p and measured angle are known, if not as the settings say."""

    is_assembly: ClassVar[bool] = False
    """Whether it is several bodies."""

    @property
    def is_in_plane(self) -> bool:
        """Whether it rocks as one block, so that models in the plane move it."""
        return True

    def sizes(self) -> dict[str, float]:
        """Outer dimensions by their keys, m; none if the specimen has no dimensions."""
        return {name: float(getattr(self, name)) for name in OUTER_DIMENSIONS if hasattr(self, name)}

    def contradictions(self) -> Problems:
        """Say that no block has these numbers."""
        try:
            p = self.block(STANDARD_GRAVITY).p
        except ValueError as error:
            yield (), f"No block has these numbers: {error}."
        else:
            if expected := fields.outside(p, fields.FREQUENCY_PARAMETER, "rad/s"):
                yield (), f"These numbers give a frequency parameter of {p:.3g} rad/s. {expected} Check the units."

    def dimensions(self, gravity: float) -> Block | None:
        """Block of the dimensions alone, or None if the specimen has none."""
        build = _BLOCKS.get(self.shape)
        return build(**self.sizes(), mass=self.mass, gravity=gravity) if build else None

    @property
    def volume(self) -> float | None:
        """m³; None if the specimen has no dimensions."""
        volume = _VOLUMES.get(self.shape)
        return volume(**self.sizes()) if volume else None

    def block(self, gravity: float) -> Block:
        """Build the block that predictions use: of the dimensions, with measured values in their place where given."""
        return _block_of(self, gravity)

    def deviations(self, gravity: float) -> list[str]:
        """Report measured values that differ by more than 1 % from those of the dimensions."""
        block, sentences = self.dimensions(gravity), []
        for name, unit in _MEASURED.items():
            given: fields.Sided[float] | None = getattr(self, name)
            expected = float(getattr(block.governing, name)) if block else nan
            for value in dict.fromkeys(pair(given) if given is not None else ()):
                if abs(value - expected) > LARGEST_DEVIATION * expected:
                    sentences.append(
                        f"{name} is given as {quantity(value, unit, 4)}, "
                        f"{format_percent(value / expected - 1, 1, signed=True)} from the "
                        f"{quantity(expected, unit, 4)} that the dimensions give; the given value is used."
                    )
        return sentences


@lru_cache(maxsize=1000)
def _block_of(specimen: Specimen, gravity: float) -> Block:
    """Make the block; a run with nothing to do asks for it ten times a test."""
    measured: dict[str, Any] = {name: getattr(specimen, name) for name in _MEASURED}
    block = specimen.dimensions(gravity)
    if block is None:
        return Block.measured(mass=specimen.mass, gravity=gravity, **measured)
    return block.override(**measured)


class Prism(Specimen):
    """A solid rectangular block."""

    shape: Literal["prism"]
    """Its shape."""
    width: fields.Length
    """Width along x, the direction of shaking, such as "86 mm"."""
    depth: fields.Length
    """Depth along y, across the direction of shaking."""
    height: fields.Length
    """Height, along z."""


class Cylinder(Specimen):
    """A solid upright cylinder."""

    shape: Literal["cylinder"]
    """Its shape."""
    diameter: fields.Length
    """Diameter, such as "97 mm"."""
    height: fields.Length
    """Height, along z."""


class Cone(Specimen):
    """A solid truncated cone."""

    shape: Literal["cone"]
    """Its shape."""
    base_diameter: fields.Length
    """Diameter of the base circle."""
    top_diameter: fields.Length
    """Diameter at the top."""
    height: fields.Length
    """Height, along z."""


class Measured(Specimen):
    """A specimen of any shape, known by measurement."""

    shape: Literal["measured"]
    """Its shape."""
    critical_angle: fields.Sided[fields.PositiveAngle]
    """Rotation that brings the centre of mass above the pole, such as "0.21 rad"."""
    pole_distance: fields.Sided[fields.Length]
    """Distance of the centre of mass from the pole, such as "610 mm"."""
    inertia: fields.Sided[fields.Inertia]
    """Moment of inertia about the pole, such as "41.2 kg m^2"."""


AnySpecimen = Annotated[Prism | Cylinder | Cone | Measured, Field(discriminator="shape")]
ROUND = ("cylinder", "cone")
"""Shapes whose base is round."""

SIZED: dict[str, type[Specimen]] = {"prism": Prism, "cylinder": Cylinder, "cone": Cone}
"""Shapes that have outer dimensions."""
