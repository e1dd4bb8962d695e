"""The values of a campaign file as types: each takes what is written to SI within bounds, and says its JSON Schema."""

from __future__ import annotations

import json
import re
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime, time
from math import hypot, isfinite
from typing import Annotated, Any, TypeAlias, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field, GetCoreSchemaHandler, GetJsonSchemaHandler, WithJsonSchema
from pydantic.types import AllowInfNan, Strict
from pydantic_core import CoreSchema, core_schema

from colonnade import units
from colonnade.errors import quoted

UNITS = {name: units.resolve(si_unit).symbol for name, (si_unit, *_) in units.DIMENSIONS.items()} | {
    "frequency": "Hz",
    "pressure": "Pa",
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

EXACT = 1e-9
"""A relative standard deviation up to this is none: its square would be lost in the rounding."""

PLAIN = (1e-6, 1e6)
"""Of other numbers that have no unit."""

FREQUENCY_PARAMETER = (1e-2, 1e3)
"""Of a specimen's p, rad/s: of columns of 1 km and of less than 0.1 mm."""

MOST_CYCLES = 10_000.0
"""Of a sine of a map, and of its rise."""

Vector = tuple[float, float, float]

_QUANTITY_PATTERN = rf"^\s*{units.NUMBER_PATTERN}\s*[^\s0-9.,].*$"

_DAYS = ("%Y-%m-%d", "%d.%m.%Y", "%d/%m/%Y", "%m/%d/%Y")
_TIME_OF_DAY = re.compile(r"[T ]\s*\d{1,2}:\d{2}(?::\d{2}(?:\.\d+)?)?\s*(?:Z|[+-]\d{2}:?\d{2})?$")


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
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, (date, time)):
        return "a date or time"
    try:
        return quoted(json.dumps(value, ensure_ascii=False, default=str))[1:-1]
    except ValueError:  # Python does not write out thousands of digits
        return "a whole number of very many digits"


def one_line(message: str) -> str:
    """Escape what would break a line or not be seen, such as a control character in a damaged file."""
    return "".join(sign if sign.isprintable() else sign.encode("unicode_escape").decode() for sign in message)


def outside(value: float, between: tuple[float, float], unit: str = "") -> str:
    """
    Say what was expected of a number whose magnitude is too small or too large; empty if it is between.

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


@dataclass(frozen=True)
class Quantity:
    """
    A quantity in text, such as ``"86 mm"``, that becomes its SI value; annotation of a float.

    It is above zero and lies between bounds, SI, by default those of its dimension; if `signed`, it has either sign.
    """

    dimension: str
    signed: bool = False
    example: str = ""
    between: tuple[float, float] | None = None

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and largest value, SI."""
        largest = AT_MOST.get(self.dimension, CONVERSION[1])
        return (-largest, largest) if self.signed else self.between or BETWEEN[self.dimension]

    @property
    def such_as(self) -> str:
        """A value as it is written."""
        return self.example or f"1 {units.DIMENSIONS[self.dimension][1]}"

    def take(self, value: object) -> float:
        """Take what is written."""
        if not isinstance(value, str) or "?" in value:
            lacking = "number" if isinstance(value, str) else "unit"
            raise ValueError(
                f'{shown(value)} has no {lacking}. A quantity in quotes was expected, such as "{self.such_as}".'
            )
        number, unit = units.to_si(value, self.dimension), UNITS[self.dimension]
        low, high = self.bounds
        if not low <= number <= high:
            raise ValueError(
                f"{shown(value)} was found. A value between {low:g} {unit} and {high:g} {unit} was expected."
            )
        return number

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Have pydantic take the value."""
        return core_schema.no_info_before_validator_function(self.take, handler(source))

    def __get_pydantic_json_schema__(self, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Give the schema of what is written."""
        unit = UNITS[self.dimension]
        return {
            "type": "string",
            "pattern": _QUANTITY_PATTERN,
            "description": f"{self.dimension}, with its unit",
            "examples": [self.such_as],
            "unit": unit,
            "between": " and ".join(f"{bound:g} {unit}" for bound in self.bounds),
        }


