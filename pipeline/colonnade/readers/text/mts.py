"""Text of MTS 793 testing machines (MPT, Basic TestWare): the first line says how it is written, blocks follow."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import moment_after, moment_of, with_clocks
from colonnade.readers.format import Format
from colonnade.readers.head import by_first_line
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.damage import mend
from colonnade.readers.text.dialect import WHITESPACE, Dialect, is_timestamp
from colonnade.readers.text.encoding import Text, TextOptions, pieces_of
from colonnade.readers.text.heading import looks_like_unit
from colonnade.readers.text.rows import RowForm, read_rows

SIGNATURE = "MTS793|"
DELIMITERS = {"0": WHITESPACE, "1": ",", "2": "\t"}
"""Of the fifth field of the first line: plain, Lotus, Excel (MPT manual, "How to parse the MPT specimen data file")."""
DATES = {
    ".": ("%d.%m.%Y %H:%M:%S",),
    "/": ("%m/%d/%Y %I:%M:%S %p", "%m/%d/%Y %H:%M:%S"),
    "-": ("%Y-%m-%d %H:%M:%S",),
}
"""Forms of a date with time, by the sign within dates; that with / only in the language ENU is read in one way only."""


class Block(NamedTuple):
    """Rows of one acquisition process, with the line of their names and the date of the running time's zero."""

    line: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    columns: list[Array]
    origin: datetime | None


recognise = by_first_line(re.compile(r'^"*MTS793\|'), f'"{SIGNATURE}"')


def read(path: Path, options: TextOptions) -> Recording:
    """
    Read an MTS 793 text.

    Blocks of the same names and units go on from one another. Of others the longest gives the channels as they are
    called, and the recording's start; the rest follow with the number of their block before the name.

    Raises
    ------
    ReadError
        If the first line does not say how numbers are written, or no block of numbers follows.
    """
    warnings: list[str] = []
    text = Text.of(path, options.encoding)
    lines = text.lines()
    dialect, dates = _declared(path, lines[0])
    alike: dict[object, list[Block]] = {}
    for block in _blocks(lines, dialect, dates, warnings):
        alike.setdefault((block.names, block.units), []).append(block)
    if not alike:
        raise ReadError(
            f"{path.name}: no block of numbers was found: a line of names, one of units, then rows of numbers were "
            "expected. The file was cut off, or holds the operator's notes only."
        )
    notes = [f"encoding {text.encoding.name}"]
    groups: list[list[RecordedChannel]] = []
    for number, same in enumerate(alike.values(), 1):
        columns = [np.concatenate(pieces) for pieces in zip(*(block.columns for block in same), strict=True)]
        parts = zip(same[0].names, same[0].units, columns, strict=True)
        groups.append(
            [RecordedChannel(name, unit or None, each, scope=(f"block {number}",)) for name, unit, each in parts]
        )
        notes.append(f"block {number}: {columns[0].size} rows below line {same[0].line + 1}")
    sizes = [group[0].values.size for group in groups]
    longest = sizes.index(max(sizes))
    channels = groups[longest]
    for group in groups[:longest] + groups[longest + 1 :]:
        names = [f"{channel.scope[0]}: {channel.name}" for channel in group]
        channels += [replace(channel, name=name, heading=name) for channel, name in zip(group, names, strict=True)]
    if len(groups) > 1:
        warnings.append(
            f"{len(groups)} blocks with different columns: block {longest + 1}, the longest with "
            f'{max(sizes)} rows, is used; columns of the others are called "block '
            f'{2 if longest == 0 else 1}: …"'
        )
    found = with_clocks(Recording(path, "mts", tuple(channels), notes=tuple(notes), warnings=tuple(warnings)))
    clock, origin = found.channels[0].time, [*alike.values()][longest][0].origin
    return found if clock is None else replace(found, start=moment_after(origin, float(clock[0])))


def _declared(path: Path, line: str) -> tuple[Dialect, tuple[str, ...]]:
    """Take the first line apart: how numbers are written, and the forms that a date may have."""
    fields = line.strip().strip('"').split("|")
    if len(fields) < 8 or fields[4] not in DELIMITERS or fields[5] not in (".", ","):
        raise ReadError(
            f'{path.name}: line 1 is "{line[:60]}"; "MTS793|program|language|version|delimiter|decimal sign|…" was '
            "expected, with a delimiter 0, 1 or 2. Export the file from the machine again."
        )
    delimiter = DELIMITERS[fields[4]]
    dates = DATES.get(fields[6], ()) if fields[6] != "/" or fields[2] == "ENU" else ()
    return Dialect(delimiter, fields[5], quoted=delimiter == ","), dates


def _blocks(lines: list[str], dialect: Dialect, dates: tuple[str, ...], warnings: list[str]) -> Iterator[Block]:
    """Find each line above a block, `… Time: 10.0 Sec …`, that has names, units and numbers below it."""
    at = 0
    while (at := at + 1) < len(lines) - 2:
        title, names, units = (_cells(line, dialect) for line in lines[at : at + 3])
        seconds = _seconds(title, dialect)
        if seconds is None or not names or len(units) > len(names) or any(map(dialect.is_number, units)):
            continue
        units += [""] * (len(names) - len(units))
        first = stop = at + 3
        while stop < len(lines) and _is_row(lines[stop], dialect):
            stop += 1
        if stop > first:
            form = RowForm(dialect, ("number",) * len(names), by_instrument=True)
            mended = mend(read_rows(pieces_of(lines, first, stop), form), names)
            warnings += mended.warnings
            origin = moment_after(moment_of(title[-1], dates), -seconds)
            yield Block(at + 2, tuple(names), tuple(units), mended.columns, origin)
            at = stop - 1
        elif all(map(looks_like_unit, units)):
            warnings.append(f'the block below line {first} ("{names[0]}", …) has no rows: cut off')


def _is_row(line: str, dialect: Dialect) -> bool:
    """Whether a line is a row: not blank, and not without any number."""
    cells = dialect.split(line)
    return any(dialect.is_number(cell) for cell in cells[:2]) and not any(is_timestamp(cell) for cell in cells)


def _cells(line: str, dialect: Dialect) -> list[str]:
    """Cut a line into cells; between spaces only if there are two or more, as names hold single ones."""
    cells = re.split(r"\s{2,}", line.strip()) if dialect.delimiter == WHITESPACE else dialect.split(line)
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _seconds(title: list[str], dialect: Dialect) -> float | None:
    """Running time in the line above a block, `… Zeit: 320,02344 s 01.09.2014 13:30:25`."""
    for cell, following in pairwise(title):
        if cell.endswith(":") and dialect.is_number(following):
            return dialect.number(following)
    return None


FORMAT = Format(
    name="mts",
    summary="Text of MTS 793 testing machines (MPT, Basic TestWare), in blocks.",
    suffixes=(".dat", ".txt"),
    options=TextOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
