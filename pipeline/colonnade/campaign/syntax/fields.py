"""The kinds of value in a campaign file, parsed to SI; what does not parse is refused with what was expected."""

from __future__ import annotations

import reprlib
from collections.abc import Callable
from datetime import date, time
from math import hypot, isfinite
from typing import Annotated, Any

from pydantic import BeforeValidator, WithJsonSchema

from colonnade import units
from colonnade.campaign.syntax.bounds import BETWEEN, PLAIN, SCALE, UNITS, outside, too_large
from colonnade.errors import UnitError, nearest, quoted

Vector = tuple[float, float, float]
Sided = float | tuple[float, float]

_LONGEST_INTEGER = 256
"""Bits of an integer that a message repeats."""

_QUANTITY_PATTERN = rf"^\s*{units.NUMBER_PATTERN}\s*[^\s0-9.,].*$"


def shown(value: object) -> str:
    """
    Write a value as it would stand in TOML, shortened.

    Examples
    --------
    >>> shown("mm"), shown(True), shown([1, 0])
    ('"mm"', 'true', '[1, 0]')
    """
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, (list, tuple)) and all(isinstance(item, (str, int, float)) for item in value):
        return f"[{', '.join(shown(item) for item in value[:4])}{', …' if len(value) > 4 else ''}]"
    if isinstance(value, int) and value.bit_length() > _LONGEST_INTEGER:  # Python refuses to write it out
        return "a whole number of very many digits"
    if isinstance(value, (date, time)):
        return "a date or time"
    return reprlib.repr(value)


def one_line(message: str) -> str:
    """Escape what would break a line or not be seen, such as a control character in a damaged file."""
    return "".join(sign if sign.isprintable() else sign.encode("unicode_escape").decode() for sign in message)


def quantity(
    dimension: str, *, above_zero: bool = False, example: str = "", between: tuple[float, float] | None = None
) -> tuple[Any, Any]:
    """
    Give validator and JSON Schema of a quantity in text, such as ``"86 mm"``, that becomes its SI value.

    One above zero has to lie between the bounds, SI, by default those of its dimension.
    """
    example = example or f"1 {units.DIMENSIONS[dimension][1]}"

    def convert(value: object) -> float:
        if not isinstance(value, str):
            raise ValueError(f'{shown(value)} has no unit. A quantity in quotes was expected, such as "{example}".')
        if "?" in value:
            raise ValueError(f'{shown(value)} still has to be filled in. A quantity such as "{example}" was expected.')
        try:
            number = units.to_si(value, dimension)
        except UnitError as error:
            raise ValueError(str(error)) from None
        if not isfinite(number):
            raise ValueError(f"{shown(value)} is too large.")
        if above_zero and number <= 0.0:
            raise ValueError(f"{shown(value)} was found. A value above zero was expected.")
        if above_zero:
            expected = outside(number, between or BETWEEN[dimension], UNITS[dimension])
        else:
            expected = too_large(number, dimension)
        if expected:
            raise ValueError(f"{shown(value)} was found. {expected}")
        return number

    schema = {
        "type": "string",
        "pattern": _QUANTITY_PATTERN,
        "description": f"{dimension}, with its unit",
        "examples": [example],
    }
    return BeforeValidator(convert), WithJsonSchema(schema)


