"""
Quantities in text to SI, and back: the units of laboratories in one table, the spellings that recorders use.

`g` is the gravity unit 9.80665 m/s², never the gram, and `Gal` is 1 cm/s², never the gallon. Angles have a dimension
here, so that rad/s and Hz are not taken for each other.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from math import isclose, isfinite, prod

from colonnade.errors import UnitError, nearest, quoted

DIMENSIONS: dict[str, tuple[str, str]] = {
    "length": ("m", "mm"),
    "mass": ("kg", "kg"),
    "time": ("s", "s"),
    "frequency": ("s-1", "Hz"),
    "angle": ("rad", "deg"),
    "angular_velocity": ("rad s-1", "deg/s"),
    "velocity": ("m s-1", "mm/s"),
    "acceleration": ("m s-2", "g"),
    "force": ("kg m s-2", "kN"),
    "inertia": ("kg m2", "kg m^2"),
    "pressure": ("kg m-1 s-2", "GPa"),
    "voltage": ("V", "V"),
    "dimensionless": ("1", ""),
}
"""Dimension: its SI unit, and a unit that a laboratory would write."""

QUANTITY_DIMENSIONS: dict[str, str | None] = {
    "displacement": "length",
    "velocity": "velocity",
    "acceleration": "acceleration",
    "angle": "angle",
    "angular_velocity": "angular_velocity",
    "force": "force",
    "other": None,
}
"""What a channel can record, and its dimension; `other` may have any."""

# Symbol: SI units in one of it, its dimension as powers of SI units, and further names.
_UNITS = {
    "m": (1.0, "m", "metre meter"),
    "kg": (1.0, "kg", "kilogram Kg KG"),
    "s": (1.0, "s", "second sec"),
    "rad": (1.0, "rad", "radian"),
    "V": (1.0, "V", "volt v"),
    "A": (1.0, "A", "ampere amp"),
    "count": (1.0, "count", "digit bit LSB"),
    "degC": (1.0, "degC", "celsius"),
    "%": (0.01, "", "percent"),
    "strain": (1.0, "", ""),
    "Hz": (1.0, "s-1", "hertz hz HZ sps"),
    "min": (60.0, "s", "minute"),
    "h": (3600.0, "s", "hour"),
    "g": (9.80665, "m s-2", "gravity G"),
    "Gal": (0.01, "m s-2", "gal GAL"),
    "N": (1.0, "kg m s-2", "newton"),
    "kgf": (9.80665, "kg m s-2", "kilogram_force"),
    "lbf": (4.4482216152605, "kg m s-2", "pound_force"),
    "Pa": (1.0, "kg m-1 s-2", "pascal"),
    "bar": (1e5, "kg m-1 s-2", ""),
    "t": (1000.0, "kg", "tonne"),
    "lb": (0.45359237, "kg", "pound"),
    "in": (0.0254, "m", "inch"),
    "ft": (0.3048, "m", "foot feet"),
    "deg": (0.017453292519943295, "rad", "degree"),
    "rev": (6.283185307179586, "rad", "revolution"),
    "rpm": (6.283185307179586 / 60.0, "rad s-1", ""),
}
_PREFIXES = {
    "n": (1e-9, "nano"),
    "µ": (1e-6, "micro μ u"),
    "m": (1e-3, "milli"),
    "c": (1e-2, "centi"),
    "k": (1e3, "kilo"),
    "M": (1e6, "mega"),
    "G": (1e9, "giga"),
}

# Hints at what was meant.
COMMON = ("mm", "cm", "m", "kg", "s", "ms", "Hz", "g", "Gal", "m/s^2", "mm/s", "V", "mV", "N", "kN", "rad", "deg")
SHOUTED = {"KN": "kN", "KPA": "kPa", "MPA": "MPa", "GPA": "GPa", "MG": "mg"}
"""Units in capitals that can only be one: nobody records 10⁶ g or 10⁻³ Pa."""
UNCLEAR = {"MV": "mV", "MA": "mA", "Mg": "mg", "NM": "N m"}
"""Units that may be another one, which is more likely; they are asked about."""
LARGEST_POWER = 9
"""Sum of the exponents in a unit, without their signs: its factor stays finite."""
_TOKEN = re.compile(r"([^\W\d_]+|%|1(?![0-9]))(?:(?:\^|\*\*)?([+-]?[0-9](?![0-9])))?|(\S)")
_SPELLINGS = str.maketrans("⁰¹²³⁴⁻−·⋅×º", "01234--***°")

NUMBER_PATTERN = r"[+\-−]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+\-−]?[0-9]+)?"
_QUANTITY = re.compile(rf"({NUMBER_PATTERN})\s*(.*)", re.DOTALL)
_DECIMAL_COMMA = re.compile(r"[+\-−]?[0-9]+,[0-9]+.*", re.DOTALL)


@dataclass(frozen=True)
class Unit:
    """A unit: SI units in one of it, its dimension as powers of SI units, and its usual spelling."""

    factor: float
    dimension: Mapping[str, int]
    symbol: str

    @property
    def si_unit(self) -> str:
        """Its SI unit in the notation of CF, such as "m s-2"; "1" where it has no dimension."""
        powers = (f"{name}{'' if power == 1 else power}" for name, power in sorted(self.dimension.items()))
        return " ".join(powers) or "1"

    def __mul__(self, other: Unit) -> Unit:
        powers = collected((*self.dimension.items(), *other.dimension.items()))
        return Unit(self.factor * other.factor, powers, f"{self.symbol} {other.symbol}")


def parse(text: str) -> tuple[float, str]:
    """
    Split a quantity into its number and its unit, as written; the unit is empty without one.

    Raises
    ------
    UnitError
        If the text does not start with a finite number.

    Examples
    --------
    >>> parse("86 mm"), parse("-0.5g")
    ((86.0, 'mm'), (-0.5, 'g'))
    """
    text = text.strip()
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise UnitError(f'{quoted(text)} is not a quantity. A number with its unit was expected, such as "86 mm".')
    if _DECIMAL_COMMA.fullmatch(text):
        raise UnitError(
            f"{quoted(text)} has a decimal comma. Write it with a point: {quoted(text.replace(',', '.', 1))}."
        )
    value = float(match[1].replace("−", "-"))
    if not isfinite(value):
        raise UnitError(f"{quoted(text)} is too large.")
    return value, match[2]


def to_si(text: str, dimension: str) -> float:
    """
    Convert a quantity such as ``"86 mm"`` to SI.

    Parameters
    ----------
    text : str
    dimension : str
        A key of `DIMENSIONS`.

    Raises
    ------
    UnitError
        If it is not a quantity, its unit is not known, or it has another dimension.

    Examples
    --------
    >>> to_si("86 mm", "length"), to_si("2 g", "acceleration")
    (0.086, 19.6133)
    """
    value, unit = parse(text)
    if not unit and dimension != "dimensionless":
        raise UnitError(f"{quoted(text)} has no unit. {expected(dimension, value)}")
    try:
        return _times(value, factor_to_si(unit, dimension))
    except UnitError as error:
        raise UnitError(f"{quoted(text)}: {error}") from None


def from_si(value: float, unit: str) -> float:
    """
    Express an SI value in `unit`; UnitError if it is not known.

    Examples
    --------
    >>> from_si(0.086, "mm")
    86.0
    """
    return _times(value, 1.0 / resolve(unit).factor)


def factor_to_si(unit: str, dimension: str) -> float:
    """
    Give the number of SI units in one `unit`; UnitError if it is not known or not of that dimension.

    Examples
    --------
    >>> factor_to_si("mm", "length"), factor_to_si("g's", "acceleration")
    (0.001, 9.80665)
    """
    found = resolve(unit, dimension)
    if found.si_unit != DIMENSIONS[dimension][0]:
        named = next((name for name, (si_unit, _) in DIMENSIONS.items() if si_unit == found.si_unit), None)
        kind = "of another kind" if named is None else f"a unit of {words(named)}"
        raise UnitError(
            f"{quoted(unit)} is {'without dimension' if not found.dimension else kind}. {expected(dimension)}"
        )
    return found.factor


def gain_to_si(gain: str, recorded_unit: str, dimension: str | None) -> float:
    """
    Give the SI value of one recorded unit, as in the file, after a transducer's gain.

    Parameters
    ----------
    gain : str
        Physical over recorded, such as ``"10.02 mm/V"``; ``"-1"`` turns the sign of a recorded length.
    recorded_unit : str
        Such as ``"V"`` or ``"mV"``.
    dimension : str or None
        Of the physical quantity, a key of `DIMENSIONS`; None if any will do.

    Raises
    ------
    UnitError
        If gain times recorded unit does not have that dimension.

    Examples
    --------
    >>> round(gain_to_si("10.02 mm/V", "mV", "length"), 10)
    1.002e-05
    """
    value, unit = parse(gain)
    per_unit, recorded = resolve(unit), resolve(recorded_unit)
    if dimension and (per_unit * recorded).si_unit != DIMENSIONS[dimension][0]:
        below = f"({recorded.symbol})" if {"/", " "} & set(recorded.symbol) else recorded.symbol
        example = f"{DIMENSIONS[dimension][1]}/{below}" if below else DIMENSIONS[dimension][1]
        doubt = f" Is {quoted(recorded_unit)} the unit of the values in the file?" if "/" in recorded.symbol else ""
        raise UnitError(
            f"{quoted(gain)} times a recorded value in {quoted(recorded_unit)} is not {article(dimension)}. "
            f'A gain in "{example}" was expected.{doubt}'
        )
    return value * per_unit.factor * recorded.factor


def find_unit(unit: str) -> Unit | None:
    """
    Look a unit up; None if it is not known.

    Examples
    --------
    >>> find_unit("Volts").symbol, find_unit("furlong")
    ('V', None)
    """
    try:
        return resolve(unit)
    except UnitError:
        return None


def same_unit(first: str, second: str) -> bool:
    """
    Whether two spellings mean the same unit; false if one is unknown and they differ.

    Examples
    --------
    >>> same_unit("g's", "g"), same_unit("mV", "V"), same_unit("furlong", "mm")
    (True, False, False)
    """
    one, other = find_unit(first), find_unit(second)
    if one is None or other is None:
        return first.strip() == second.strip()
    return one.dimension == other.dimension and isclose(one.factor, other.factor)


def is_of(unit: str, dimension: str) -> bool:
    """
    Whether a unit is known and of a dimension.

    Examples
    --------
    >>> is_of("g", "acceleration"), is_of("mm", "acceleration"), is_of("", "length")
    (True, False, False)
    """
    found = find_unit(unit)
    return found is not None and found.si_unit == DIMENSIONS[dimension][0]


def is_physical(unit: str) -> bool:
    """
    Whether a unit is known and that of a physical quantity, neither a recorder's counts nor a plain number.

    Examples
    --------
    >>> is_physical("mm/V"), is_physical("counts"), is_physical("furlong")
    (True, False, False)
    """
    found = find_unit(unit)
    return found is not None and bool(found.dimension.keys() - {"count"})


def _times(value: float, factor: float) -> float:
    """Multiply by a factor; one such as 1/1000 divides instead, so that 86 mm is 0.086 m to the last digit."""
    divisor = round(1.0 / factor) if factor < 1.0 else 1
    return value / divisor if divisor > 1 and abs(divisor * factor - 1.0) < 1e-15 else value * factor


@lru_cache(maxsize=1024)
def resolve(text: str, dimension: str | None = None) -> Unit:
    """Look a unit up, as recorders and people spell it; `dimension` is the one that is wanted, for the message."""
    try:
        powers = collected(_factors(text))
    except UnitError as error:
        raise UnitError(f"{error} {expected(dimension)}") from None
    units = {name: _known()[name] for name in powers}
    base = collected((unit, each * powers[name]) for name in units for unit, each in units[name].dimension.items())
    return Unit(prod(unit.factor ** powers[name] for name, unit in units.items()), base, _spelled(powers))


def collected(factors: Iterable[tuple[str, int]]) -> dict[str, int]:
    """Add the exponents of each symbol; what cancels is left out."""
    powers: dict[str, int] = {}
    for name, power in factors:
        powers[name] = powers.get(name, 0) + power
    return {name: power for name, power in powers.items() if power}


def _spelled(powers: Mapping[str, int]) -> str:
    """Write a unit as usual: factors above, then each below after a slash."""
    written = {name: name if abs(power) == 1 else f"{name}^{abs(power)}" for name, power in powers.items()}
    above = " ".join(written[name] for name, power in powers.items() if power > 0)
    below = [written[name] for name, power in powers.items() if power < 0]
    return "/".join([above or ("1" if below else ""), *below])


def _factors(text: str) -> Iterator[tuple[str, int]]:
    """Symbols and exponents of a unit, read from left to right; a group in parentheses counts as one factor."""
    spelled = re.sub(r"['’]s\b|(?<=[^\W\d_])\.(?![^\W\d_])", "", text.translate(_SPELLINGS).strip())
    spelled = re.sub(r"\b(kg|k?N)m(?![^\W\d_])", r"\1*m", spelled)
    spelled = re.sub(r"°\s*C\b", "degC", spelled).replace("°", "deg").replace(".", "*")
    if spelled in {"", "-", "1"}:
        return
    groups, sign, expects, left = [1], 1, True, LARGEST_POWER
    for name, exponent, mark in _TOKEN.findall(spelled):
        if name:
            power = int(exponent or 1)
            if name != "1":
                left -= abs(power)
                yield _symbol(name, text), groups[-1] * sign * power
            sign, expects = 1, False
        elif mark == "(":
            groups.append(groups[-1] * sign)
            sign, expects = 1, True
        elif mark == ")" and len(groups) > 1 and not expects:
            groups.pop()
        elif mark in "*/" and not expects:
            sign, expects = (-1 if mark == "/" else 1), True
        else:
            raise _unknown(text, text)
    if expects or len(groups) > 1 or left < 0:
        raise _unknown(text, text)


def _symbol(name: str, text: str) -> str:
    if name in UNCLEAR:
        raise UnitError(f"Unknown unit {quoted(name)}: it may be two. Did you mean {quoted(UNCLEAR[name])}?")
    known = SHOUTED.get(name, name)
    # A spelled-out or shouted unit ("Volts", "MM", "SEC") is taken in lower case; one letter is not: M and m differ.
    for spelling in (known, name.lower(), SHOUTED.get(name.upper(), known)) if len(name) > 1 else (name,):
        if spelling in _known():
            return _known()[spelling].symbol
    raise _unknown(name, text)


@cache
def _known() -> dict[str, Unit]:
    """Give every unit, alone and behind every prefix, by each of its names."""
    found: dict[str, Unit] = {}
    for mark, (times, spellings) in {"": (1.0, ""), **_PREFIXES}.items():
        for symbol, (factor, written, names) in _UNITS.items():
            powers = {base: int(power or 1) for base, power in re.findall(r"([A-Za-z]+)(-?\d)?", written)}
            unit = Unit(times * factor, powers, mark + symbol)
            # A name may have a plural; "Vs" is no volts.
            each = (symbol, *names.split())
            for name in (*each, *(f"{name}s" for name in each if len(name) > 1)):
                found |= {prefix + name: unit for prefix in {mark, *spellings.split()} if prefix + name not in found}
    return found


def _unknown(name: str, text: str) -> UnitError:
    # A single letter is near to everything short, so it is not a hint for a longer name.
    hint = nearest(name, [unit for unit in COMMON if len(unit) > 1 or len(name) == 1])
    within = "" if name == text else f" in {quoted(text)}"
    return UnitError(f"Unknown unit {quoted(name)}{within}.{hint if 'Did you mean' in hint else ''}")


def expected(dimension: str | None, value: float | None = None) -> str:
    """Say that a quantity of this dimension was expected, with an example."""
    if dimension is None:
        return 'A unit such as "mm", "V" or "m/s^2" was expected.'
    if dimension == "dimensionless":
        return "A plain number was expected."
    example = DIMENSIONS[dimension][1]
    shown = example if value is None else f"{value:g} {example}"
    return f'{article(dimension).capitalize()} was expected, such as "{shown}".'


def article(dimension: str) -> str:
    """Name a dimension with its article."""
    name = words(dimension)
    return f"{'an' if name[0] in 'aei' else 'a'} {name}"


def words(dimension: str) -> str:
    """Name a dimension."""
    return {"inertia": "moment of inertia", "angular_velocity": "angular velocity"}.get(dimension, dimension)
