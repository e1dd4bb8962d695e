"""Channels: the column and recorder of each, what it measures and where, and how it becomes SI."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from math import hypot
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from colonnade import units
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.fields import CONVERSION, number, outside, shown
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Table, problem, refuse
from colonnade.errors import UnitError

MAIN = "main"
"""The recorder that a setup has without saying so."""

SURROUNDINGS = ("table", "ground")
"""What a channel may be on that is not a specimen."""

_NEEDS_DIRECTION = {"displacement", "velocity", "acceleration", "angle", "angular_velocity"}


ALONG = 0.9
"""Smallest part of a channel's direction along an axis with which it counts as a record of the motion along it."""

LEAST_COSINE = 0.1
"""Of a line of sight to the normal of its face, and of a wire to its direction: below it, next to nothing is seen."""


def _cosine(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    return sum(here * there for here, there in zip(one, other, strict=True)) / (hypot(*one) * hypot(*other))


def _readable(value: object, what: str, read: Callable[[str], object]) -> str:
    """Accept text that `read` accepts; the error gives an example."""
    if not isinstance(value, str):
        raise ValueError(f"{shown(value)} was found. {what} was expected.")
    read(value)
    return value


def _number_and_unit(text: str) -> float:
    number, unit = units.parse(text)
    units.normalise_unit(unit)
    return number


def _gain(value: object) -> str:
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        value = repr(number(value))
    gain = _readable(value, 'A gain in quotes, such as "10 mm/V",', _number_and_unit)
    if _number_and_unit(gain) == 0.0:
        raise ValueError(f"{shown(value)} was found. A gain of zero would erase the recording.")
    return gain


_QUANTITY_SCHEMA: dict[str, Any] = {"type": "string", "pattern": rf"^\s*{units.NUMBER_PATTERN}"}
_GAIN_SCHEMA = {"anyOf": [_QUANTITY_SCHEMA | {"examples": ["10 mm/V"]}, {"type": "number"}]}
Gain = Annotated[str, fields.Kind(_gain, _GAIN_SCHEMA)]
_UNIT = partial(_readable, what='A unit in quotes, such as "V",', read=units.normalise_unit)
_QUANTITY = partial(_readable, what='A quantity with its unit in quotes, such as "10 V",', read=_number_and_unit)
Unit = Annotated[str, fields.Kind(_UNIT, {"type": "string", "examples": ["V", "mm", "g"]})]
QuantityText = Annotated[str, fields.Kind(_QUANTITY, _QUANTITY_SCHEMA)]


class Channel(Table):
    """
    One transducer as recorded: physical value = recorded × gain + offset.

    In addition to its keys it has, in SI: `factor`, `offset`, `range_recorded`, `full_scale` and `si_unit`.
    """

    column: fields.Column
    """Name of its column in the raw file, or its number from 1."""
    recorder: Identifier = MAIN
    """Recorder that has the column."""
    time: fields.Column | None = None
    """Column of its own time, if it has one."""
    quantity: Annotated[str, fields.one_of(*units.QUANTITY_DIMENSIONS)]
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
    at: fields.Position | None = None
    """Its material point [x, y, z] from the centre of the specimen's base."""
    direction: fields.Direction | None = None
    """Direction of a positive reading, such as [1, 0, 0]; for angles the axis, right-handed."""
    relative_to: Annotated[str, fields.one_of("table", "ground")] | None = None
    """What a displacement of the specimen is measured against: "table" or "ground"."""
    delay: fields.Delay = 0.0
    """How late its values are, such as "2 ms"."""
    sensing: Annotated[str, fields.one_of("point", "surface", "wire")] = "point"
    """What it follows: a material "point", the "surface" in a fixed line of sight (laser), the length of a "wire"."""
    normal: fields.Direction | None = None
    """Outward normal of the flat face that a "surface" transducer looks at; none for the side of a round specimen."""
    anchor: fields.Position | None = None
    """Fixed end of a "wire"."""

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        wrong = self._missing()
        for key, derived in (
            ("gain" if self.gain else "unit", "factor"),
            ("offset", "offset"),
            ("range", "full_scale"),
        ):
            if {"unit", "gain", "offset"} & set(wrong):
                break
            try:
                value = getattr(self, derived)
            except UnitError as error:
                wrong[key] = str(error)
                continue
            low, high = CONVERSION
            expected = outside(value or 0.0, (low if derived == "factor" else 0.0, high), self.si_unit)
            if expected:
                wrong[key] = f"It is {value:g} {self.si_unit}. {expected}"
        if wrong:
            raise refuse("Channel", [problem(message, key) for key, message in wrong.items()])
        return self

    def _missing(self) -> dict[str, str]:
        if self.quantity == "other":
            return {}
        needed = {"unit": 'Expected: unit of the values in the file, such as "V" or "mm".'}
        if self.quantity in _NEEDS_DIRECTION:
            needed["on"] = '"specimen", "table" or "ground" was expected.'
            needed["direction"] = "The direction of a positive reading was expected, such as [1, 0, 0]."
        if self.quantity == "displacement" and self.is_on_body:
            needed["at"] = (
                "The point that the transducer follows was expected, "
                'such as ["43 mm", "0 mm", "440 mm"] from the centre of the base.'
            )
            needed["relative_to"] = '"table" or "ground" was expected: what the transducer is fixed to.'
        missing = {key: f"It is missing. {what}" for key, what in needed.items() if getattr(self, key) is None}
        return missing | self._wrong_sight()

    def _wrong_sight(self) -> dict[str, str]:
        """Say what is wrong with the line of sight or the wire."""
        wrong: dict[str, str] = {}
        if self.sensing != "point" and not (self.quantity == "displacement" and self.is_on_body):
            wrong["sensing"] = f'"{self.sensing}" is for a displacement of the specimen. Leave it out here.'
        for key, sensing in (("normal", "surface"), ("anchor", "wire")):
            if getattr(self, key) is not None and self.sensing != sensing:
                wrong[key] = f'It needs sensing = "{sensing}", but sensing is "{self.sensing}". Correct one of them.'
        if self.sensing == "wire" and self.anchor is None:
            wrong["anchor"] = 'It is missing. A "wire" needs its fixed end, such as ["500 mm", "0 mm", "440 mm"].'
        return wrong or self._sees_nothing()

    def _sees_nothing(self) -> dict[str, str]:
        """Report a line of sight or a wire that measures hardly anything in its direction."""
        if self.direction is None:
            return {}
        if self.normal is not None and abs(_cosine(self.normal, self.direction)) < LEAST_COSINE:
            return {"normal": "The line of sight is parallel to this face. Give the normal of the face that it hits."}
        if self.anchor is None or self.at is None:
            return {}
        wire = tuple(there - here for here, there in zip(self.at, self.anchor, strict=True))
        if not any(wire):
            return {"anchor": "It is the same point as `at`, so the wire has no length. Give its fixed end."}
        if abs(_cosine(wire, self.direction)) < LEAST_COSINE:
            return {"anchor": "The wire is at right angles to `direction`. Give an anchor ahead of or behind `at`."}
        return {}

    @property
    def is_on_body(self) -> bool:
        """Whether it is on a specimen, that of the test or the one whose id it gives."""
        return self.on is not None and self.on not in SURROUNDINGS

    @property
    def dimension(self) -> str | None:
        """Dimension of its quantity; None for "other"."""
        return units.QUANTITY_DIMENSIONS[self.quantity]

    @property
    def si_unit(self) -> str:
        """Unit of the physical value in the notation of CF, such as "m s-2"."""
        if self.dimension is not None:
            return units.si_factor(units.DIMENSIONS[self.dimension][0])[1]
        return units.si_factor(self._physical_unit)[1]

    @cached_property
    def factor(self) -> float:
        """SI value of one recorded unit."""
        if self.gain is None:
            recorded = self.unit or ""
            if self.dimension is None:
                return units.si_factor(recorded)[0]
            try:
                return units.factor_to_si(recorded, self.dimension)
            except UnitError as error:
                example = f"{units.DIMENSIONS[self.dimension][1]}/{recorded}"
                raise UnitError(f'{error} If this is the recorder\'s own unit, add a gain in "{example}".') from None
        if self.dimension is None:
            return units.parse(self.gain)[0] * units.si_factor(self._physical_unit)[0]
        return units.gain_to_si(self.gain, self.unit or "", self.dimension)

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
        recorded = self.unit or ""
        if units.same_unit(unit, recorded):
            return abs(value)
        (factor, dimension), (recorded_factor, recorded_dimension) = units.si_factor(unit), units.si_factor(recorded)
        if dimension != recorded_dimension or dimension == self.si_unit:
            return None
        return abs(value) * factor / recorded_factor

    @cached_property
    def full_scale(self) -> float | None:
        """Largest magnitude of the physical value, SI; None if no range is given."""
        if self.written_range is None:
            return None
        if self.range_recorded is not None:
            return self.range_recorded * abs(self.factor) + abs(self.offset)
        try:
            return abs(self._physical(self.written_range))
        except UnitError as error:
            raise UnitError(f'{error} A range in the recorded unit, "{self.unit or ""}", is also allowed.') from None

    @property
    def _physical_unit(self) -> str:
        """Unit of recorded × gain, for a quantity without a dimension of its own."""
        recorded = f"({self.unit})" if self.unit else "1"
        return recorded if self.gain is None else f"({units.parse(self.gain)[1] or 1}) * {recorded}"

    def _physical(self, text: str) -> float:
        if self.dimension is not None:
            return units.to_si(text, self.dimension)
        value, unit = units.parse(text)
        factor, found = units.si_factor(unit)
        if found != self.si_unit:
            raise UnitError(f'"{text}" does not have the unit of the physical value, which is {self.si_unit} in SI.')
        return value * factor
