"""The kinds of value in a campaign file, parsed to SI within bounds; an error says what was expected."""

from __future__ import annotations

import reprlib
from datetime import date, time
from math import hypot, isfinite
from typing import Annotated, Any

from pydantic import BeforeValidator, WithJsonSchema

from colonnade import units
from colonnade.errors import nearest, quoted

UNITS = {"frequency": "Hz", "acceleration": "m/s^2", "inertia": "kg m^2", "pressure": "Pa", "mass": "kg"} | {
    "length": "m",
    "velocity": "m/s",
    "time": "s",
    "angle": "rad",
    "angular_velocity": "rad/s",
}
"""In which bounds are written, by dimension."""

BETWEEN = {
    "length": (1e-3, 1e3),
    "mass": (1e-6, 1e9),
    "time": (1e-6, 1e6),
    "frequency": (1e-4, 1e7),
    "angle": (1e-6, 3.2),
    "velocity": (1e-4, 1e3),
    "acceleration": (1e-2, 1e4),
    "inertia": (1e-12, 1e15),
    "pressure": (1e3, 1e13),
}
"""Least and largest SI value of a quantity that has to be above zero, by its dimension."""

AT_MOST = {"length": 1e4, "time": 1e10, "angle": 6.3}
"""Largest magnitude, SI, of a quantity that may have either sign: a position, a delay or an instant, a tilt."""

STEP = (1e-7, 1e-3)
"""Of the step of the contact model, s."""

CONVERSION = (1e-15, 1e15)
"""Of the SI value of one recorded unit; offsets and ranges are at most the latter."""

FACTOR = (1e-9, 1e9)
"""Of what a review multiplies a gain by."""

SCALE = (1e-3, 1e5)
"""Of a model: 1e5 means 1:100 000."""

PLAIN = (1e-6, 1e6)
"""Of other numbers that have no unit."""

FREQUENCY_PARAMETER = (1e-2, 1e3)
"""Of a specimen's p, rad/s: of columns of 1 km and of less than 0.1 mm."""

MAP_RATIO = (1e-3, 1e3)
"""Of the frequency and amplitude ratios of a map."""

MOST_CYCLES = 10_000.0
"""Of a sine of a map, and of its rise."""

MOST_POINTS = 10_000
"""Of either axis of a map."""

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


def outside(value: float, between: tuple[float, float], unit: str = "") -> str:
    """
    Say that a number's magnitude is too small or too large.

    Returns
    -------
    expected : str
        A sentence with what was expected; empty if it is between.

    Examples
    --------
    >>> outside(1e300, (1.0, 10.0), "m")
    'A value between 1 m and 10 m was expected.'
    """
    low, high = between
    if low <= abs(value) <= high:
        return ""
    written = [f"{bound:g} {unit}".rstrip() for bound in between]
    return f"A value between {written[0]} and {written[1]} was expected."


def too_large(value: float, dimension: str) -> str:
    """Say that the magnitude of a quantity of either sign is too large; empty if it is not."""
    largest = AT_MOST.get(dimension, CONVERSION[1])
    return "" if abs(value) <= largest else f"At most {largest:g} {UNITS[dimension]} was expected."


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
        number = units.to_si(value, dimension)
        if not isfinite(number):
            raise ValueError(f"{shown(value)} is too large.")
        if not above_zero:
            expected = too_large(number, dimension)
        elif number <= 0.0:
            expected = "A value above zero was expected."
        else:
            expected = outside(number, between or BETWEEN[dimension], UNITS[dimension])
        if expected:
            raise ValueError(f"{shown(value)} was found. {expected}")
        return number

    schema = {
        "type": "string",
        "pattern": _QUANTITY_PATTERN,
        "description": f"{dimension}, with its unit",
        "examples": [example],
        "unit": UNITS[dimension],
        "between": _limits(dimension, between, above_zero=above_zero),
    }
    return BeforeValidator(convert), WithJsonSchema(schema)


def _limits(dimension: str, between: tuple[float, float] | None, *, above_zero: bool) -> str:
    """Write the least and the largest value of a quantity."""
    if not above_zero:
        largest = AT_MOST.get(dimension, CONVERSION[1])
        between = (-largest, largest)
    return " and ".join(f"{bound:g} {UNITS[dimension]}" for bound in between or BETWEEN[dimension])


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


def number_between(low: float, high: float, *, exclusive: bool = False) -> tuple[Any, Any]:
    """Give validator and JSON Schema of a number within bounds, the bounds themselves included or not."""
    expected = f"A number {'between' if exclusive else 'from'} {low:g} {'and' if exclusive else 'to'} {high:g}"

    def within(value: object) -> float:
        converted = number(value)
        if not low <= converted <= high or (exclusive and converted in (low, high)):
            raise ValueError(f"{shown(value)} was found. {expected} was expected.")
        return converted

    least, most = ("exclusiveMinimum", "exclusiveMaximum") if exclusive else ("minimum", "maximum")
    return BeforeValidator(within), WithJsonSchema({"type": "number", least: low, most: high})


