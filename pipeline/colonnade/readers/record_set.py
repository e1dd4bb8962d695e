"""A set of ground motions, a folder or a list of files of any format, as records of up to three components."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from colonnade import units
from colonnade.dynamics.motion import Motion
from colonnade.errors import ColonnadeError, ReadError, UnitError, quoted
from colonnade.readers.files import in_one_line, inside, sha256_of, unreachable
from colonnade.readers.motion import read_motions
from colonnade.readers.registry import companions
from colonnade.readers.small_table import SmallTable, read_table

COLUMNS = ("file", "unit", "interval", "scale", "component", "record", "column", "magnitude", "distance")
"""Heads that a list may have; `file` is needed, and `record` with `component`."""
NUMBERS = {"interval": "time", "scale": "dimensionless", "magnitude": "dimensionless", "distance": "length"}
"""Those of numbers, with their dimensions."""
MOST_FILES = 2000
LARGEST_FILE = 200_000_000
"""Bytes."""
MOST_SAMPLES = 20_000_000
"""Of all records together."""
FEWEST_SAMPLES = 10
LONGEST_INTERVAL = 0.2
"""s; nothing coarser is a record of a column's base."""
LARGEST_ACCELERATION = 1000.0
"""m/s²; no ground moves so, a wrong unit does."""
SAME_STEP = 1e-3
"""Largest difference of the steps of the components of a record, as a share."""


@dataclass(frozen=True)
class GroundMotion:
    """
    A record.

    Attributes
    ----------
    name : str
    motion : Motion
        m/s², with the files' own signs: `acceleration` is the first horizontal component, `transverse` the second.
    components : tuple of str
        What the components are called, in the order acceleration, transverse, vertical of those that are there: x, y,
        z, or an azimuth; empty if nothing says it.
    files : tuple of (str, str)
        Name of each file, and its SHA-256.
    magnitude, distance : float or None
        Of the earthquake; m.
    """

    name: str
    motion: Motion
    components: tuple[str, ...]
    files: tuple[tuple[str, str], ...]
    magnitude: float | None = None
    distance: float | None = None


