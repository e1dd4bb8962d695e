"""The kinds of value in a campaign file, parsed to SI within bounds; an error says what was expected."""

from __future__ import annotations

import re
import reprlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import date, datetime, time
from inspect import signature
from math import hypot, isfinite
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

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


FIRST_YEAR, LAST_YEAR = 1900, 2100
"""Years between which a test was done; another is a slip of the pen."""

_ISO = re.compile(r"(\d{4})([-/.])(\d{1,2})\2(\d{1,2})")
_DOTTED = re.compile(r"(\d{1,2})\.\s?(\d{1,2})\.\s?(\d{4})")
_SLASHED = re.compile(r"(\d{1,2})([-/])(\d{1,2})\2(\d{4})")
_TIME = re.compile(r"(?:[T ]\s*\d{1,2}:\d{2}(?::\d{2}(?:\.\d+)?)?\s*(?:Z|[+-]\d{2}:?\d{2})?)?$")


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


@dataclass(frozen=True, eq=False)
class Kind:
    """A kind of value, as annotation of a type: what takes it as written or says what was expected; its JSON Schema."""

    take: Callable[..., Any]
    schema: Mapping[str, Any]

    def then(self, refine: Callable[[Any, object], Any]) -> Kind:
        """Return the kind whose values are taken further; `refine` gets the value and what was written."""
        return Kind(lambda value: refine(self.take(value), value), self.schema)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Have pydantic take the value; some need its context too."""
        if len(signature(self.take).parameters) == 2:
            return core_schema.with_info_before_validator_function(self.take, handler(source))
        return core_schema.no_info_before_validator_function(self.take, handler(source))

    def __get_pydantic_json_schema__(self, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Give the schema of what is written."""
        return dict(self.schema)


def quantity(
    dimension: str, *, signed: bool = False, example: str = "", between: tuple[float, float] | None = None
) -> Kind:
    """
    Give the kind of a quantity in text, such as ``"86 mm"``, that becomes its SI value.

    It is above zero and lies between bounds, SI, by default those of its dimension; if `signed`, it has either sign.
    """
    example = example or f"1 {units.DIMENSIONS[dimension][1]}"
    unit, largest = UNITS[dimension], AT_MOST.get(dimension, CONVERSION[1])
    low, high = (-largest, largest) if signed else between or BETWEEN[dimension]

    def take(value: object) -> float:
        if not isinstance(value, str):
            raise ValueError(f'{shown(value)} has no unit. A quantity in quotes was expected, such as "{example}".')
        if "?" in value:
            raise ValueError(f'{shown(value)} still has to be filled in. A quantity such as "{example}" was expected.')
        number = units.to_si(value, dimension)
        if not isfinite(number):
            raise ValueError(f"{shown(value)} is too large.")
        if signed:
            expected = "" if abs(number) <= largest else f"At most {largest:g} {unit} was expected."
        elif number <= 0.0:
            expected = "A value above zero was expected."
        else:
            expected = outside(number, (low, high), unit)
        if expected:
            raise ValueError(f"{shown(value)} was found. {expected}")
        return number

    return Kind(
        take,
        {
            "type": "string",
            "pattern": _QUANTITY_PATTERN,
            "description": f"{dimension}, with its unit",
            "examples": [example],
            "unit": unit,
            "between": f"{low:g} {unit} and {high:g} {unit}",
        },
    )


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


def number_between(low: float, high: float, *, exclusive: bool = False) -> Kind:
    """Give the kind of a number within bounds, the bounds themselves included or not."""
    word, end = ("between", "and") if exclusive else ("from", "to")
    expected = f"A number {word} {low:g} {end} {high:g}"

    def take(value: object) -> float:
        converted = number(value)
        if not low <= converted <= high or (exclusive and converted in (low, high)):
            raise ValueError(f"{shown(value)} was found. {expected} was expected.")
        return converted

    least, most = ("exclusiveMinimum", "exclusiveMaximum") if exclusive else ("minimum", "maximum")
    return Kind(take, {"type": "number", least: low, most: high})


