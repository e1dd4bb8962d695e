"""Channels: the column and recorder of each, what it measures and where, and how it becomes SI."""

from __future__ import annotations

from functools import cached_property
from math import hypot
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Field, WithJsonSchema

from colonnade import units
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Problems, Table, missing
from colonnade.errors import UnitError

MAIN = "main"
"""The recorder that a setup has without saying so."""

SURROUNDINGS = ("table", "ground")
"""What a channel may be on that is not a specimen."""

_NEEDS_DIRECTION = {"displacement", "velocity", "acceleration", "angle", "angular_velocity"}


LEAST_COSINE = 0.1
"""Of a line of sight to the normal of its face, and of a wire to its direction: below it, next to nothing is seen."""


def _unit(text: str) -> str:
    units.resolve(text)
    return text


def _quantity(text: str) -> str:
    units.resolve(units.parse(text)[1])
    return text


_QUANTITY_SCHEMA: dict[str, Any] = {"type": "string", "pattern": rf"^\s*{units.NUMBER_PATTERN}"}
_GAIN_SCHEMA = {"anyOf": [_QUANTITY_SCHEMA | {"examples": ["10 mm/V"]}, {"type": "number"}]}
Gain = Annotated[str, Field(coerce_numbers_to_str=True), AfterValidator(_quantity), WithJsonSchema(_GAIN_SCHEMA)]
Unit = Annotated[str, AfterValidator(_unit), WithJsonSchema({"type": "string", "examples": ["V", "mm", "g"]})]
QuantityText = Annotated[str, AfterValidator(_quantity), WithJsonSchema(_QUANTITY_SCHEMA)]


class RecordedAs(Table):
    """
    What a raw file holds of a transducer, and how it becomes SI: physical value = recorded × gain + offset.

    In addition to its keys it has, in SI: `factor`, `offset`, `range_recorded`, `full_scale` and `si_unit`.
    """

    column: fields.Column
    """Name of its column in the raw file, or its number from 1."""
    recorder: Identifier = MAIN
    """Recorder that has the column."""
    time: fields.Column | None = None
    """Name or number, from 1, of the column of its own time, if it has one."""
    quantity: Annotated[str, fields.OneOf(tuple(units.QUANTITY_DIMENSIONS))]
    """What it records: "displacement", "velocity", "acceleration", "angle", "angular_velocity", "force" or "other"."""
    unit: Unit | None = None
    """Unit of the values in the file, such as "V" or "mm"."""
    gain: Gain | None = None
    """Physical over recorded, such as "10.02 mm/V"; -1 turns the sign."""
    written_offset: QuantityText | None = Field(default=None, alias="offset")
    """Physical value of a recorded zero, such as "-0.13 mm"."""
    written_range: QuantityText | None = Field(default=None, alias="range")
    """Largest magnitude: of the recorded value if it has the recorded unit, else of the physical value."""
    on: Identifier | None = None
    """What it is fixed to or looks at: "specimen", "table", "ground", or the id of one specimen among several."""
    direction: fields.Direction | None = None
    """Direction of a positive reading, such as [1, 0, 0]; for angles the axis, right-handed."""

    @property
    def dimension(self) -> str | None:
        """Dimension of its quantity; None for "other"."""
        return units.QUANTITY_DIMENSIONS[self.quantity]

    @property
    def si_unit(self) -> str:
        """Unit of the physical value in the notation of CF, such as "m s-2"."""
        if self.dimension is not None:
            return units.DIMENSIONS[self.dimension][0]
        return units.product(units.parse(self.gain or "1")[1], self.unit or "").si_unit

    @cached_property
    def factor(self) -> float:
        """SI value of one recorded unit."""
        recorded = self.unit or ""
        if self.gain is not None or self.dimension is None:
            return units.gain_to_si(self.gain or "1", recorded, self.dimension)
        return units.factor_to_si(recorded, self.dimension)

    @cached_property
    def offset(self) -> float:
        """Physical value of a recorded zero, SI."""
        return 0.0 if self.written_offset is None else self._physical(self.written_offset)

    @cached_property
    def range_recorded(self) -> float | None:
        """Largest magnitude of the recorded value, in the recorded unit; None if `range` is a physical value."""
        if self.written_range is None:
            return None
        value, unit = units.parse(self.written_range)
        return abs(value) if units.same_unit(unit, self.unit or "") else None

    @cached_property
    def full_scale(self) -> float | None:
        """Largest magnitude of the physical value, SI; None if no range is given."""
        if self.written_range is None:
            return None
        if self.range_recorded is not None:
            return self.range_recorded * abs(self.factor) + abs(self.offset)
        return abs(self._physical(self.written_range))

    def _physical(self, text: str) -> float:
        if self.dimension is not None:
            return units.to_si(text, self.dimension)
        value, unit = units.parse(text)
        return value * units.resolve(unit).factor