@dataclass(frozen=True)
class RecordSet:
    """
    Ground motions, what was left out of them, and what else is to be said.

    Attributes
    ----------
    records : tuple of GroundMotion
        By name.
    left_out : mapping of str to str
        Files, rows and records, each with the reason.
    notes : tuple of str
    """

    records: tuple[GroundMotion, ...]
    left_out: Mapping[str, str]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Entry:
    """
    A file of a set of ground motions, and what is said of it.

    `place` is its row in the list, or its name in the folder, for messages; `column` the head or number, from 1, of the
    column, empty for the only one or one for each component. What is empty the names of files and columns may say.
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


def files_of(path: Path) -> list[Path]:
    """
    List the files of a set of ground motions: the list itself, and the other files that a record is in, too.

    Raises
    ------
    ReadError
        If there is no such folder or list, or the list is none.
    """
    entries = [entry.path for entry in _entries(path, {}, [])]
    if path.is_dir():
        return entries
    listed = [path, *entries]
    for each in entries:
        with suppress(ReadError, OSError):
            listed += companions(each)
    return list(dict.fromkeys(listed))


def read_record_set(path: Path | str) -> RecordSet:
    """
    Read a set of ground motions.

    Parameters
    ----------
    path : Path or str
        A folder, whose files of any format are read (those in folders within it, and hidden ones, do not count), or a
        CSV list with the heads `COLUMNS`, a row each file. In a folder the names of the files, or of their columns, say
        which belong together: `lefkada_x`, `I-ELC180`, `AOM001.EW`, `KRP.HNE`.

    Returns
    -------
    records : RecordSet
        What cannot be used is left out, by name and with its reason; the rest is not affected.

    Raises
    ------
    ReadError
        If there is no such folder or list, the list is none, or it has more than `MOST_FILES` files.

    Notes
    -----
    Components of a record are cut to the shortest of them. Of a record without a direction in its name, its one
    component is taken as the first horizontal one.
    """
    path = Path(path)
    left_out: dict[str, str] = {}
    notes: list[str] = []
    entries = _entries(path, left_out, notes)
    if len(entries) > MOST_FILES:
        raise ReadError(f"{path.name}: {len(entries)} files are too many; a set of at most {MOST_FILES} was expected.")
    grouped: dict[str, list[_Component]] = {}
    samples = 0
    for entry in entries:
        try:
            found = list(_components(entry, notes)) if samples <= MOST_SAMPLES else []
            samples += sum(component.motion.acceleration.size for component in found)
            if samples > MOST_SAMPLES:
                raise ReadError(f"with it the set has more than {MOST_SAMPLES:.3g} samples. Divide the set.")
            for component in found:
                grouped.setdefault(component.entry.record, []).append(component)
        except (ColonnadeError, ValueError) as error:
            left_out[entry.place] = str(error).removeprefix(f"{entry.place}: ")
        except (OSError, MemoryError) as error:
            left_out[entry.place] = in_one_line(error)
    records = []
    for name, members in grouped.items():
        try:
            records.append(_joined(name, members, left_out, notes))
        except ReadError as error:
            left_out[name] = str(error)
    return RecordSet(tuple(sorted(records, key=lambda record: record.name)), left_out, tuple(notes))


def _entries(path: Path, left_out: dict[str, str], notes: list[str]) -> list[Entry]:
    """The files of a folder, by name, or those of a list; rows and links that cannot be used are left out."""
    if not path.is_dir():
        return read_list(path, left_out, notes)
    entries, root = [], path.resolve()
    try:
        for each in sorted(path.iterdir()):
            if each.name.startswith(".") or each.is_dir():
                continue
            try:
                entries.append(Entry(inside(root, each.name, "this folder"), each.name))
            except ValueError:
                left_out[each.name] = "it is a link to outside this folder. Put the file itself there."
    except OSError as error:
        raise ReadError(unreachable(path, error)) from None
    return entries


def read_list(path: Path, left_out: dict[str, str], notes: list[str]) -> list[Entry]:
    """Read a list of records; ReadError if it is none."""
    table = read_table(path, "a list of records")
    places, said = table.places(COLUMNS, "says nothing of a record")
    notes += said
    if "file" not in places:
        raise ReadError(
            f'{table.name}: no column "file". A list of records was expected, with the heads {", ".join(COLUMNS)}.'
        )
    if "component" in places and "record" not in places:
        raise ReadError(f'{table.name}: "component" without "record", the name that the components of a record share.')
    entries = []
    for line, cells in table.rows:
        try:
            entries.append(_entry(path, line, cells, table, places))
        except (ReadError, ValueError) as error:
            left_out[f"{path.name}, line {line}"] = str(error)
    return entries


def _entry(path: Path, line: int, cells: tuple[str, ...], table: SmallTable, places: dict[str, int]) -> Entry:
    given = {name: cells[index] for name, index in places.items() if cells[index]}
    if "file" not in given:
        raise ReadError("the cell of the file is empty.")
    numbers: dict[str, float] = {}
    for name, dimension in NUMBERS.items():
        if name not in given:
            continue
        text = table.quantity(places[name], given[name])
        try:
            numbers[name] = units.to_si(text, dimension)
        except UnitError as error:
            raise ReadError(f"{name}: {error}") from None
        if numbers[name] == 0.0 or (numbers[name] < 0.0 and name != "scale"):
            raise ReadError(f"{name} is {quoted(text)}; a number above 0 was expected, of a scale also one below.")
    component = given.get("component", "").casefold()
    if component not in ("", "x", "y", "z"):
        raise ReadError(f"component is {quoted(component)}; x, y or z (vertical) was expected.")
    return Entry(
        inside(path.resolve().parent, given["file"].replace("\\", "/"), "the folder of the list"),
        f"{path.name}, line {line}, {given['file']}",
        unit=given.get("unit"),
        component=component,
        record=given.get("record", ""),
        column=given.get("column", ""),
        **numbers,
    )


_DIRECTIONS = {
    **dict.fromkeys(("x", "ew", "e-w", "we", "e", "east", "h1", "lon", "long", "longitudinal", "l"), "x"),
    **dict.fromkeys(("y", "ns", "n-s", "sn", "n", "north", "h2", "tra", "tran", "trans", "transverse", "t"), "y"),
    **dict.fromkeys(("z", "ud", "u-d", "up", "v", "ver", "vert", "vertical", "dwn", "down"), "z"),
}
_WORDS = "|".join(sorted(map(re.escape, _DIRECTIONS), key=len, reverse=True))
_SEPARATED = re.compile(rf"(?P<record>.*[^A-Za-z]|)(?P<direction>{_WORDS})", re.IGNORECASE)
"""`lefkada_x`, `I-ELC-UP`, `station 3 NS`, `NS`."""
_CHANNEL = re.compile(r"(?P<record>(?:.*[-_. ])?[BCEHLMS][HLGNP])(?P<direction>[ENZ])(?P<rest>[-_. ].*|)")
"""Codes of seismic channels, `KRP.HNE`."""
_AZIMUTH = re.compile(r"(?P<record>.*[^0-9])(?P<direction>\d{3})\.at2", re.IGNORECASE)
"""PEER's `RSN6_IMPVALL.I_I-ELC180.AT2`."""
_SUFFIX = re.compile(r"(?P<record>.+)\.(?P<direction>EW|NS|UD)(?P<rest>[12]?)", re.IGNORECASE)
"""K-NET's `AOM0011903.EW`; with 1 or 2 KiK-net's, in the borehole and at the surface."""