def count_between(low: int, high: int) -> Kind:
    """Give the kind of a whole number within bounds, the bounds included."""

    def take(value: object) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise ValueError(f"{shown(value)} was found. A whole number from {low} to {high} was expected.")
        return value

    return Kind(take, {"type": "integer", "minimum": low, "maximum": high})


def or_word(kind: Kind, *words: str) -> Kind:
    """Give the kind of another one, or of one of a few words in its place."""
    listed = ", ".join(f'"{word}"' for word in words)

    def take(value: object) -> Any:
        if isinstance(value, str) and value in words:
            return value
        try:
            return kind.take(value)
        except ValueError as error:
            raise ValueError(f"{error} Or {listed}.") from None

    return Kind(take, {"anyOf": [{"enum": list(words)}, kind.schema]})


def _restitution(value: object) -> float:
    converted = number(value)
    if not 0.0 < converted <= 1.0:
        raise ValueError(f"{shown(value)} was found. A coefficient of restitution above 0, at most 1, was expected.")
    return converted


RESTITUTION = Kind(_restitution, {"type": "number", "exclusiveMinimum": 0, "maximum": 1})


def list_of(count: int, kind: Kind, what: str) -> Kind:
    """Give the kind of a list of values of one kind."""

    def take(value: object) -> tuple[Any, ...]:
        if not isinstance(value, (list, tuple)) or len(value) != count:
            raise ValueError(f"{shown(value)} was found. A list of {count} was expected: {what}.")
        return tuple(map(kind.take, value))

    array = {"type": "array", "items": kind.schema, "minItems": count, "maxItems": count, "description": what}
    return Kind(take, array)


def _sided(kind: Kind) -> Kind:
    """Give the kind of one value, or of a pair where the specimen is not symmetric."""
    pair = list_of(2, kind, "[for θ < 0, for θ > 0]")

    def take(value: object) -> Any:
        return (pair if isinstance(value, (list, tuple)) else kind).take(value)

    return Kind(take, {"anyOf": [kind.schema, pair.schema]})


def _unit_vector(vector: Vector, written: object) -> Vector:
    length = hypot(*vector)
    if not (length > 0.0 and isfinite(length)):
        raise ValueError(f"{shown(written)} was found. A direction other than zero was expected, such as [1, 0, 0].")
    x, y, z = vector
    return x / length, y / length, z / length


def _rising(times: tuple[float, float], written: object) -> tuple[float, float]:
    if not times[0] < times[1]:
        raise ValueError(f"{shown(written)} was found. The end has to come after the start.")
    return times


def text(value: object) -> str:
    """Take text that is not empty."""
    if not isinstance(value, str):
        raise ValueError(f"{shown(value)} was found. Text in quotes was expected.")
    if not value.strip():
        raise ValueError("It is empty. Text was expected.")
    return value


def schema_version(schema: int, files: str) -> Kind:
    """Give the kind of the version of a file's form."""

    def take(value: object) -> int:
        if value != schema or isinstance(value, bool) or not isinstance(value, int):
            raise ValueError(f"{shown(value)} was found. This colonnade reads {files} of schema {schema}.")
        return value

    return Kind(take, {"const": schema})


def one_of(*choices: str) -> Kind:
    """Give the kind of a word out of a few."""

    def take(value: object) -> str:
        if not isinstance(value, str) or value not in choices:
            raise ValueError(f"{shown(value)} was found.{nearest(str(value), choices)}")
        return value

    return Kind(take, {"type": "string", "enum": list(choices)})


def _column(value: object) -> str | int:
    if isinstance(value, str) and value.strip():
        return value
    if isinstance(value, int) and not isinstance(value, bool) and value >= 1:
        return value
    raise ValueError(f"{shown(value)} was found. A column's name, or its number from 1, was expected.")