class Channel(RecordedAs):
    """One transducer as recorded, and where it is: physical value = recorded × gain + offset."""

    at: fields.Position | None = None
    """Its material point from the centre of the specimen's base, x along the shaking, y across, z up, such as
    ["43 mm", "0 mm", "440 mm"]."""
    relative_to: Identifier | None = None
    """What a displacement of the specimen is measured against: "table" if the transducer moves with the table, else
    "ground", or another body of the assembly."""
    delay: fields.Delay = 0.0
    """How late its values are, such as "2 ms"."""
    sensing: Literal["point", "surface", "wire"] = "point"
    """What it follows: a material "point", the "surface" in a fixed line of sight (laser), the length of a "wire"."""
    normal: fields.Direction | None = None
    """Outward normal of the flat face that a "surface" transducer looks at; none for the side of a round specimen."""
    anchor: fields.Position | None = None
    """Fixed end of a "wire"."""

    def contradictions(self) -> Problems:
        """Say what is missing or does not fit together."""
        wrong = {} if self.quantity == "other" else self._missing() | self._wrong_sight()
        low, high = fields.CONVERSION
        usual = f"{units.DIMENSIONS[self.dimension or 'length'][1]}/{self.unit}"
        own_unit = "" if self.gain else f' If this is the recorder\'s own unit, add a gain in "{usual}".'
        in_recorded = f' A range in the recorded unit, "{self.unit}", is also allowed.'
        for key, derived, least, hint in (
            ("gain" if self.gain else "unit", "factor", low, own_unit),
            ("offset", "offset", 0.0, ""),
            ("range", "full_scale", 0.0, in_recorded),
        ):
            if {"unit", "gain", "offset"} & set(wrong):
                break
            try:
                value = getattr(self, derived) or 0.0
            except UnitError as error:
                wrong[key] = f"{error}{hint}"
                continue
            if expected := fields.outside(value, (least, high), self.si_unit):
                wrong[key] = f"It is {value:g} {self.si_unit}. {expected}"
        yield from (((key,), message) for key, message in wrong.items())

    def _missing(self) -> dict[str, str]:
        needed = ["unit"]
        if self.quantity in _NEEDS_DIRECTION:
            needed += ["on", "direction"]
        if self.quantity == "displacement" and self.is_on_body:
            needed += ["at", "relative_to"]
        return {key: missing(Channel, key) for key in needed if getattr(self, key) is None}

    def _wrong_sight(self) -> dict[str, str]:
        """Say what is wrong with the line of sight or the wire, which may see hardly anything in its direction."""
        if self.sensing != "point" and not (self.quantity == "displacement" and self.is_on_body):
            return {"sensing": f'"{self.sensing}" is for a displacement of the specimen. Leave it out here.'}
        if self.sensing == "wire" and self.anchor is None:
            return {"anchor": 'It is missing. A "wire" needs its fixed end, such as ["500 mm", "0 mm", "440 mm"].'}
        sees: tuple[float, ...] | None = self.normal
        for key, sensing in (("normal", "surface"), ("anchor", "wire")):
            if getattr(self, key) is not None and self.sensing != sensing:
                return {key: f'It needs sensing = "{sensing}", but sensing is "{self.sensing}". Correct one of them.'}
        if self.anchor is not None and self.at is not None:
            sees = tuple(there - here for here, there in zip(self.at, self.anchor, strict=True))
        if sees is None or self.direction is None or abs(np.dot(sees, self.direction)) > LEAST_COSINE * hypot(*sees):
            return {}
        told = "It looks at right angles to `direction`, so that next to nothing is seen. Correct one of them."
        return {"anchor" if self.anchor is not None else "normal": told}

    @property
    def is_on_body(self) -> bool:
        """Whether it is on a specimen, that of the test or the one whose id it gives."""
        return self.on is not None and self.on not in SURROUNDINGS
