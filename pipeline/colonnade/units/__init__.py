"""
Quantities in text to SI, and back: the units of laboratories in one table, the spellings that recorders use.

`g` is the gravity unit 9.80665 m/s², never the gram, and `Gal` is 1 cm/s², never the gallon. Angles have a dimension
here, so that rad/s and Hz are not taken for each other.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache, lru_cache
from math import isclose, isfinite, prod
from typing import NamedTuple

from colonnade.errors import UnitError, nearest, quoted

DIMENSIONS = {
    "length": ("m", "mm", "a length"),
    "mass": ("kg", "kg", "a mass"),
    "time": ("s", "s", "a time"),
    "frequency": ("s-1", "Hz", "a frequency"),
    "angle": ("rad", "deg", "an angle"),
    "angular_velocity": ("rad s-1", "deg/s", "an angular velocity"),
    "velocity": ("m s-1", "mm/s", "a velocity"),
    "acceleration": ("m s-2", "g", "an acceleration"),
    "force": ("kg m s-2", "kN", "a force"),
    "inertia": ("kg m2", "kg m^2", "a moment of inertia"),
    "pressure": ("kg m-1 s-2", "GPa", "a pressure"),
    "dimensionless": ("1", "", "a plain number"),
}
"""Dimension: its SI unit, a unit that a laboratory would write, and its name."""

CHANNEL_UNITS = {
    **{"displacement": "mm", "velocity": "mm/s", "acceleration": "m/s²"},
    **{"angle": "mrad", "angular_velocity": "rad/s", "force": "N"},
}
"""What a channel can record, besides `other`, and the unit in which it is written and drawn."""
QUANTITY_DIMENSIONS = {**{name: name for name in CHANNEL_UNITS}, "displacement": "length", "other": None}
"""What a channel can record, and its dimension; `other` may have any."""

# Symbol: SI units in one of it, its dimension as powers of SI units, and further names.
_UNITS = {
    "m": (1.0, "m", "metre meter"),
    "kg": (1.0, "kg", "kilogram"),
    "s": (1.0, "s", "second sec"),
    "rad": (1.0, "rad", "radian"),
    "V": (1.0, "V", "volt v"),
    "A": (1.0, "A", "ampere amp"),
    "count": (1.0, "count", "digit bit LSB"),
    "degC": (1.0, "degC", "celsius"),
    "%": (0.01, "", "percent"),
    "strain": (1.0, "", ""),
    "Hz": (1.0, "s-1", "hertz sps"),
    "min": (60.0, "s", "minute"),
    "g": (9.80665, "m s-2", "gravity G"),
    "Gal": (0.01, "m s-2", ""),
    "N": (1.0, "kg m s-2", "newton"),
    "Pa": (1.0, "kg m-1 s-2", "pascal"),
    "bar": (1e5, "kg m-1 s-2", ""),
    "t": (1000.0, "kg", "tonne"),
    "lb": (0.45359237, "kg", "pound"),
    "in": (0.0254, "m", "inch"),
    "ft": (0.3048, "m", "foot feet"),
    "deg": (0.017453292519943295, "rad", "degree"),
}
_PREFIXES = {"": 1.0, "M": 1e6, "G": 1e9, "k": 1e3, "c": 1e-2, "m": 1e-3, "µ": 1e-6, "u": 1e-6}
_LARGE = ("Pa", "N", "Hz")
"""Units that are recorded in millions: of all others a capital M is a shouted m."""

COMMON = ("mm", "cm", "m", "kg", "s", "ms", "Hz", "g", "Gal", "m/s^2", "mm/s", "V", "mV", "N", "kN", "rad", "deg")
"""Hints at what was meant."""
LARGEST_POWER = 9
"""Sum of the exponents in a unit, without their signs: its factor stays finite."""
_TOKEN = re.compile(r"([^\W\d_]+|%|1(?![0-9]))(?:(?:\^|\*\*)?([+-]?[0-9](?![0-9])))?|(\S)")
_SPELLINGS = str.maketrans("⁰¹²³⁴⁻−·⋅×ºμ", "01234--***°µ")

NUMBER_PATTERN = r"[+\-−]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+\-−]?[0-9]+)?"
_QUANTITY = re.compile(rf"({NUMBER_PATTERN})\s*(.*)", re.DOTALL)


class Unit(NamedTuple):
    """A unit: SI units in one of it, its SI unit as CF writes it ("m s-2"; "1" for a number), its usual spelling."""

    factor: float
    si_unit: str
    symbol: str


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
    if match[2].startswith(","):
        raise UnitError(f"{quoted(text)} has a decimal comma; {quoted(text.replace(',', '.', 1))} was expected.")
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
    return _times(value, factor_to_si(unit, dimension))


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
        kind = next((name for si_unit, _, name in DIMENSIONS.values() if si_unit == found.si_unit), "something else")
        raise UnitError(f"{quoted(unit)} is the unit of {kind}. {expected(dimension)}")
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
    if dimension and product(unit, recorded_unit).si_unit != DIMENSIONS[dimension][0]:
        _, example, wanted = DIMENSIONS[dimension]
        raise UnitError(
            f"{quoted(gain)} times a recorded value in {quoted(recorded_unit)} is not {wanted}. A gain in "
            f'"{example} per {recorded.symbol or 1}" was expected, if {quoted(recorded_unit)} is the unit in the file.'
        )
    return value * per_unit.factor * recorded.factor


def product(first: str, second: str) -> Unit:
    """
    Multiply two units.

    Examples
    --------
    >>> product("mm/V", "mV").si_unit
    'm'
    """
    return resolve(f"{resolve(first).symbol or 1} {resolve(second).symbol or 1}")


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
    return one.si_unit == other.si_unit and isclose(one.factor, other.factor)


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


def _times(value: float, factor: float) -> float:
    """Multiply by a factor; one such as 1/1000 divides instead, so that 86 mm is 0.086 m to the last digit."""
    divisor = round(1.0 / factor) if factor < 1.0 else 1
    return value / divisor if divisor > 1 and abs(divisor * factor - 1.0) < 1e-15 else value * factor


@lru_cache(maxsize=1024)
def resolve(text: str, dimension: str | None = None) -> Unit:
    """Look a unit up, as recorders and people spell it; `dimension` is the one that is wanted, for the message."""
    try:
        powers = _collected(_factors(text))
    except UnitError as error:
        raise UnitError(f"{error} {expected(dimension)}") from None
    known = [(*_known()[symbol], power) for symbol, power in powers.items()]
    base = _collected((si_unit, each * power) for _, _, parts, power in known for si_unit, each in parts.items())
    si_unit = " ".join(f"{name}{'' if power == 1 else power}" for name, power in sorted(base.items()))
    return Unit(prod(factor**power for _, factor, _, power in known), si_unit or "1", _spelled(powers))


def _collected(factors: Iterable[tuple[str, int]]) -> dict[str, int]:
    """Add the exponents of each symbol; what cancels is left out."""
    powers = Counter[str]()
    for name, power in factors:
        powers[name] += power
    return {name: power for name, power in powers.items() if power}


def _spelled(powers: dict[str, int]) -> str:
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
    known, groups, sign, expects, left = _known(), [1], 1, True, LARGEST_POWER
    for name, exponent, mark in _TOKEN.findall(spelled):
        if name:
            power = int(exponent or 1)
            if name != "1":
                # A name of several letters ("Volts", "KN") is taken in any case; one letter is not: M and m differ.
                found = known.get(name) or (known.get(name.casefold()) if len(name) > 1 else None)
                if found is None:
                    raise _unknown(name, text)
                left -= abs(power)
                yield found[0], groups[-1] * sign * power
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


@cache
def _known() -> dict[str, tuple[str, float, dict[str, int]]]:
    """Give symbol, factor and powers of every unit, alone and behind every prefix, by each of its names."""
    found: dict[str, tuple[str, float, dict[str, int]]] = {}
    for prefix, times in _PREFIXES.items():
        for symbol, (factor, written, names) in _UNITS.items():
            if prefix in ("M", "G") and symbol not in _LARGE:
                continue
            powers = {base: int(power or 1) for base, power in re.findall(r"([A-Za-z]+)(-?\d)?", written)}
            # A name may have a plural; "Vs" is no volts.
            each = (symbol, *names.split())
            for name in (*each, *(f"{name}s" for name in each if len(name) > 1)):
                found.setdefault(prefix + name, (prefix.replace("u", "µ") + symbol, times * factor, powers))
    return {name.casefold(): unit for name, unit in reversed(found.items()) if len(name) > 1} | found


def _unknown(name: str, text: str) -> UnitError:
    # A single letter is near to everything short, so it is not a hint for a longer name.
    hint = nearest(name, [unit for unit in COMMON if len(unit) > 1 or len(name) == 1])
    within = "" if name == text else f" in {quoted(text)}"
    return UnitError(f"Unknown unit {quoted(name)}{within}.{hint if 'Did you mean' in hint else ''}")


def expected(dimension: str | None, value: float | None = None) -> str:
    """Say that a quantity of this dimension was expected, with an example."""
    if dimension is None:
        return 'A unit such as "mm", "V" or "m/s^2" was expected.'
    _, example, wanted = DIMENSIONS[dimension]
    shown = example if value is None else f"{value:g} {example}"
    return f"{wanted.capitalize()} was expected{f', such as {quoted(shown)}' if example else ''}."
