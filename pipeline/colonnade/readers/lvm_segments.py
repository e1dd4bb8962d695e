"""Segments of a LabVIEW measurement file: the file's own header, then headers with rows below them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from colonnade.errors import ReadError
from colonnade.readers.cells import Dialect
from colonnade.readers.numbered_lines import NumberedLines
from colonnade.readers.table import Table, read_table, without_cut_end
from colonnade.readers.text_encoding import ends_within_line

END_OF_HEADER = "***End_of_Header***"
HEADER_STARTS = ("Channels", "Notes")
"""With what a segment's header starts; notes are written in front of all else."""
SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";", "space": " "}


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
    table : Table
    """

    entries: dict[str, list[str]]
    names: tuple[str, ...]
    line: int
    table: Table

    def entry(self, key: str, column: int) -> str:
        """What the header says of a column; empty where it is silent."""
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
        raise ReadError(f'{path.name}: the line "{END_OF_HEADER}" is not there: the file was cut off in its header.')
    decimal = entries.get("Decimal_Separator", ".").strip() or "."
    if decimal not in (".", ","):
        raise ReadError(f'{path.name}: Decimal_Separator is "{decimal[:20]}"; "." or "," was expected.')
    return Preamble(entries, Dialect(lines.encoding, separator, decimal))


def read_segments(path: Path, lines: NumberedLines, preamble: Preamble) -> tuple[list[Segment], list[str]]:
    """Read all segments."""
    segments: list[Segment] = []
    warnings: list[str] = []
    while lines.peek() is not None:
        if not (lines.peek() or "").strip():
            lines.take()
            continue
        segment = _segment(path, lines, preamble, segments[-1] if segments else None)
        if isinstance(segment, str):
            if not segments:
                raise ReadError(f"{path.name}: {segment}")
            warnings.append(segment)
            continue
        segments.append(segment)
    if segments and ends_within_line(path):
        table, told = without_cut_end(segments[-1].table, preamble.dialect)
        segments[-1] = replace(segments[-1], table=table)
        warnings += told
    return segments, warnings


def _segment(path: Path, lines: NumberedLines, preamble: Preamble, previous: Segment | None) -> Segment | str:
    """Read a segment's header and rows; say what is wrong where its header is not whole."""
    dialect = preamble.dialect
    entries: dict[str, list[str]] = {}
    first = lines.number + 1
    if not (lines.peek() or "").startswith(HEADER_STARTS):
        if previous is None:
            return f'line {first}: "Channels" was expected, the start of a segment\'s header; the file is damaged.'
        names, line = previous.names, first  # rows that go on below a blank line
        entries = previous.entries
    else:
        for _, text in lines.rest():
            if text.startswith(END_OF_HEADER):
                break
            cells = text.split(dialect.delimiter)
            entries[cells[0].strip()] = [cell.strip() for cell in cells]
        else:
            return f"the segment that starts on line {first} ends within its header: the file was cut off"
        names = _names(lines.take() or "", entries, dialect)
        line = lines.number
        if not names:
            return f"line {line}: the names of the columns were expected; the file is damaged or was cut off"
    rows = _rows(lines)
    if len({said for said in entries.get("Samples", [])[1:] if said}) > 1:
        rows = _padded(rows, dialect, len(names))
    table = read_table(rows, dialect, len(names), beyond=1)
    return Segment(entries, names, line, table)


def _names(line: str, entries: dict[str, list[str]], dialect: Dialect) -> tuple[str, ...]:
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
    """Fill up rows in which channels with fewer samples have no cell any more."""
    for number, row in rows:
        yield number, row + dialect.delimiter * (width - 1 - row.count(dialect.delimiter))
