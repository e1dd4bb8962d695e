"""What a column measures, and on which body, by its unit and its name."""

from __future__ import annotations

import re
from dataclasses import dataclass

from colonnade import units
from colonnade.campaign.draft.survey import Column
from colonnade.campaign.draft.vocabulary import LEFT_OUT, PLACES, QUANTITIES, axis, find, words
from colonnade.errors import UnitError

_OF_DIMENSION = {
    units.si_factor(units.DIMENSIONS[dimension][0])[1]: quantity
    for quantity, dimension in units.QUANTITY_DIMENSIONS.items()
    if dimension is not None
}

# What readers say themselves: a column that has no name, a block of a file.
_NUMBERED = re.compile(r"^(?:column \d+$|block \d+: )")

PLACE_OF = {"displacement": "specimen", "acceleration": "table", "velocity": "table"}
"""Where a transducer most often is, if no evidence."""


@dataclass(frozen=True)
class Meaning:
    """
    The meaning given to a column.

    Attributes
    ----------
    column : Column
    left_out : str
        Why it is not a channel; empty if it is one.
    quantity : str or None
        None if nothing shows it.
    place : str or None
        "specimen", "table" or "ground"; None if nothing shows it.
    axis : str or None
        "x", "y" or "z", if the name says so.
    because : str
        What shows the quantity.
    place_word : str
        What shows the place.
    unit_known, is_physical : bool
        Whether the file's unit is known and is a unit of the quantity, not of a voltage.
    conflict : str
        How name and unit contradict each other.
    """

    column: Column
    left_out: str = ""
    quantity: str | None = None
    place: str | None = None
    axis: str | None = None
    because: str = ""
    place_word: str = ""
    unit_known: bool = False
    is_physical: bool = False
    conflict: str = ""


def meaning(column: Column) -> Meaning:
    """Find out what a column is from its unit, its name and what its signal looks like."""
    if column.is_clock:
        return Meaning(column, left_out="the clock")
    if column.shape.is_dead:
        held = "it never changes" if column.shape.spread == 0.0 else "it holds no number"
        return Meaning(column, left_out=f"{held} in any of these files")
    parts = words(_NUMBERED.sub("", column.name))
    by_name, by_unit, known = find(parts, QUANTITIES), _by_unit(column.unit), _is_known(column.unit)
    place = find(parts, PLACES)
    if by_unit is None and (reason := _no_measurement(column, parts, named=by_name is not None)):
        return Meaning(column, left_out=reason)
    quantity = by_unit or (by_name[0] if by_name else None)
    conflict = ""
    if by_unit and by_name and by_unit != by_name[0]:
        conflict = f'its unit "{column.unit}" says {by_unit}, its name "{by_name[1]}" {by_name[0]}'
    return Meaning(
        column,
        quantity=quantity,
        place=place[0] if place else None,
        axis=axis(column.name),
        because=f'from its unit "{column.unit}"' if by_unit else f'from "{by_name[1]}" in its name' if by_name else "",
        place_word=f'from "{place[1]}" in its name' if place else "",
        unit_known=known,
        is_physical=by_unit is not None,
        conflict=conflict,
    )


def _by_unit(unit: str | None) -> str | None:
    if not unit:
        return None
    try:
        return _OF_DIMENSION.get(units.si_factor(unit)[1])
    except UnitError:
        return None


def _is_known(unit: str | None) -> bool:
    if not unit:
        return False
    try:
        units.normalise_unit(unit)
    except UnitError:
        return False
    return True


def _no_measurement(column: Column, parts: list[str], *, named: bool) -> str:
    if column.shape.counts:
        return "a running number: it rises by one from sample to sample"
    found = None if named else find(parts, LEFT_OUT)
    return f'{found[0]}, from "{found[1]}" in its name' if found else ""