def named(file_name: str) -> tuple[str, str]:
    """
    Read the name of a file: itself without a direction; x, y, z or an azimuth in degrees, such as "180", or nothing.

    Examples
    --------
    >>> named("RSN6_I-ELC180.AT2"), named("RSN6_I-ELC-UP.AT2")
    (('RSN6_I-ELC', '180'), ('RSN6_I-ELC', 'z'))
    >>> named("AOM0011903.EW"), named("pulse.csv")
    (('AOM0011903', 'x'), ('pulse', ''))
    """
    if found := _SUFFIX.fullmatch(file_name):
        return found["record"] + found["rest"], _DIRECTIONS[found["direction"].casefold()]
    stem = Path(file_name).stem
    record, direction = direction_of(stem)
    if not direction and (azimuth := _AZIMUTH.fullmatch(file_name)):
        return azimuth["record"].rstrip("-_. "), azimuth["direction"]
    return record or stem, direction


def direction_of(text: str) -> tuple[str, str]:
    """Read the name of a file without its ending, or of a column."""
    bare = re.sub(r"\s*[\[(][^\])]*[\])]\s*$", "", text).strip()
    if found := _SEPARATED.fullmatch(bare):
        return found["record"].rstrip("-_. "), _DIRECTIONS[found["direction"].casefold()]
    if found := _CHANNEL.fullmatch(bare):
        return found["record"] + found["rest"], {"E": "x", "N": "y", "Z": "z"}[found["direction"]]
    return bare, ""


class _Component(NamedTuple):
    """A component as it was read: the entry with its direction and record filled in, and what its file hashes to."""

    entry: Entry
    motion: Motion
    files: tuple[tuple[str, str], ...]


def _components(entry: Entry, notes: list[str]) -> Iterator[_Component]:
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
    # Of one column the name of its file says what it is, of several their heads.
    said = {head: (path.stem, direction_of(head)[1]) if len(motions) > 1 else named(path.name) for head in motions}
    if len(motions) > 1 and (entry.component or not all(direction for _, direction in said.values())):
        heads = ", ".join(f'"{head}"' for head in motions)
        raise ReadError(
            f"{len(motions)} columns may be accelerations ({heads}), and which is which is not clear. Name one in each "
            'row of a list, in the columns "column", "component" and "record".'
        )
    for head, motion in motions.items():
        record, direction = said[head]
        scaled = motion if entry.scale == 1.0 else Motion(entry.scale * motion.acceleration, motion.dt)
        size, step = scaled.acceleration.size, scaled.dt
        if size < FEWEST_SAMPLES or step > LONGEST_INTERVAL or not 0.0 < scaled.peak <= LARGEST_ACCELERATION:
            raise ReadError(
                f"it has {size} samples {step:.3g} s apart with a peak of {scaled.peak:.3g} m/s²; at least "
                f"{FEWEST_SAMPLES} samples at most {LONGEST_INTERVAL:g} s apart, and a peak above 0 and at most "
                f"{LARGEST_ACCELERATION:g} m/s² were expected. Check its units."
            )
        given = replace(entry, component=entry.component or direction, record=entry.record or record)
        yield _Component(given, scaled, files)


def _joined(name: str, members: list[_Component], left_out: dict[str, str], notes: list[str]) -> GroundMotion:
    """Make a record of its components."""
    vertical: list[_Component] = []
    horizontal: list[_Component] = []
    for member in sorted(members, key=lambda each: each.entry.component):
        kept = vertical if member.entry.component == "z" else horizontal
        if len(kept) == 2 or member.entry.component in {other.entry.component for other in kept}:
            left_out[member.entry.place] = f'record "{name}" has this component already. Give it a name of its own.'
        else:
            kept.append(member)
    if not horizontal:
        raise ReadError("it has no horizontal component; one is needed for a column to rock.")
    used = [*horizontal, *vertical]
    step = used[0].motion.dt
    if differing := [each.motion.dt for each in used if abs(each.motion.dt - step) > SAME_STEP * step]:
        raise ReadError(
            f"the steps of its components differ ({step:.6g} s and {differing[0]:.6g} s). Resample one of them."
        )
    shortest = min(member.motion.acceleration.size for member in used)
    if any(member.motion.acceleration.size > shortest for member in used):
        notes.append(f'Record "{name}": its components differ in length; all are cut to {shortest * step:.4g} s.')
    along = [member.motion.acceleration[:shortest] for member in used]
    motion = Motion(along[0], step, along[-1] if vertical else None, along[1] if len(horizontal) == 2 else None)
    magnitude, distance = (
        next((value for member in used if (value := getattr(member.entry, key)) is not None), None)
        for key in ("magnitude", "distance")
    )
    files = tuple(dict.fromkeys(file for member in used for file in member.files))
    return GroundMotion(name, motion, tuple(member.entry.component for member in used), files, magnitude, distance)
