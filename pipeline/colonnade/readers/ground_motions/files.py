"""The files of a set of ground motions: a list of them or a folder, what names say, the components that each holds."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from colonnade import units
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError, UnitError, count, quoted
from colonnade.readers.files import inside, sha256_of, unreachable
from colonnade.readers.motion import read_motions
from colonnade.readers.registry import companions
from colonnade.readers.small_table import SmallTable, read_table

COLUMNS = ("file", "unit", "interval", "scale", "component", "record", "column", "magnitude", "distance")
"""Heads that a list may have; `file` is needed, and `record` with `component`."""
NUMBERS = {"interval": "time", "scale": "dimensionless", "magnitude": "dimensionless", "distance": "length"}
"""Those of numbers, with their dimensions."""


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


class LeftOut(NamedTuple):
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
        except (ReadError, ValueError) as error:
            left_out.append(LeftOut(f"{path.name}, line {line}", str(error)))
    return entries, left_out, notes


def _entry(path: Path, line: int, cells: tuple[str, ...], table: SmallTable, places: dict[str, int]) -> Entry:
    given = {name: cells[index] for name, index in places.items() if cells[index]}
    if "file" not in given:
        raise ReadError("the cell of the file is empty.")

    numbers: dict[str, float] = {}
    for name, dimension in NUMBERS.items():
        if name in given:
            text = table.quantity(places[name], given[name])
            try:
                numbers[name] = units.to_si(text, dimension)
            except UnitError as error:
                raise ReadError(f"{name}: {error}") from None
            if not isfinite(numbers[name]):
                raise ReadError(f"{name} is {quoted(text)}; a finite number was expected.")
    component = given.get("component", "").casefold()
    if component not in ("", "x", "y", "z"):
        raise ReadError(f"component is {quoted(component)}; x, y or z (vertical) was expected.")
    if numbers.get("scale") == 0.0:
        raise ReadError("scale is 0; a factor on the accelerations was expected.")
    if not numbers.get("interval", 1.0) > 0.0:
        raise ReadError(f"interval is {numbers['interval']:g} s; a positive time between samples was expected.")
    unit = table.heads[places["unit"]].unit if "unit" in places else None
    return Entry(
        inside(path.resolve().parent, given["file"].replace("\\", "/"), "the folder of the list"),
        f"{path.name}, line {line}, {given['file']}",
        unit=given.get("unit", unit) or table.heads[places["file"]].unit,
        component=component,
        record=given.get("record", ""),
        column=given.get("column", ""),
        **numbers,
    )


class Named(NamedTuple):
    """What a name says: itself without a direction; x, y, z or an azimuth in degrees, such as "180", or nothing."""

    record: str
    direction: str


_DIRECTIONS = {
    **dict.fromkeys(("x", "ew", "e-w", "we", "e", "east", "h1", "lon", "long", "longitudinal", "l"), "x"),
    **dict.fromkeys(("y", "ns", "n-s", "sn", "n", "north", "h2", "tra", "tran", "trans", "transverse", "t"), "y"),
    **dict.fromkeys(("z", "ud", "u-d", "up", "v", "ver", "vert", "vertical", "dwn", "down"), "z"),
}
_WORDS = "|".join(sorted(map(re.escape, _DIRECTIONS), key=len, reverse=True))
_SEPARATED = re.compile(rf"(?P<record>.*[^A-Za-z])(?P<direction>{_WORDS})|(?P<alone>{_WORDS})", re.IGNORECASE)
"""`lefkada_x`, `I-ELC-UP`, `station 3 NS`."""
_CHANNEL = re.compile(r"(?P<record>(?:.*[-_. ])?[BCEHLMS][HLGNP])(?P<direction>[ENZ])(?P<rest>[-_. ].*|)")
"""Codes of seismic channels, `KRP.HNE`."""
_AZIMUTH = re.compile(r"(?P<record>.*[^0-9])(?P<direction>\d{3})")
"""PEER's `RSN6_IMPVALL.I_I-ELC180`."""
_SUFFIX = re.compile(r"(?P<record>.+)\.(?P<direction>EW|NS|UD)(?P<rest>[12]?)", re.IGNORECASE)
"""K-NET's `AOM0011903.EW`; with 1 or 2 KiK-net's, in the borehole and at the surface."""


