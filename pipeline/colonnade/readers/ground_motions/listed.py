"""A CSV list of ground motions: which files, and what their own headers do not say."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from difflib import get_close_matches
from math import isfinite
from pathlib import Path, PureWindowsPath

from colonnade import units
from colonnade.errors import ReadError, UnitError, nearest, quoted
from colonnade.readers.ground_motions.table import Head, SmallTable, read_table

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
    places, notes = _columns(table)
    entries, left_out = [], [LeftOut(f"{path.name}, line {line}", fault) for line, fault in table.faults]
    for line, cells in table.rows:
        given = {name: cells[index] for name, index in places.items() if cells[index]}
        try:
            entries.append(_entry(path, line, given, {name: table.heads[index] for name, index in places.items()}))
        except (ReadError, UnitError) as error:
            left_out.append(LeftOut(f"{path.name}, line {line}", str(error)))
    return entries, left_out, notes


def _columns(table: SmallTable) -> tuple[dict[str, int], list[str]]:
    """Index of each column that is known, and notes on those that are not."""
    places: dict[str, int] = {}
    notes = []
    for index, head in enumerate(table.heads):
        name = head.name.casefold()
        if name in places:
            raise ReadError(f"{table.name}: duplicate column head {quoted(name)}.")
        if name in COLUMNS:
            places[name] = index
        elif get_close_matches(name, COLUMNS, n=1, cutoff=0.75):
            raise ReadError(f"{table.name}: unknown column {quoted(head.name)}.{nearest(head.name, COLUMNS)}")
        elif name:
            notes.append(f"{table.name}: column {quoted(head.name)} says nothing of a record; it is ignored.")
    if "file" not in places:
        raise ReadError(
            f'{table.name}: no column "file". A list of records was expected, with the heads {", ".join(COLUMNS)}.'
        )
    if "component" in places and "record" not in places:
        raise ReadError(f'{table.name}: "component" without "record", the name that the components of a record share.')
    return places, notes


def _entry(path: Path, line: int, given: dict[str, str], heads: dict[str, Head]) -> Entry:
    if "file" not in given:
        raise ReadError("the cell of the file is empty.")
    component = given.get("component", "").casefold()
    if component and component not in COMPONENTS:
        raise ReadError(f"component is {quoted(component)}; x, y or z (vertical) was expected.")
    scale = _number(given, heads, "scale", _plain)
    if scale == 0.0:
        raise ReadError("scale is 0; a factor on the accelerations was expected.")
    interval = _number(given, heads, "interval", lambda text: units.to_si(text, "time"))
    if interval is not None and not interval > 0.0:
        raise ReadError(f"interval is {interval:g} s; a positive time between samples was expected.")
    head_of_files = heads["file"].unit
    return Entry(
        inside(path.resolve().parent, given["file"]),
        f"{path.name}, line {line}, {given['file']}",
        given.get("unit", heads["unit"].unit if "unit" in heads else None) or head_of_files,
        interval,
        1.0 if scale is None else scale,
        component,
        given.get("record", ""),
        given.get("column", ""),
        _number(given, heads, "magnitude", _plain),
        _number(given, heads, "distance", lambda text: units.to_si(text, "length")),
    )


def inside(folder: Path, text: str) -> Path:
    """
    Resolve a path of a list, from its folder.

    Raises
    ------
    ReadError
        If it is absolute or leaves the folder, be it through a link.
    """
    text = text.replace("\\", "/")
    if text.startswith("/") or PureWindowsPath(text).drive:
        raise ReadError(f"{quoted(text)} is an absolute path; one from the folder of the list was expected.")
    try:
        path = (folder / text).resolve()
    except (OSError, RuntimeError, ValueError) as error:
        raise ReadError(f"{quoted(text)} is an invalid path ({error}).") from None
    if not path.is_relative_to(folder) or path == folder:
        raise ReadError(f"{quoted(text)} is outside the folder of the list. Put the file there.")
    return path


def _number(given: dict[str, str], heads: dict[str, Head], name: str, read: Callable[[str], float]) -> float | None:
    """Read a cell as a number, in the unit of its head if it has none of its own; None if it is empty."""
    if name not in given:
        return None
    text = given[name]
    unit = heads[name].unit
    if unit and _is_number(text):
        text = f"{text} {unit}"
    try:
        value = read(text)
    except UnitError as error:
        raise ReadError(f"{name}: {error}") from None
    if not isfinite(value):
        raise ReadError(f"{name} is {quoted(text)}; a finite number was expected.")
    return value


def _plain(text: str) -> float:
    return units.to_si(text, "dimensionless")


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
