"""Text of MTS 793 testing machines (MPT, Basic TestWare): the first line says how it is written, blocks follow."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import with_clocks
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

    Blocks of the same names and units go on from one another. The first gives the channels as they are called; others
    follow with the number of their block before the name.

    Raises
    ------
    ReadError
        If the first line does not say how numbers are written, or no block of numbers follows.
    """
    text = Text.of(path, options.encoding)
    lines, warnings = text.whole_lines()
    dialect = _declared(path, lines[0] if lines else "")
    blocks: dict[tuple[tuple[str, ...], tuple[str, ...]], list[list[Array]]] = {}
    for names, units, columns, told in _blocks(lines, dialect):
        warnings += told
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
    return with_clocks(Recording(path, "mts", tuple(channels), notes=notes, warnings=tuple(warnings)))


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


def _blocks(lines: list[str], dialect: Dialect) -> Iterator[tuple[list[str], list[str], list[Array], list[str]]]:
    """Find each paragraph of a title, `… Time: 10.0 Sec …`, names, units and numbers."""
    blank = [number for number, line in enumerate(lines) if dialect.is_blank(line)]
    for above, stop in pairwise([-1, *blank, len(lines)]):
        first = above + 4
        if stop <= first:
            continue
        title, names, units, row = (_cells(line, dialect) for line in lines[above + 1 : first + 1])
        is_timed = any(cell.endswith(":") and dialect.is_number(behind) for cell, behind in pairwise(title))
        has_numbers = any(map(dialect.is_number, row[:2])) and not any(map(dialect.is_number, units))
        if is_timed and has_numbers and len(units) <= len(names):
            form = RowForm(dialect, ("number",) * len(names))
            columns, told = read_rows(pieces_of(lines, first, stop), form, names)
            yield names, units + [""] * (len(names) - len(units)), columns, told


def _cells(line: str, dialect: Dialect) -> list[str]:
    """Cut a line into cells; between spaces only if there are two or more, as names hold single ones."""
    cells = re.split(r"\s{2,}", line.strip()) if dialect.delimiter == WHITESPACE else dialect.split(line)
    while cells and not cells[-1]:
        cells.pop()
    return cells


FORMAT = Format(
    name="mts",
    summary="Text of MTS 793 testing machines (MPT, Basic TestWare), in blocks.",
    suffixes=(".dat", ".txt"),
    options=TextOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