def number(value: object) -> float:
    """Take a finite number that has no unit."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"{shown(value)} was found. A plain number was expected, without quotes and without a unit.")
    try:
        converted = float(value)
    except OverflowError:
        raise ValueError("The number is too large.") from None
    if not isfinite(converted):
        raise ValueError(f"{shown(value)} was found. A finite number was expected.")
    return converted


def positive_number(between: tuple[float, float]) -> tuple[Any, Any]:
    """Give validator and JSON Schema of a number above zero, within bounds."""

    def positive(value: object) -> float:
        converted = number(value)
        if converted <= 0.0:
            raise ValueError(f"{shown(value)} was found. A value above zero was expected.")
        if expected := outside(converted, between):
            raise ValueError(f"{shown(value)} was found. {expected}")
        return converted

    low, high = between
    return BeforeValidator(positive), WithJsonSchema({"type": "number", "minimum": low, "maximum": high})


def _restitution(value: object) -> float:
    converted = number(value)
    if not 0.0 < converted <= 1.0:
        raise ValueError(f"{shown(value)} was found. A coefficient of restitution above 0, at most 1, was expected.")
    return converted


def _each(count: int, convert: Callable[[object], float], what: str) -> Callable[[object], tuple[float, ...]]:
    def several(value: object) -> tuple[float, ...]:
        if not isinstance(value, (list, tuple)) or len(value) != count:
            raise ValueError(f"{shown(value)} was found. A list of {count} was expected: {what}.")
        return tuple(convert(item) for item in value)

    return several


def _sided(convert: Callable[[object], float], item: Any) -> tuple[Any, Any]:
    pair = _each(2, convert, "[for θ < 0, for θ > 0]")

    def either(value: object) -> Sided:
        if isinstance(value, (list, tuple)):
            first, second = pair(value)
            return first, second
        return convert(value)

    schema = item.json_schema
    both = {"type": "array", "items": schema, "minItems": 2, "maxItems": 2, "description": "[for θ < 0, for θ > 0]"}
    return BeforeValidator(either), WithJsonSchema({"anyOf": [schema, both]})


def sided_quantity(dimension: str) -> tuple[Any, Any]:
    """Give validator and JSON Schema of one positive quantity, or a pair where the specimen is not symmetric."""
    single, schema = quantity(dimension, above_zero=True)
    return _sided(single.func, schema)


def vector_of(dimension: str) -> tuple[Any, Any]:
    """Give validator and JSON Schema of three quantities [x, y, z]."""
    single, schema = quantity(dimension)
    array = {"type": "array", "items": schema.json_schema, "minItems": 3, "maxItems": 3}
    return BeforeValidator(
        _each(3, single.func, f'x, y and z, each as "1 {units.DIMENSIONS[dimension][1]}"')
    ), WithJsonSchema(array)


def _unit_vector(value: object) -> Vector:
    x, y, z = _each(3, number, "x, y and z, such as [1, 0, 0]")(value)
    length = hypot(x, y, z)
    if not (length > 0.0 and isfinite(length)):
        raise ValueError(f"{shown(value)} was found. A direction other than zero was expected, such as [1, 0, 0].")
    return x / length, y / length, z / length


def interval(value: object) -> tuple[float, float]:
    """Take two times, such as ``["2 s", "14 s"]``, the second after the first; in s."""
    single, _ = quantity("time")
    start, stop = _each(2, single.func, 'start and end, such as ["2 s", "14 s"]')(value)
    if not start < stop:
        raise ValueError(f"{shown(value)} was found. The end has to come after the start.")
    return start, stop


def text(value: object) -> str:
    """Take text that is not empty."""
    if not isinstance(value, str):
        raise ValueError(f"{shown(value)} was found. Text in quotes was expected.")
    if not value.strip():
        raise ValueError("It is empty. Text was expected.")
    return value


def schema_version(schema: int, files: str) -> tuple[Any, Any]:
    """Give validator and JSON Schema of the version of a file's form."""

    def known(value: object) -> int:
        if value != schema or isinstance(value, bool) or not isinstance(value, int):
            raise ValueError(f"{shown(value)} was found. This colonnade reads {files} of schema {schema}.")
        return value

    return BeforeValidator(known), WithJsonSchema({"const": schema})


def one_of(*choices: str) -> tuple[Any, Any]:
    """Give validator and JSON Schema of a word out of a few."""
    listed = ", ".join(f'"{choice}"' for choice in choices)

    def chosen(value: object) -> str:
        if not isinstance(value, str) or value not in choices:
            hint = nearest(value, choices) if isinstance(value, str) else ""
            hint = hint if "Did you mean" in hint else f" One of these was expected: {listed}."
            raise ValueError(f"{shown(value)} was found.{hint}")
        return value

    return BeforeValidator(chosen), WithJsonSchema({"type": "string", "enum": list(choices)})


def _column(value: object) -> str | int:
    if isinstance(value, str) and value.strip():
        return value
    if isinstance(value, int) and not isinstance(value, bool) and value >= 1:
        return value
    raise ValueError(f"{shown(value)} was found. A column's name, or its number from 1, was expected.")


INTERVAL_SCHEMA = {
    "type": "array",
    "items": quantity("time")[1].json_schema,
    "minItems": 2,
    "maxItems": 2,
    "description": "start and end",
}

Length = Annotated[float, *quantity("length", above_zero=True)]
Mass = Annotated[float, *quantity("mass", above_zero=True)]
Duration = Annotated[float, *quantity("time", above_zero=True)]
Delay = Annotated[float, *quantity("time")]
Frequency = Annotated[float, *quantity("frequency", above_zero=True)]
Angle = Annotated[float, *quantity("angle")]
PositiveAngle = Annotated[float, *quantity("angle", above_zero=True)]
Gravity = Annotated[float, *quantity("acceleration", above_zero=True, example="9.81 m/s^2")]
SidedAngle = Annotated[Sided, *sided_quantity("angle")]
SidedLength = Annotated[Sided, *sided_quantity("length")]
SidedInertia = Annotated[Sided, *sided_quantity("inertia")]
_RESTITUTION_SCHEMA = WithJsonSchema({"type": "number", "exclusiveMinimum": 0, "maximum": 1})
SidedRestitution = Annotated[Sided, *_sided(_restitution, _RESTITUTION_SCHEMA)]
Position = Annotated[Vector, *vector_of("length")]
Direction = Annotated[
    Vector,
    BeforeValidator(_unit_vector),
    WithJsonSchema({"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}),
]
PositiveNumber = Annotated[float, *positive_number(PLAIN)]
Scale = Annotated[float, *positive_number(SCALE)]
Text = Annotated[str, BeforeValidator(text), WithJsonSchema({"type": "string", "minLength": 1})]
Interval = Annotated[tuple[float, float], BeforeValidator(interval), WithJsonSchema(INTERVAL_SCHEMA)]
Column = Annotated[
    str | int,
    BeforeValidator(_column),
    WithJsonSchema({"anyOf": [{"type": "string", "minLength": 1}, {"type": "integer", "minimum": 1}]}),
]