def named(file_name: str) -> Named:
    """
    Read the name of a file.

    Examples
    --------
    >>> named("RSN6_I-ELC180.AT2"), named("RSN6_I-ELC-UP.AT2")
    (Named(record='RSN6_I-ELC', direction='180'), Named(record='RSN6_I-ELC', direction='z'))
    >>> named("AOM0011903.EW"), named("pulse.csv")
    (Named(record='AOM0011903', direction='x'), Named(record='pulse', direction=''))
    """
    if found := _SUFFIX.fullmatch(file_name):
        return Named(found["record"] + found["rest"], _DIRECTIONS[found["direction"].casefold()])
    stem, _, suffix = file_name.rpartition(".")
    stem = stem or suffix
    found_in_stem = direction_of(stem)
    if found_in_stem.direction:
        return found_in_stem._replace(record=found_in_stem.record or stem)
    if suffix.casefold() == "at2" and (azimuth := _AZIMUTH.fullmatch(stem)):
        return Named(azimuth["record"].rstrip("-_. "), azimuth["direction"])
    return Named(stem, "")


def direction_of(text: str) -> Named:
    """Read the name of a file without its ending, or of a column."""
    bare = re.sub(r"\s*[\[(][^\])]*[\])]\s*$", "", text).strip()
    if found := _SEPARATED.fullmatch(bare):
        word = found["direction"] or found["alone"]
        return Named((found["record"] or "").rstrip("-_. "), _DIRECTIONS[word.casefold()])
    if found := _CHANNEL.fullmatch(bare):
        return Named(found["record"] + found["rest"], {"E": "x", "N": "y", "Z": "z"}[found["direction"]])
    return Named(bare, "")


LARGEST_FILE = 200_000_000
"""Bytes."""
FEWEST_SAMPLES = 10
LONGEST_INTERVAL = 0.2
"""s; nothing coarser is a record of a column's base."""
LARGEST_ACCELERATION = 1000.0
"""m/s²; no ground moves so, a wrong unit does."""


class Component(NamedTuple):
    """A component as it was read: the entry with its direction and record filled in, and what its file hashes to."""

    entry: Entry
    motion: Motion
    files: tuple[tuple[str, str], ...]


def in_folder(folder: Path) -> tuple[list[Entry], list[LeftOut], list[str]]:
    """Give the files of a folder, by name, as `read_list` does; folders in it and hidden files do not count."""
    entries, left_out, root = [], [], folder.resolve()
    try:
        for path in sorted(folder.iterdir()):
            if path.name.startswith(".") or path.is_dir():
                continue
            try:
                entries.append(Entry(inside(root, path.name, "this folder"), path.name))
            except ValueError:
                left_out.append(LeftOut(path.name, "it is a link to outside this folder. Put the file itself there."))
    except OSError as error:
        raise ReadError(unreachable(folder, error)) from None
    return entries, left_out, []


def components_of(entry: Entry, notes: list[str]) -> Iterator[Component]:
    """Read what an entry names; each column that may be an acceleration is a component."""
    path = entry.path
    if path.is_file() and (size := path.stat().st_size) > LARGEST_FILE:
        raise ReadError(f"{size:.3g} bytes are too many for a record; at most {LARGEST_FILE:.3g} were expected.")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        column = int(entry.column) if entry.column.isdecimal() else entry.column or None
        motions = read_motions(path, unit=entry.unit, dt=entry.interval, column=column)
    notes += dict.fromkeys(str(each.message) for each in told)
    files = tuple((each.name, sha256_of(each) or "") for each in (path, *companions(path)))
    record, direction = named(path.name)
    if len(motions) > 1 and (entry.component or not all(direction_of(head).direction for head in motions)):
        heads = ", ".join(f'"{head}"' for head in motions)
        raise ReadError(
            f"{len(motions)} columns may be accelerations ({heads}), and which is which is not clear. Name one in each "
            'row of a list, in the columns "column", "component" and "record".'
        )
    for head, motion in motions.items():
        own = direction_of(head).direction if len(motions) > 1 else direction
        whole = path.stem if len(motions) > 1 else record
        given = replace(entry, component=entry.component or own, record=entry.record or whole)
        yield Component(given, _usable(motion, entry.scale), files)


def _usable(motion: Motion, scale: float) -> Motion:
    """Return a component times its scale, if it can be the motion of a column's base."""
    if motion.acceleration.size < FEWEST_SAMPLES:
        raise ReadError(f"it has {count(motion.acceleration.size, 'sample')}; at least {FEWEST_SAMPLES} were expected.")
    if motion.dt > LONGEST_INTERVAL:
        raise ReadError(f"its samples are {motion.dt:.3g} s apart; at most {LONGEST_INTERVAL:g} s were expected.")
    scaled = motion if scale == 1.0 else Motion(scale * motion.acceleration, motion.dt)
    if not scaled.peak > 0.0:
        raise ReadError("it does not move: all accelerations are 0.")
    if scaled.peak > LARGEST_ACCELERATION:
        raise ReadError(
            f"its peak is {scaled.peak:.3g} m/s²; at most {LARGEST_ACCELERATION:g} m/s² was expected. Check its unit."
        )
    return scaled
