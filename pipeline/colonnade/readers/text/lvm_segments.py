"""Segments of a LabVIEW measurement file: the file's own header, then headers with rows below them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.text.lines.cells import Dialect
from colonnade.readers.text.lines.damage import mend
from colonnade.readers.text.lines.encoding import ends_within_line
from colonnade.readers.text.lines.faults import RowForm
from colonnade.readers.text.lines.numbered import NumberedLines
from colonnade.readers.text.lines.pieces import pieces_of_lines
from colonnade.readers.text.lines.rows import read_rows

END_OF_HEADER = "***End_of_Header***"
HEADER_STARTS = ("Channels", "Notes")
"""With what a segment's header starts; notes are written in front of all else."""
SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";", "space": " "}


class _BrokenHeaderError(Exception):
    """A segment's header is not whole."""


@dataclass(frozen=True)
class Preamble:
    """The header of the whole file: what it says by name, and how its numbers are written."""

    entries: dict[str, str]
    dialect: Dialect

    @property
    def clocks(self) -> str:
        """How many columns hold times: "no", "one" or "multi"."""
        return self.entries.get("X_Columns", "One").casefold()


@dataclass(frozen=True)
class Segment:
    """
    One header with the rows below it.

    Attributes
    ----------
    entries : dict of str to list of str
        What its header says for each column of the table.
    names : tuple of str
        Of the columns, the clocks among them.
    line : int
        Of the names.
    columns : list of ndarray, shape (n,)
    """

    entries: dict[str, list[str]]
    names: tuple[str, ...]
    line: int
    columns: list[Array]

    def entry(self, key: str, column: int) -> str:
        """What the header says of a column; empty if it says nothing."""
        cells = self.entries.get(key, [])
        return cells[column] if column < len(cells) else ""


def read_preamble(path: Path, lines: NumberedLines) -> Preamble:
    """Read the file's own header, up to its end mark."""
    entries: dict[str, str] = {}
    separator = "\t"
    for number, line in lines.rest():
        if line.startswith(END_OF_HEADER):
            break
        key, _, rest = line.partition(separator)
        if number <= 12 and key.startswith("Separator"):  # it may itself be written with the separator it names
            named = re.sub(r"^Separator\W*", "", line).strip()
            separator = SEPARATORS.get(named.casefold(), "\t")
            continue
        entries.setdefault(key.strip(), rest.strip(separator + " "))
    else:
        raise ReadError(f'{path.name}: the line "{END_OF_HEADER}" is missing: the file was cut off in its header.')
    decimal = entries.get("Decimal_Separator", ".").strip() or "."
    if decimal not in (".", ","):
        raise ReadError(f'{path.name}: Decimal_Separator is "{decimal[:20]}"; "." or "," was expected.')
    return Preamble(entries, Dialect(lines.encoding, separator, decimal))


def read_segments(path: Path, lines: NumberedLines, preamble: Preamble) -> tuple[list[Segment], list[str]]:
    """Read all segments; give what is wrong with them too."""
    segments: list[Segment] = []
    warnings: list[str] = []
    while (line := lines.peek()) is not None:
        if not line.strip():
            lines.take()
            continue
        try:
            segments.append(_segment(path, lines, preamble, segments[-1] if segments else None, warnings))
        except _BrokenHeaderError as error:
            if not segments:
                raise ReadError(f"{path.name}: {error}") from error
            warnings.append(str(error))
    return segments, warnings


def _segment(
    path: Path, lines: NumberedLines, preamble: Preamble, previous: Segment | None, warnings: list[str]
) -> Segment:
    """Read a segment's header and rows; _BrokenHeaderError if its header is not whole."""
    dialect = preamble.dialect
    if (lines.peek() or "").startswith(HEADER_STARTS):
        entries, names = _header(lines, dialect)
        line = lines.number
    elif previous is not None:  # rows that go on below a blank line
        entries, names, line = previous.entries, previous.names, lines.number + 1
    else:
        raise _BrokenHeaderError(
            f'line {lines.number + 1}: "Channels" was expected, the start of a segment\'s header; the file is damaged.'
        )
    found = _rows(lines)
    if len({said for said in entries.get("Samples", [])[1:] if said}) > 1:
        found = _padded(found, dialect, len(names))
    form = RowForm(dialect, ("number",) * len(names), remark=True, by_instrument=True, ragged=True)
    rows = read_rows(path, pieces_of_lines(found), form)
    mended = mend(rows, names, is_cut=lines.peek() is None and ends_within_line(path))
    warnings += mended.warnings
    return Segment(entries, names, line, mended.columns)


def _header(lines: NumberedLines, dialect: Dialect) -> tuple[dict[str, list[str]], tuple[str, ...]]:
    """Read a segment's header: what it says for each column, and the columns' names."""
    first = lines.number + 1
    entries: dict[str, list[str]] = {}
    for _, text in lines.rest():
        if text.startswith(END_OF_HEADER):
            break
        cells = [cell.strip() for cell in text.split(dialect.delimiter)]
        entries[cells[0]] = cells
    else:
        raise _BrokenHeaderError(
            f"the segment that starts on line {first} ends within its header: the file was cut off"
        )
    names = _names(lines.take() or "", dialect)
    if not names:
        raise _BrokenHeaderError(
            f"line {lines.number}: the names of the columns were expected; the file is damaged or was cut off"
        )
    return entries, names


def _names(line: str, dialect: Dialect) -> tuple[str, ...]:
    """Names of the columns, without that of the comments at the end."""
    names = [name.strip() for name in line.split(dialect.delimiter)]
    while names and names[-1] in ("", "Comment"):
        names.pop()
    return tuple(name or f"column {number}" for number, name in enumerate(names))


def _rows(lines: NumberedLines) -> Iterator[tuple[int, str]]:
    """Take the rows up to a blank line or the next header."""
    while True:
        yield from lines.until(lambda line: line.startswith((*HEADER_STARTS, "***")) or not line.strip())
        if not (lines.peek() or "").startswith("***"):
            return
        for _, line in lines.rest():  # a special block
            if line.startswith("***End"):
                break


def _padded(rows: Iterator[tuple[int, str]], dialect: Dialect, width: int) -> Iterator[tuple[int, str]]:
    """Fill up rows in which channels with fewer samples have no more cells."""
    for number, row in rows:
        yield number, row + dialect.delimiter * (width - 1 - row.count(dialect.delimiter))
