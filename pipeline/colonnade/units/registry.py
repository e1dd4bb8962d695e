"""
The units of laboratories: their own registry, and the spellings that recorders use.

`g` is the gravity unit 9.80665 m/s², never the gram, and `Gal` is 1 cm/s², never the gallon. Angles have a dimension
here, so that rad/s and Hz are not taken for each other.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from math import isfinite
from typing import TYPE_CHECKING, Any

from colonnade.errors import UnitError, nearest, quoted
from colonnade.units.dimensions import expected

if TYPE_CHECKING:
    import pint

DEFINITIONS = """
nano- = 1e-9 = n-
micro- = 1e-6 = µ- = μ- = u-
milli- = 1e-3 = m-
centi- = 1e-2 = c-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
metre = [length] = m = meter
kilogram = [mass] = kg = Kg = KG
second = [time] = s = sec
radian = [angle] = rad
volt = [voltage] = V = v
ampere = [current] = A = amp
count = [count] = _ = digit = bit = LSB
celsius = [temperature] = degC
percent = 0.01 = %
strain = 1
hertz = 1 / second = Hz = hz = HZ = sps
minute = 60 * second = min
hour = 3600 * second = h
gravity = 9.80665 * metre / second ** 2 = g = G
gal = 0.01 * metre / second ** 2 = Gal = GAL
newton = kilogram * metre / second ** 2 = N
kilogram_force = 9.80665 * newton = kgf
pound_force = 4.4482216152605 * newton = lbf
pascal = newton / metre ** 2 = Pa
bar = 1e5 * pascal
tonne = 1000 * kilogram = t
pound = 0.45359237 * kilogram = lb
inch = 0.0254 * metre = in
foot = 0.3048 * metre = ft = feet
degree = 0.017453292519943295 * radian = deg
revolution = 6.283185307179586 * radian = rev
rpm = revolution / minute
"""

# Hints at what was meant.
COMMON = ("mm", "cm", "m", "kg", "s", "ms", "Hz", "g", "Gal", "m/s^2", "mm/s", "V", "mV", "N", "kN", "rad", "deg")
SHOUTED = {"KN": "kN", "KPA": "kPa", "MPA": "MPa", "GPA": "GPa", "MG": "mg"}
"""Units in capitals that can only be one: nobody records 10⁶ g or 10⁻³ Pa."""
UNCLEAR = {"MV": "mV", "MA": "mA", "Mg": "mg", "NM": "N m"}
"""Units that may be another one, which is more likely; they are asked about."""
LARGEST_POWER = 9
LONGEST = 100
"""Characters of a unit."""
_TOKEN = re.compile(r"\s*(?:([^\W\d_]+|%|1(?![0-9]))(?:(?:\^|\*\*)?([+-]?[0-9](?![0-9])))?|(\*|/|\(|\)))")
_SPELLINGS = str.maketrans(
    {
        "⁰": "^0", "¹": "^1", "²": "^2", "³": "^3", "⁴": "^4", "⁻": "^-",
        "−": "-", "·": "*", "⋅": "*", "×": "*", "º": "°",
    }
)  # fmt: skip


@dataclass(frozen=True)
class Unit:
    """A unit: SI units in one of it, its dimension as powers of SI units, and its usual spelling."""

    factor: float
    dimension: tuple[tuple[str, int], ...]
    symbol: str


@lru_cache(maxsize=1024)
def resolve(text: str, dimension: str | None = None) -> Unit:
    """
    Look a unit up.

    Parameters
    ----------
    text : str
        As a recorder or a person spells it.
    dimension : str, optional
        The dimension that is wanted, for the message only.

    Raises
    ------
    UnitError
        If it is not known.
    """
    if len(text) > LONGEST:
        raise _unknown(text, text, dimension)
    powers = collected(_factors(text, dimension))
    registry = _registry()
    try:
        quantity: Any = registry.Quantity(1.0, registry.UnitsContainer(powers)).to_root_units()
    except OverflowError:
        raise _unknown(text, text, dimension) from None
    factor = float(quantity.magnitude)
    if not (isfinite(factor) and factor > 0.0) or any(abs(power) > LARGEST_POWER for power in powers.values()):
        raise _unknown(text, text, dimension)
    base = sorted((str(registry.get_symbol(name)), round(power)) for name, power in quantity.unit_items())
    return Unit(factor, tuple(base), _spelled(powers))


def collected(factors: Iterable[tuple[str, int]]) -> dict[str, int]:
    """Add the exponents of each symbol; what cancels is left out."""
    powers: dict[str, int] = {}
    for name, power in factors:
        powers[name] = powers.get(name, 0) + power
    return {name: power for name, power in powers.items() if power}


def _spelled(powers: Mapping[str, int]) -> str:
    """Write a unit as usual: factors above, then each below after a slash."""
    above = [_power(name, power) for name, power in powers.items() if power > 0]
    below = [_power(name, -power) for name, power in powers.items() if power < 0]
    return "/".join([" ".join(above) if above or not below else "1", *below])


def _power(name: str, power: int) -> str:
    return name if power == 1 else f"{name}^{power}"


def _factors(text: str, dimension: str | None) -> list[tuple[str, int]]:
    """Symbols and exponents of a unit, read from left to right; a group in parentheses counts as one factor."""
    spelled = re.sub(r"['’]s\b|(?<=[^\W\d_])\.(?![^\W\d_])", "", text.translate(_SPELLINGS).strip())
    spelled = re.sub(r"\b(kg|k?N)m(?![^\W\d_])", r"\1*m", spelled)
    spelled = re.sub(r"°\s*C\b", "degC", spelled).replace("°", "deg").replace(".", "*")
    if spelled in {"", "-", "1"}:
        return []
    found: list[tuple[str, int]] = []
    signs, sign, position, expects = [1], 1, 0, True
    while position < len(spelled):
        match = _TOKEN.match(spelled, position)
        if match is None:
            raise _unknown(text, text, dimension)
        name, exponent, mark = match.groups()
        position = match.end()
        if name is not None:
            power = int(exponent or 1)
            if name != "1":
                found.append((_symbol(name, text, dimension), signs[-1] * sign * power))
            sign, expects = 1, False
        elif mark == "(":
            signs.append(signs[-1] * sign)
            sign, expects = 1, True
        elif expects or (mark == ")" and len(signs) == 1):
            raise _unknown(text, text, dimension)
        elif mark == ")":
            signs.pop()
            expects = False
        else:
            sign, expects = (-1 if mark == "/" else 1), True
    if expects or len(signs) != 1:
        raise _unknown(text, text, dimension)
    return found


def _symbol(name: str, text: str, dimension: str | None) -> str:
    import pint

    if name in UNCLEAR:
        raise UnitError(f"Unknown unit {quoted(name)}: it may be two. Did you mean {quoted(UNCLEAR[name])}?")
    known = SHOUTED.get(name, name)
    # A spelled-out or shouted unit ("Volts", "MM", "SEC") is taken in lower case; one letter is not: M and m differ.
    for spelling in (known, name.lower(), SHOUTED.get(name.upper(), known)) if len(name) > 1 else (name,):
        try:
            return str(_registry().get_symbol(spelling))
        except pint.UndefinedUnitError:
            continue
    raise _unknown(name, text, dimension)


@cache
def _registry() -> pint.UnitRegistry[Any]:
    import pint

    return pint.UnitRegistry(DEFINITIONS.strip().splitlines(), cache_folder=None)


def _unknown(name: str, text: str, dimension: str | None) -> UnitError:
    # A single letter is near to everything short, so it is not a hint for a longer name.
    hint = "" if len(name) > LONGEST else nearest(name, [unit for unit in COMMON if len(unit) > 1 or len(name) == 1])
    within = "" if name == text else f" in {quoted(text)}"
    return UnitError(
        f"Unknown unit {quoted(name)}{within}.{hint if 'Did you mean' in hint else ''} "
        + (expected(dimension) if dimension else 'A unit such as "mm", "V" or "m/s^2" was expected.')
    )