@dataclass(frozen=True)
class OneOf:
    """One of a few words that another module lists; annotation of text, as `Literal` for words that are known here."""

    words: tuple[str, ...]

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Have pydantic take the word."""
        return core_schema.literal_schema(list(self.words))


def day(value: object) -> date:
    """
    Take a date, or text: ``2013-04-26``, ``26.04.2013`` (day first), or with slashes where one order is possible.

    A time of day after it is ignored. ValueError if it is not clear: ``04/05/2013``.

    Examples
    --------
    >>> day("26.04.2013").isoformat()
    '2013-04-26'
    """
    text = re.sub(r"(?<=[-/.]) ", "", _TIME_OF_DAY.sub("", str(value).strip()))
    days = dict[date, None]()
    for form in _DAYS:
        with suppress(ValueError):
            days[datetime.strptime(text, form).date()] = None
    if not days:
        raise ValueError(f"{shown(value)} was found. A date was expected, such as 2013-04-26.")
    if len(days) > 1:
        raise ValueError(
            f"{shown(value)} is {' or '.join(map(str, days))}: it is not clear which number is the day. Write the "
            "year first, such as 2013-04-26."
        )
    return next(iter(days))


def listed(value: object) -> object:
    """Take one value as a list of it alone."""
    return value if isinstance(value, (list, tuple)) else [value]


def once(values: tuple[str, ...]) -> tuple[str, ...]:
    """Keep each text once, without blanks around it."""
    return tuple(dict.fromkeys(value.strip() for value in values))


def _unit_vector(vector: Vector) -> Vector:
    length = hypot(*vector)
    if not (length > 0.0 and isfinite(length)):
        raise ValueError(f"{shown(vector)} was found. A direction other than zero was expected, such as [1, 0, 0].")
    x, y, z = vector
    return x / length, y / length, z / length


def _rising(limits: tuple[float, float]) -> tuple[float, float]:
    if not limits[0] < limits[1]:
        raise ValueError(f"{limits[0]:g} and {limits[1]:g} (SI) were found. The second has to be the larger one.")
    return limits


Value = TypeVar("Value")
Sided: TypeAlias = Value | Annotated[tuple[Value, Value], Field(description="[for θ < 0, for θ > 0]")]
"""One value, or a pair if the specimen is not symmetric."""
Limits: TypeAlias = Annotated[tuple[Value, Value], AfterValidator(_rising)]
"""Two values, the second larger than the first."""

SOME_TEXT = {"type": "string", "minLength": 1}
"""JSON Schema of text that is not empty."""
_DAY = {"type": "string", "format": "date", "description": "a date of TOML, or text", "examples": ["2013-04-26"]}

Number = Annotated[float, Strict(), AllowInfNan(False)]
Whole = Annotated[int, Strict()]
Text = Annotated[str, Field(pattern=r"\S")]
Several = Annotated[
    tuple[Text, ...], Field(min_length=1, max_length=100), BeforeValidator(listed), AfterValidator(once)
]
"""A list of texts, or one of them; each once."""
Column = Text | Annotated[Whole, Field(ge=1)]
Day = Annotated[date, BeforeValidator(day), WithJsonSchema(_DAY)]

Length = Annotated[float, Quantity("length")]
Coordinate = Annotated[float, Quantity("length", signed=True)]
Mass = Annotated[float, Quantity("mass")]
Inertia = Annotated[float, Quantity("inertia")]
Pressure = Annotated[float, Quantity("pressure")]
Duration = Annotated[float, Quantity("time")]
Delay = Annotated[float, Quantity("time", signed=True)]
Frequency = Annotated[float, Quantity("frequency")]
Angle = Annotated[float, Quantity("angle", signed=True)]
PositiveAngle = Annotated[float, Quantity("angle")]
Velocity = Annotated[float, Quantity("velocity")]
Acceleration = Annotated[float, Quantity("acceleration")]
FrequencyParameter = Annotated[float, Quantity("angular_velocity", between=FREQUENCY_PARAMETER, example="1.26 rad/s")]
Restitution = Annotated[Number, Field(gt=0.0, le=1.0)]
Deviation = Annotated[Number, Field(ge=0.0, le=0.5), AfterValidator(lambda width: width if width > EXACT else 0.0)]
"""A relative standard deviation."""
PositiveNumber = Annotated[Number, Field(ge=PLAIN[0], le=PLAIN[1])]
Scale = Annotated[Number, Field(ge=1e-3, le=1e5)]
"""Of a model: 1e5 means 1:100 000."""
MapRatio = Annotated[Number, Field(ge=1e-3, le=1e3)]
"""A frequency or amplitude ratio of a map or spectrum."""
MapPoints = Annotated[Whole, Field(ge=2, le=10_000)]
"""Of either axis of a map."""
Position = tuple[Coordinate, Coordinate, Coordinate]
Direction = Annotated[tuple[Number, Number, Number], AfterValidator(_unit_vector)]
Interval = Limits[Delay]