def day(value: object) -> date:
    """
    Take a day.

    Parameters
    ----------
    value : object
        A date, or a date with a time of day; or text: ``2013-04-26``, ``26.04.2013`` (day first), or with slashes where
        only one order is possible: ``26/04/2013``. A time of day after it is ignored.

    Raises
    ------
    ValueError
        If it is not a day between 1900 and 2100, or if it is not clear which number is the day: ``04/05/2013``.

    Examples
    --------
    >>> day("26.04.2013").isoformat()
    '2013-04-26'
    """
    if isinstance(value, datetime):
        value = value.date()
    found = value if isinstance(value, date) else _written(value.strip()) if isinstance(value, str) else None
    if found is None:
        raise ValueError(f"{shown(value)} was found. A date was expected, such as 2013-04-26.")
    if not FIRST_YEAR <= found.year <= LAST_YEAR:
        raise ValueError(f"{found} was found. A date between {FIRST_YEAR} and {LAST_YEAR} was expected.")
    return found


def _written(text: str) -> date | None:
    """Read a day from text; None if it is not one."""
    for pattern, order in ((_ISO, (1, 3, 4)), (_DOTTED, (3, 2, 1))):
        if (found := _whole(pattern, text)) is not None:
            return _calendar_day(*(int(found[number]) for number in order))
    if (found := _whole(_SLASHED, text)) is None:
        return None
    first, second, year = int(found[1]), int(found[3]), int(found[4])
    day_first, month_first = _calendar_day(year, second, first), _calendar_day(year, first, second)
    if day_first and month_first and day_first != month_first:
        raise ValueError(
            f"{shown(text)} is {day_first} or {month_first}: it is not clear which number is the day. Write the "
            "year first, such as 2013-04-26."
        )
    return day_first or month_first


def _whole(pattern: re.Pattern[str], text: str) -> re.Match[str] | None:
    """Match a date, followed by nothing but a time of day."""
    found = pattern.match(text)
    return found if found and _TIME.match(text, found.end()) else None


def _calendar_day(year: int, month: int, of_month: int) -> date | None:
    try:
        return date(year, month, of_month)
    except ValueError:
        return None


SOME_TEXT = {"type": "string", "minLength": 1}
"""JSON Schema of text that is not empty."""

INTERVAL = list_of(2, quantity("time", signed=True), 'start and end, such as ["2 s", "14 s"]').then(_rising)
"""Two times, the second after the first."""

_NUMBERS = list_of(3, Kind(number, {"type": "number"}), "x, y and z, such as [1, 0, 0]")

Length = Annotated[float, quantity("length")]
Mass = Annotated[float, quantity("mass")]
Duration = Annotated[float, quantity("time")]
Delay = Annotated[float, quantity("time", signed=True)]
Frequency = Annotated[float, quantity("frequency")]
Angle = Annotated[float, quantity("angle", signed=True)]
PositiveAngle = Annotated[float, quantity("angle")]
Velocity = Annotated[float, quantity("velocity")]
Acceleration = Annotated[float, quantity("acceleration")]
Gravity = Annotated[float, quantity("acceleration", example="9.81 m/s^2")]
SidedAngle = Annotated[Sided, _sided(quantity("angle"))]
SidedLength = Annotated[Sided, _sided(quantity("length"))]
SidedInertia = Annotated[Sided, _sided(quantity("inertia"))]
SidedRestitution = Annotated[Sided, _sided(RESTITUTION)]
Position = Annotated[Vector, list_of(3, quantity("length", signed=True), 'x, y and z, each as "1 mm"')]
Direction = Annotated[Vector, _NUMBERS.then(_unit_vector)]
PositiveNumber = Annotated[float, number_between(*PLAIN)]
Scale = Annotated[float, number_between(*SCALE)]
Text = Annotated[str, Kind(text, SOME_TEXT)]
Interval = Annotated[tuple[float, float], INTERVAL]
Column = Annotated[str | int, Kind(_column, {"anyOf": [SOME_TEXT, {"type": "integer", "minimum": 1}]})]
DAY_SCHEMA = {"type": "string", "format": "date", "description": "a date of TOML, or text", "examples": ["2013-04-26"]}
Day = Annotated[date, Kind(day, DAY_SCHEMA)]
