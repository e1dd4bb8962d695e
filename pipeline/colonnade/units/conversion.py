"""Quantities in text to SI, and back."""

from __future__ import annotations

import re
from math import isfinite

from colonnade.errors import UnitError, quoted
from colonnade.units.registry import DIMENSIONS, Unit, article, collected, expected, resolve, words

NUMBER_PATTERN = r"[+\-−]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+\-−]?[0-9]+)?"
_QUANTITY = re.compile(rf"({NUMBER_PATTERN})\s*(.*)", re.DOTALL)
_DECIMAL_COMMA = re.compile(r"[+\-−]?[0-9]+,[0-9]+.*", re.DOTALL)


def parse(text: str) -> tuple[float, str]:
    """
    Split a quantity into its number and its unit, as written.

    Returns
    -------
    value : float
    unit : str
        Empty without a unit.

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


def factor_to_si(unit: str, dimension: str) -> float:
    """
    Give the number of SI units in one `unit`.

    Raises
    ------
    UnitError
        If the unit is not known or not of that dimension.

    Examples
    --------
    >>> factor_to_si("mm", "length"), factor_to_si("g's", "acceleration")
    (0.001, 9.80665)
    """
    found, wanted = resolve(unit, dimension), resolve(DIMENSIONS[dimension][0])
    if found.dimension != wanted.dimension:
        raise UnitError(f"{quoted(unit)} is {_told(found)}. {expected(dimension)}")
    return found.factor


def gain_to_si(gain: str, recorded_unit: str, dimension: str) -> float:
    """
    Give the SI value of one recorded unit, as in the file, after a transducer's gain.

    Parameters
    ----------
    gain : str
        Physical over recorded, such as ``"10.02 mm/V"``; ``"-1"`` turns the sign of a recorded length.
    recorded_unit : str
        Such as ``"V"`` or ``"mV"``.
    dimension : str
        Of the physical quantity, a key of `DIMENSIONS`.

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
    per_unit, recorded, wanted = resolve(unit), resolve(recorded_unit), resolve(DIMENSIONS[dimension][0])
    if _product(per_unit, recorded) != wanted.dimension:
        below = f"({recorded.symbol})" if {"/", " "} & set(recorded.symbol) else recorded.symbol
        example = f"{DIMENSIONS[dimension][1]}/{below}" if below else DIMENSIONS[dimension][1]
        doubt = f" Is {quoted(recorded_unit)} the unit of the values in the file?" if "/" in recorded.symbol else ""
        raise UnitError(
            f"{quoted(gain)} times a recorded value in {quoted(recorded_unit)} is not {article(dimension)}. "
            f'A gain in "{example}" was expected.{doubt}'
        )
    factor = value * per_unit.factor * recorded.factor
    if not isfinite(factor):
        raise UnitError(f"{quoted(gain)} is too large.")
    return factor


def si_factor(unit: str) -> tuple[float, str]:
    """
    Convert a unit of any dimension.

    Returns
    -------
    factor : float
        SI units in one `unit`.
    si_unit : str
        In the notation of CF, such as ``"m s-2"``; ``"1"`` where it has no dimension.

    Raises
    ------
    UnitError
        If the unit is not known.

    Examples
    --------
    >>> si_factor("g"), si_factor("mV")
    ((9.80665, 'm s-2'), (0.001, 'V'))
    """
    found = resolve(unit)
    return found.factor, " ".join(f"{name}{'' if power == 1 else power}" for name, power in found.dimension) or "1"


def normalise_unit(text: str) -> str:
    """
    Give a unit's usual spelling.

    Raises
    ------
    UnitError
        If it is not known.

    Examples
    --------
    >>> [normalise_unit(unit) for unit in ("g's", "Volts", "m/sec2", "mm.", "°")]
    ['g', 'V', 'm/s^2', 'mm', 'deg']
    """
    return resolve(text).symbol


def same_unit(first: str, second: str) -> bool:
    """
    Whether two spellings mean the same unit; false if one is unknown and they differ.

    Examples
    --------
    >>> same_unit("g's", "g"), same_unit("mV", "V"), same_unit("furlong", "mm")
    (True, False, False)
    """
    if first.strip() == second.strip():
        return True
    try:
        one, other = resolve(first), resolve(second)
    except UnitError:
        return False
    return one.dimension == other.dimension and abs(one.factor - other.factor) <= 1e-9 * abs(one.factor)


def is_of(unit: str, dimension: str) -> bool:
    """
    Whether a unit is known and of a dimension.

    Examples
    --------
    >>> is_of("g", "acceleration"), is_of("mm", "acceleration"), is_of("", "length")
    (True, False, False)
    """
    try:
        factor_to_si(unit, dimension)
    except UnitError:
        return False
    return True


def is_physical(unit: str) -> bool:
    """
    Whether a unit is known and that of a physical quantity, neither a recorder's counts nor a plain number.

    Examples
    --------
    >>> is_physical("mm/V"), is_physical("counts"), is_physical("furlong")
    (True, False, False)
    """
    try:
        dimension = dict(resolve(unit).dimension)
    except UnitError:
        return False
    return bool(dimension.keys() - {"count"})


def from_si(value: float, unit: str) -> float:
    """
    Express an SI value in `unit`.

    Raises
    ------
    UnitError
        If the unit is not known.

    Examples
    --------
    >>> from_si(0.086, "mm")
    86.0
    """
    return _times(value, 1.0 / resolve(unit).factor)


def _times(value: float, factor: float) -> float:
    """Multiply by a factor; one such as 1/1000 divides instead, so that 86 mm is 0.086 m to the last digit."""
    divisor = round(1.0 / factor) if factor < 1.0 else 1
    return value / divisor if divisor > 1 and abs(divisor * factor - 1.0) < 1e-15 else value * factor


def _product(one: Unit, other: Unit) -> tuple[tuple[str, int], ...]:
    return tuple(sorted(collected((*one.dimension, *other.dimension)).items()))


def _told(unit: Unit) -> str:
    for dimension, (si_unit, _) in DIMENSIONS.items():
        if resolve(si_unit).dimension == unit.dimension:
            return "without dimension" if dimension == "dimensionless" else f"a unit of {words(dimension)}"
    return "of another kind"
