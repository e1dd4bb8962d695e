"""Text of MTS 793 testing machines (MPT, Basic TestWare): the first line says how it is written, blocks follow."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import datetime
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from colonnade.errors import ReadError
from colonnade.readers.cells import WHITESPACE, Dialect, is_timestamp
from colonnade.readers.clock import RISING_SHARE, moment_after, rising_share
from colonnade.readers.heading import looks_like_unit
from colonnade.readers.numbered_lines import NumberedLines, first_lines
from colonnade.readers.recording import TIME_UNITS, Array, RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.table import Table, read_table, report_faults, without_cut_end
from colonnade.readers.text_encoding import ends_within_line, known_encoding

SIGNATURE = "MTS793|"
DELIMITERS = {"0": WHITESPACE, "1": ",", "2": "\t"}
"""Of the fifth field of the first line: plain, Lotus, Excel (MPT manual, "How to parse the MPT specimen data file")."""


class MtsOptions(BaseModel):
    """What can be said about an MTS 793 text."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        default=None, description='Of the text, such as "latin-1".'
    )


@dataclass(frozen=True)
class Declared:
    """What the first line says: language, dialect, and the sign within dates."""

    language: str
    dialect: Dialect
    date_sign: str


@dataclass(frozen=True)
class Block:
    """
    Rows of one acquisition process.

    Attributes
    ----------
    line : int
        Of the names, in the file.
    names, units : tuple of str
    table : Table
    origin : datetime or None
        When the machine's running time was zero.
    """

    line: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    table: Table
    origin: datetime | None


def recognise(path: Path) -> Recognition:
    """Say whether the first line is that of an MTS 793 text."""
    head = first_lines(path, 1)
    if head and head[0].lstrip('"').startswith(SIGNATURE):
        return Recognition(True, f'the first line starts with "{SIGNATURE}"')
    return Recognition(False, f'the first line does not start with "{SIGNATURE}"')


def read(path: Path, options: MtsOptions) -> Recording:
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
    with NumberedLines(path, options.encoding) as lines:
        declared = _declared(path, lines.take() or "", lines.encoding)
        blocks = list(_blocks(lines, declared, warnings))
    if blocks and ends_within_line(path):
        table, told = without_cut_end(blocks[-1].table, declared.dialect)
        blocks[-1] = replace(blocks[-1], table=table)
        warnings += told
    blocks = [block for block in blocks if block.table.lines.size]
    if not blocks:
        raise ReadError(
            f"{path.name}: no block of numbers was found: a line of names, one of units, then rows of numbers were "
            "expected. The file was cut off, or holds the operator's notes only."
        )
    for block in blocks:
        warnings += report_faults(block.table, block.names)
    series = _series(blocks)
    channels: list[RecordedChannel] = []
    start = None
    lengths = [sum(block.table.lines.size for block in same) for same in series]
    longest = lengths.index(max(lengths))
    for number in sorted(range(len(series)), key=lambda number: number != longest):
        found = _channels(series[number], "" if number == longest else f"block {number + 1}: ")
        clock = next((channel.time for channel in found if channel.time is not None), None)
        if number == longest and clock is not None:
            start = moment_after(series[number][0].origin, float(clock[0]))
        channels += found
    if len(series) > 1:
        warnings.append(
            f"{len(series)} blocks with different columns: block {longest + 1}, the longest with {max(lengths)} rows, "
            f'is taken; columns of the others are called "block {2 if longest == 0 else 1}: …"'
        )
    notes = [f"encoding {declared.dialect.encoding}", "delimiter and decimal sign as the first line declares them"]
    notes += [
        f"block {number}: {lengths[number - 1]} rows below line {same[0].line + 1}"
        + (f", in {len(same)} pieces of the same columns" if len(same) > 1 else "")
        for number, same in enumerate(series, 1)
    ]
    clocks = [channel.heading for channel in channels if channel.is_clock]
    notes.append("clock: " + ", ".join(f'"{name}"' for name in clocks) if clocks else "no clock: no rising column in s")
    return Recording(path, "mts", tuple(channels), start, tuple(notes), tuple(warnings))


def _declared(path: Path, line: str, encoding: str) -> Declared:
    """Take the first line apart: program, language, version, delimiter, decimal sign, signs of date and time."""
    fields = line.strip().strip('"').split("|")
    if len(fields) < 8 or fields[4] not in DELIMITERS or fields[5] not in (".", ","):
        raise ReadError(
            f'{path.name}: line 1 is "{line[:60]}"; "MTS793|program|language|version|delimiter|decimal sign|…" was '
            "expected, with a delimiter 0, 1 or 2. Export the file from the machine again."
        )
    delimiter = DELIMITERS[fields[4]]
    return Declared(fields[2], Dialect(encoding, delimiter, fields[5], quoted=delimiter == ","), fields[6])


