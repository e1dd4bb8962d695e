"""Text of MTS 793 testing machines (MPT, Basic TestWare): the first line says how it is written, blocks follow."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import moment_after, moment_of, with_clocks
from colonnade.readers.format import Format
from colonnade.readers.head import by_first_line
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.dialect import WHITESPACE, Dialect
from colonnade.readers.text.encoding import Text, TextOptions, pieces_of
from colonnade.readers.text.rows import RowForm, read_rows

SIGNATURE = "MTS793|"
DELIMITERS = {"0": WHITESPACE, "1": ",", "2": "\t"}
"""Of the fifth field of the first line: plain, Lotus, Excel (MPT manual, "How to parse the MPT specimen data file")."""

recognise = by_first_line(re.compile(r'^"*MTS793\|'), f'"{SIGNATURE}"')


def read(path: Path, options: TextOptions) -> Recording:
    """
    Read an MTS 793 text.

    Blocks of the same names and units go on from one another. The first gives the channels as they are called, and the
    recording's start; others follow with the number of their block before the name.

    Raises
    ------
    ReadError
        If the first line does not say how numbers are written, or no block of numbers follows.
    """
    text = Text.of(path, options.encoding)
    lines, warnings = text.whole_lines()
    dialect = _declared(path, lines[0] if lines else "")
    blocks: dict[tuple[tuple[str, ...], tuple[str, ...]], list[list[Array]]] = {}
    origin = None
    for title, names, units, columns, told in _blocks(lines, dialect):
        warnings += told
        if not blocks:  # between slashes the day or the month may be in front
            origin = moment_after(
                moment_of(title[-1]) if "/" not in title[-1] else None, -(_seconds(title, dialect) or 0.0)
            )
        blocks.setdefault((tuple(names), tuple(units)), []).append(columns)
    if not blocks:
        raise ReadError(
            f"{path.name}: no block of numbers was found: a line of names, one of units, then rows of numbers were "
            "expected. The file was cut off, or holds the operator's notes only."
        )
    channels: list[RecordedChannel] = []
    for number, (heads, same) in enumerate(blocks.items(), 1):
        before = f"block {number}: " if number > 1 else ""
        for name, unit, *pieces in zip(*heads, *same, strict=True):
            values = np.concatenate(pieces)
            channels.append(RecordedChannel(before + name, unit or None, values, scope=(f"block {number}",)))
    notes = (f"encoding {text.encoding}",)
    found = with_clocks(Recording(path, "mts", tuple(channels), notes=notes, warnings=tuple(warnings)))
    clock = found.channels[0].time
    return found if clock is None else replace(found, start=moment_after(origin, float(clock[0])))


def _declared(path: Path, line: str) -> Dialect:
    """Take the first line apart: how numbers are written."""
    fields = line.strip().strip('"').split("|")
    if len(fields) < 8 or fields[4] not in DELIMITERS or fields[5] not in (".", ","):
        raise ReadError(
            f'{path.name}: line 1 is "{line[:60]}"; "MTS793|program|language|version|delimiter|decimal sign|…" was '
            "expected, with a delimiter 0, 1 or 2. Export the file from the machine again."
        )
    delimiter = DELIMITERS[fields[4]]
    return Dialect(delimiter, fields[5], quoted=delimiter == ",")


def _blocks(
    lines: list[str], dialect: Dialect
) -> Iterator[tuple[list[str], list[str], list[str], list[Array], list[str]]]:
    """Find each paragraph of a title, `… Time: 10.0 Sec …`, names, units and numbers."""
    blank = [number for number, line in enumerate(lines) if dialect.is_blank(line)]
    for above, stop in pairwise([-1, *blank, len(lines)]):
        first = above + 4
        if stop <= first:
            continue
        title, names, units, row = (_cells(line, dialect) for line in lines[above + 1 : first + 1])
        if _seconds(title, dialect) is None or len(units) > len(names) or not any(map(dialect.is_number, row[:2])):
            continue
        if not any(map(dialect.is_number, units)):
            form = RowForm(dialect, ("number",) * len(names))
            yield (
                title,
                names,
                units + [""] * (len(names) - len(units)),
                *read_rows(pieces_of(lines, first, stop), form, names),
            )


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