def or_word(kind: tuple[Any, Any], *words: str) -> tuple[Any, Any]:
    """Give validator and JSON Schema of a kind of value, or of one of a few words in its place."""
    convert, schema = kind
    listed = ", ".join(f'"{word}"' for word in words)

    def either(value: object) -> Any:
        if isinstance(value, str) and value in words:
            return value
        try:
            return convert.func(value)
        except ValueError as error:
            raise ValueError(f"{error} Or {listed}.") from None

    return BeforeValidator(either), WithJsonSchema({"anyOf": [{"enum": list(words)}, schema.json_schema]})


def _restitution(value: object) -> float:
    converted = number(value)
    if not 0.0 < converted <= 1.0:
        raise ValueError(f"{shown(value)} was found. A coefficient of restitution above 0, at most 1, was expected.")
    return converted


RESTITUTION = (
    BeforeValidator(_restitution),
    WithJsonSchema({"type": "number", "exclusiveMinimum": 0, "maximum": 1}),
)
"""Validator and JSON Schema of a coefficient of restitution."""


def list_of(count: int, kind: tuple[Any, Any], what: str) -> tuple[Any, Any]:
    """Give validator and JSON Schema of a list of values of one kind."""
    convert, schema = kind

    def several(value: object) -> tuple[Any, ...]:
        if not isinstance(value, (list, tuple)) or len(value) != count:
            raise ValueError(f"{shown(value)} was found. A list of {count} was expected: {what}.")
        return tuple(convert.func(item) for item in value)

    array = {"type": "array", "items": schema.json_schema, "minItems": count, "maxItems": count, "description": what}
    return BeforeValidator(several), WithJsonSchema(array)


def _sided(kind: tuple[Any, Any]) -> tuple[Any, Any]:
    """Give validator and JSON Schema of one value, or a pair where the specimen is not symmetric."""
    (one, schema), (pair, both) = kind, list_of(2, kind, "[for θ < 0, for θ > 0]")

    def either(value: object) -> Sided:
        converted: Sided = (pair if isinstance(value, (list, tuple)) else one).func(value)
        return converted

    return BeforeValidator(either), WithJsonSchema({"anyOf": [schema.json_schema, both.json_schema]})


_NUMBERS, _NUMBERS_SCHEMA = list_of(
    3, (BeforeValidator(number), WithJsonSchema({"type": "number"})), "x, y and z, such as [1, 0, 0]"
)
_TIMES, INTERVAL_SCHEMA = list_of(2, quantity("time"), 'start and end, such as ["2 s", "14 s"]')


def _unit_vector(value: object) -> Vector:
    x, y, z = _NUMBERS.func(value)
    length = hypot(x, y, z)
    if not (length > 0.0 and isfinite(length)):
        raise ValueError(f"{shown(value)} was found. A direction other than zero was expected, such as [1, 0, 0].")
    return x / length, y / length, z / length


def interval(value: object) -> tuple[float, float]:
    """Take two times, such as ``["2 s", "14 s"]``, the second after the first; in s."""
    start, stop = _TIMES.func(value)
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

    def chosen(value: object) -> str:
        if not isinstance(value, str) or value not in choices:
            raise ValueError(f"{shown(value)} was found.{nearest(str(value), choices)}")
        return value

    return BeforeValidator(chosen), WithJsonSchema({"type": "string", "enum": list(choices)})


def _column(value: object) -> str | int:
    if isinstance(value, str) and value.strip():
        return value
    if isinstance(value, int) and not isinstance(value, bool) and value >= 1:
        return value
    raise ValueError(f"{shown(value)} was found. A column's name, or its number from 1, was expected.")


Length = Annotated[float, *quantity("length", above_zero=True)]
Mass = Annotated[float, *quantity("mass", above_zero=True)]
Duration = Annotated[float, *quantity("time", above_zero=True)]
Delay = Annotated[float, *quantity("time")]
Frequency = Annotated[float, *quantity("frequency", above_zero=True)]
Angle = Annotated[float, *quantity("angle")]
PositiveAngle = Annotated[float, *quantity("angle", above_zero=True)]
Gravity = Annotated[float, *quantity("acceleration", above_zero=True, example="9.81 m/s^2")]
SidedAngle = Annotated[Sided, *_sided(quantity("angle", above_zero=True))]
SidedLength = Annotated[Sided, *_sided(quantity("length", above_zero=True))]
SidedInertia = Annotated[Sided, *_sided(quantity("inertia", above_zero=True))]
SidedRestitution = Annotated[Sided, *_sided(RESTITUTION)]
Position = Annotated[Vector, *list_of(3, quantity("length"), 'x, y and z, each as "1 mm"')]
Direction = Annotated[Vector, BeforeValidator(_unit_vector), _NUMBERS_SCHEMA]
PositiveNumber = Annotated[float, *number_between(*PLAIN)]
Scale = Annotated[float, *number_between(*SCALE)]
Text = Annotated[str, BeforeValidator(text), WithJsonSchema({"type": "string", "minLength": 1})]
Interval = Annotated[tuple[float, float], BeforeValidator(interval), INTERVAL_SCHEMA]
Column = Annotated[
    str | int,
    BeforeValidator(_column),
    WithJsonSchema({"anyOf": [{"type": "string", "minLength": 1}, {"type": "integer", "minimum": 1}]}),
]
