"""A CSV list of ground motions: which files, and what their own headers do not say."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from pathlib import Path

from colonnade import units
from colonnade.errors import ReadError, UnitError, quoted
from colonnade.readers import files
from colonnade.readers.small_table import SmallTable, read_table

COLUMNS = ("file", "unit", "interval", "scale", "component", "record", "column", "magnitude", "distance")
"""Heads that a list may have; `file` is needed, and `record` with `component`."""

COMPONENTS = ("x", "y", "z")


@dataclass(frozen=True)
class Entry:
    """
    A file of a set of ground motions, and what is said of it.

    Attributes
    ----------
    path : Path
    place : str
        Its row in the list, or its name in the folder, for messages.
    unit : str or None
        Of the acceleration.
    interval : float or None
        s.
    scale : float
        What its values are multiplied by.
    component : str
        x, y, z, or empty if its name or its columns say it.
    record : str
        Name that the components of a record share; empty if its name says it.
    column : str
        Head of the column, or its number from 1; empty for the only one, or one for each component.
    magnitude, distance : float or None
        Of the earthquake; m.
    """

    path: Path
    place: str
    unit: str | None = None
    interval: float | None = None
    scale: float = 1.0
    component: str = ""
    record: str = ""
    column: str = ""
    magnitude: float | None = None
    distance: float | None = None


@dataclass(frozen=True)
class LeftOut:
    """What of a set is not used, and why."""

    name: str
    reason: str


def read_list(path: Path) -> tuple[list[Entry], list[LeftOut], list[str]]:
    """
    Read a list of records.

    Parameters
    ----------
    path : Path
        CSV with the heads `COLUMNS`, a row each file; units in the heads' brackets, `distance [km]`, or in the cells.

    Returns
    -------
    entries : list of Entry
    left_out : list of LeftOut
        Rows that cannot be used.
    notes : list of str

    Raises
    ------
    ReadError
        If it is no list of records.
    """
    table = read_table(path, "a list of records")
    places, notes = table.places(COLUMNS, "says nothing of a record")
    if "file" not in places:
        raise ReadError(
            f'{table.name}: no column "file". A list of records was expected, with the heads {", ".join(COLUMNS)}.'
        )
    if "component" in places and "record" not in places:
        raise ReadError(f'{table.name}: "component" without "record", the name that the components of a record share.')
    entries, left_out = [], [LeftOut(f"{path.name}, line {line}", fault) for line, fault in table.faults]
    for line, cells in table.rows:
        try:
            entries.append(_entry(path, line, cells, table, places))
        except (ReadError, UnitError) as error:
            left_out.append(LeftOut(f"{path.name}, line {line}", str(error)))
    return entries, left_out, notes


def _entry(path: Path, line: int, cells: tuple[str, ...], table: SmallTable, places: dict[str, int]) -> Entry:
    given = {name: cells[index] for name, index in places.items() if cells[index]}
    if "file" not in given:
        raise ReadError("the cell of the file is empty.")

    def number(name: str, dimension: str = "dimensionless") -> float | None:
        """Read a cell in SI; None if it is empty."""
        if name not in given:
            return None
        text = table.quantity(places[name], given[name])
        try:
            value = units.to_si(text, dimension)
        except UnitError as error:
            raise ReadError(f"{name}: {error}") from None
        if not isfinite(value):
            raise ReadError(f"{name} is {quoted(text)}; a finite number was expected.")
        return value

    component = given.get("component", "").casefold()
    if component and component not in COMPONENTS:
        raise ReadError(f"component is {quoted(component)}; x, y or z (vertical) was expected.")
    scale, interval = number("scale"), number("interval", "time")
    if scale == 0.0:
        raise ReadError("scale is 0; a factor on the accelerations was expected.")
    if interval is not None and not interval > 0.0:
        raise ReadError(f"interval is {interval:g} s; a positive time between samples was expected.")
    unit = table.heads[places["unit"]].unit if "unit" in places else None
    return Entry(
        inside(path.resolve().parent, given["file"]),
        f"{path.name}, line {line}, {given['file']}",
        given.get("unit", unit) or table.heads[places["file"]].unit,
        interval,
        1.0 if scale is None else scale,
        component,
        given.get("record", ""),
        given.get("column", ""),
        number("magnitude"),
        number("distance", "length"),
    )


def inside(folder: Path, text: str) -> Path:
    """Resolve a path of a list, from its folder; ReadError if it is absolute or leaves the folder."""
    try:
        return files.inside(folder, text.replace("\\", "/"), "the folder of the list")
    except ValueError as error:
        raise ReadError(f"{error} A path from there was expected.") from None
