"""Names with a quantity in brackets, such as "sa(0.5 s)" and "highpass(0.1 Hz)"."""

from __future__ import annotations

from colonnade import units
from colonnade.errors import UnitError


def split_name(name: str) -> tuple[str, str | None]:
    """
    Split a name from what is in its brackets.

    Examples
    --------
    >>> split_name("sa(0.5 s)"), split_name("pga")
    (('sa', '0.5 s'), ('pga', None))
    """
    bare, bracket, rest = name.partition("(")
    if not bracket or not rest.endswith(")"):
        return name.strip(), None
    return bare.strip(), rest[:-1].strip()


def quantity_of(name: str, given: str, dimension: str) -> float:
    """
    Give the positive quantity in the brackets of a name in SI.

    Raises
    ------
    ValueError
        If it is not one.
    """
    try:
        value = units.to_si(given, dimension)
    except UnitError as error:
        raise ValueError(f'"{name}": {error}') from None
    if not value > 0:
        raise ValueError(f'"{name}": {given} was found in the brackets; a positive {dimension} was expected')
    return value
