"""LabVIEW measurement files (.lvm): text in segments, each with a header of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times, moment_after
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.cells import Dialect
from colonnade.readers.text.damage import mend
from colonnade.readers.text.encoding import TextOptions, ends_within_line, pieces_of_lines
from colonnade.readers.text.heading import take_apart
from colonnade.readers.text.numbered import NumberedLines
from colonnade.readers.text.rows import RowForm, filled_length, read_rows

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


SIGNATURE = "LabVIEW Measurement"
LABVIEW_EPOCH = datetime(1904, 1, 1)
SINCE_EPOCH = 1e9
"""Seconds: larger x-values count from LabVIEW's epoch, not from the start of the recording."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first line is that of a LabVIEW measurement file."""
    if head.first_line.startswith(SIGNATURE):
        return Recognition(True, f'the first line is "{SIGNATURE}"')
    return Recognition(False, f'the first line is not "{SIGNATURE}"')


def read(path: Path, options: TextOptions) -> Recording:
    """
    Read a LabVIEW measurement file.

    Channels of the same name are joined over the segments by each segment's own date and time.

    Raises
    ------
    ReadError
        If a header is not whole.
    """
    with NumberedLines(path, options.encoding) as lines:
        preamble = read_preamble(path, lines)
        segments, warnings = read_segments(path, lines, preamble)
    for segment in segments:
        warnings += _too_short(segment)
    pieces: dict[tuple[int, str], list[RecordedChannel]] = {}
    for segment in segments:
        for column, piece in _columns(segment, preamble):
            pieces.setdefault((column, piece.name), []).append(piece)
    timed = ((piece.time, piece.start) for same in pieces.values() for piece in same if piece.time is not None)
    first, origin = next(timed, (np.empty(0), None))
    start = moment_after(origin, float(first[0])) if first.size else None
    channels = tuple(_joined(same, origin, preamble) for same in pieces.values())
    return Recording(
        path, "lvm", channels, start, notes=_notes(preamble, segments), warnings=tuple(dict.fromkeys(warnings))
    )


def _too_short(segment: Segment) -> list[str]:
    """Report a segment with fewer rows than its header says."""
    for column, (name, values) in enumerate(zip(segment.names, segment.columns, strict=True)):
        said = segment.entry("Samples", column)
        if said.isdecimal() and int(said) > filled_length(values):
            return [
                f"the samples below line {segment.line} end too early: the header says {said}, "
                f'"{name}" has {filled_length(values)}'
            ]
    return []


def _columns(segment: Segment, preamble: Preamble) -> Iterator[tuple[int, RecordedChannel]]:
    """Take a segment's columns apart, each with its number; their times, if x is a time, count from their start."""
    clock = 0
    for column, name in enumerate(segment.names):
        is_clock = column == 0 or (preamble.clocks == "multi" and column % 2 == 0)
        if is_clock and preamble.clocks == "no":
            continue  # an empty column
        clock = column if is_clock else clock
        owner = min(column + 1, len(segment.names) - 1) if is_clock else column
        values = segment.columns[column][: filled_length(segment.columns[column])]
        began = _moment(segment.entry("Date", owner), segment.entry("Time", owner))
        began = began or _moment(preamble.entries.get("Date", ""), preamble.entries.get("Time", ""))
        times = None
        if segment.entry("X_Dimension", owner).casefold() not in ("time", ""):
            is_clock = False
        elif preamble.clocks == "no":
            times = _even_times(segment, preamble, column, values.size)
        else:
            times = segment.columns[clock][: values.size]
            if times.size and times[0] > SINCE_EPOCH:
                began = moment_after(LABVIEW_EPOCH, float(times[0]))
                times = times - times[0]
        unit = "s" if is_clock else segment.entry("Y_Unit_Label", column) or take_apart(name)[1]
        yield column, RecordedChannel(name, unit, values, times, is_clock=is_clock, start=began)


def _even_times(segment: Segment, preamble: Preamble, column: int, count: int) -> Array | None:
    """Times by the header's interval; None if it gives none."""
    step = preamble.dialect.number(segment.entry("Delta_X", column))
    begin = preamble.dialect.number(segment.entry("X0", column) or "0")
    return even_times(count, step, begin) if step > 0 and np.isfinite(begin) else None


def _joined(pieces: list[RecordedChannel], origin: datetime | None, preamble: Preamble) -> RecordedChannel:
    """Join a channel's pieces, on the clock of the recording's first sample."""
    first = pieces[0]
    values = np.concatenate([piece.values for piece in pieces])
    name = take_apart(first.name)[0]
    times: list[Array] = []
    shift, end = 0.0, np.inf
    for piece in pieces:
        if piece.time is None:
            return RecordedChannel(name, first.unit, values, heading=first.name)
        # x-values that go on where the segment before ended count from its beginning, not from this one's.
        goes_on = preamble.clocks != "no" and bool((piece.time[:1] > end).any())
        if not goes_on and piece.start is not None and origin is not None:
            shift = (piece.start - origin).total_seconds()
        times.append(piece.time + shift)
        end = float(piece.time[-1]) if piece.time.size else np.inf
    return RecordedChannel(name, first.unit, values, np.concatenate(times), first.name, first.is_clock)


def _moment(date: str, time: str) -> datetime | None:
    """Date and time of day as LabVIEW writes them, `2013/02/19` and `09:51:40,7271890640258789063`."""
    day = re.match(r"(\d{4})/(\d{1,2})/(\d{1,2})", date)
    hour = re.match(r"(\d{1,2}):(\d{2}):(\d{2})(?:[.,](\d{1,6}))?", time)
    if day is None or hour is None:
        return None
    try:
        fraction = (hour[4] or "").ljust(6, "0")
        return datetime(int(day[1]), int(day[2]), int(day[3]), int(hour[1]), int(hour[2]), int(hour[3]), int(fraction))
    except ValueError:
        return None


def _notes(preamble: Preamble, segments: list[Segment]) -> tuple[str, ...]:
    decimal = "comma" if preamble.dialect.decimal == "," else "point"
    clock = {
        "no": "clock: Delta_X of the header, as X_Columns is No",
        "multi": "clocks: each channel's own X_Value, as X_Columns is Multi",
    }.get(preamble.clocks, "clock: X_Value")
    notes = [f"encoding {preamble.dialect.encoding}", f"decimal {decimal}, as the header says", clock]
    if len(segments) > 1:
        notes.append(f"{len(segments)} segments, joined by their dates and times")
    return tuple(notes)


FORMAT = Format(
    name="lvm",
    summary="LabVIEW measurement text, in segments with headers.",
    suffixes=(".lvm",),
    options=TextOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