def _blocks(lines: NumberedLines, declared: Declared, warnings: list[str]) -> Iterator[Block]:
    """Find each line above a block, `… Time: 10.0 Sec …`, that has names, units and numbers below it."""
    dialect = declared.dialect
    for _, line in lines.rest():
        title = _cells(line, dialect)
        if _seconds(title, dialect) is None:
            continue
        names = _cells(lines.take() or "", dialect)
        units = _cells(lines.peek() or "", dialect)
        if not names or len(units) > len(names) or any(dialect.is_number(cell) for cell in units):
            continue
        units += [""] * (len(names) - len(units))
        lines.take()
        if not _is_row(lines.peek() or "", dialect):
            if all(looks_like_unit(unit) for unit in units):
                warnings.append(f'the block below line {lines.number} ("{names[0]}", …) has no rows: cut off')
            continue
        line_of_names = lines.number - 1
        table = read_table(_rows(lines, dialect), dialect, len(names))
        yield Block(line_of_names, tuple(names), tuple(units), table, _origin(title, declared))


def _is_row(line: str, dialect: Dialect) -> bool:
    cells = dialect.split(line)
    return any(dialect.is_number(cell) for cell in cells[:2]) and not any(is_timestamp(cell) for cell in cells)


def _cells(line: str, dialect: Dialect) -> list[str]:
    """Cut a line into cells; between spaces only where there are two or more, as names hold single ones."""
    cells = re.split(r"\s{2,}", line.strip()) if dialect.delimiter == WHITESPACE else dialect.split(line)
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _rows(lines: NumberedLines, dialect: Dialect) -> Iterator[tuple[int, str]]:
    """Take the rows of a block: up to a blank line, or one without any number."""
    while (line := lines.peek()) is not None:
        if not _is_row(line, dialect):
            return
        lines.take()
        yield lines.number, line.rstrip("\t ")


def _seconds(title: list[str], dialect: Dialect) -> float | None:
    """Running time in the line above a block, `… Zeit: 320,02344 s 01.09.2014 13:30:25`."""
    for cell, following in pairwise(title):
        if cell.endswith(":") and dialect.is_number(following):
            return dialect.number(following)
    return None


def _origin(title: list[str], declared: Declared) -> datetime | None:
    """Date and time of the running time's zero, where the date can be read in one way only."""
    seconds = _seconds(title, declared.dialect)
    if seconds is None or not title:
        return None
    text = title[-1]
    forms = {
        ".": ("%d.%m.%Y %H:%M:%S",),
        "/": ("%m/%d/%Y %I:%M:%S %p", "%m/%d/%Y %H:%M:%S") if declared.language == "ENU" else (),
        "-": ("%Y-%m-%d %H:%M:%S",),
    }
    for form in forms.get(declared.date_sign, ()):
        try:
            return moment_after(datetime.strptime(text, form), -seconds)
        except ValueError:
            continue
    return None


def _series(blocks: list[Block]) -> list[list[Block]]:
    """Put blocks of the same names and units together, in the order of the file."""
    series: dict[tuple[tuple[str, ...], tuple[str, ...]], list[Block]] = {}
    for block in blocks:
        series.setdefault((block.names, block.units), []).append(block)
    return list(series.values())


def _channels(blocks: list[Block], prefix: str) -> list[RecordedChannel]:
    """Join the columns of blocks; their clock is the first one in a unit of time whose values rise."""
    first = blocks[0]
    columns = [np.concatenate(pieces) for pieces in zip(*(block.table.columns for block in blocks), strict=True)]
    time: Array | None = None
    clock = None
    for number, (unit, values) in enumerate(zip(first.units, columns, strict=True)):
        if unit.casefold() in TIME_UNITS and (values.size == 1 or rising_share(values) >= RISING_SHARE):
            clock, time = number, values * TIME_UNITS[unit.casefold()]
            break
    return [
        RecordedChannel(prefix + name, unit or None, values, time, is_clock=number == clock)
        for number, (name, unit, values) in enumerate(zip(first.names, first.units, columns, strict=True))
    ]


FORMAT = Format(
    name="mts",
    summary="Text of MTS 793 testing machines (MPT, Basic TestWare), in blocks.",
    suffixes=(".dat", ".txt"),
    options=MtsOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
