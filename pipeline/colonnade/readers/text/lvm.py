"""LabVIEW measurement files (.lvm): text in segments, each with a header of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import datetime
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times, moment_after, moment_of
from colonnade.readers.format import Format
from colonnade.readers.head import by_first_line
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.damage import mend
from colonnade.readers.text.dialect import Dialect
from colonnade.readers.text.encoding import Text, TextOptions, pieces_of
from colonnade.readers.text.heading import take_apart
from colonnade.readers.text.rows import RowForm, filled_length, read_rows

END_OF_HEADER = "***End_of_Header***"
HEADER_STARTS = ("Channels", "Notes")
"""With what a segment's header starts; notes are written in front of all else."""
SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";", "space": " "}


SIGNATURE = "LabVIEW Measurement"
CLOCKS = {
    "no": "clock: Delta_X of the header, as X_Columns is No",
    "multi": "clocks: each channel's own X_Value, as X_Columns is Multi",
}
"""What is said of the clocks, by X_Columns."""
LABVIEW_EPOCH = datetime(1904, 1, 1)
SINCE_EPOCH = 1e9
"""Seconds: larger x-values count from LabVIEW's epoch, not from the start of the recording."""


class Preamble(NamedTuple):
    """The header of the whole file: what it says by name, how its numbers are written, and the lines that it has."""

    entries: dict[str, str]
    dialect: Dialect
    lines: int

    @property
    def clocks(self) -> str:
        """How many columns hold times: "no", "one" or "multi"."""
        return self.entries.get("X_Columns", "One").casefold()


class Segment(NamedTuple):
    """One header, what it says for each column of the table below it, and the columns with their names."""

    entries: dict[str, list[str]]
    names: list[str]
    columns: list[Array]

    def entry(self, key: str, column: int) -> str:
        """What the header says of a column; empty if it says nothing."""
        return "".join(self.entries.get(key, [])[column : column + 1])


def read_preamble(path: Path, lines: list[str]) -> Preamble:
    """Read the file's own header, up to its end mark."""
    entries: dict[str, str] = {}
    separator = "\t"
    for number, line in enumerate(lines, 1):
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
    return Preamble(entries, Dialect(separator, decimal), number)


def read_segments(path: Path, lines: list[str], preamble: Preamble) -> tuple[list[Segment], list[str]]:
    """Read all segments, each a header and the rows down to the next one; give what is wrong with them too."""
    segments: list[Segment] = []
    warnings: list[str] = []
    delimiter = preamble.dialect.delimiter
    at = next((n for n in range(preamble.lines, len(lines)) if lines[n].strip()), len(lines))
    while at < len(lines):
        first = at
        at = next((n for n in range(at, len(lines)) if lines[n].startswith(END_OF_HEADER)), len(lines)) + 1
        names = [name.strip() for name in lines[at].split(delimiter)] if at < len(lines) else []
        while names and names[-1] in ("", "Comment"):
            names.pop()
        wrong = ""
        if not lines[first].startswith(HEADER_STARTS):
            wrong = f'line {first + 1}: "Channels" was expected, the start of a segment\'s header; the file is damaged.'
        elif at > len(lines):
            wrong = f"the segment that starts on line {first + 1} ends within its header: the file was cut off"
        elif not names:
            wrong = f"line {at + 1}: the names of the columns were expected; the file is damaged or was cut off"
        if wrong and not segments:
            raise ReadError(f"{path.name}: {wrong}")
        stop = next((n for n in range(at + 1, len(lines)) if lines[n].startswith(HEADER_STARTS)), len(lines))
        if wrong:
            warnings.append(wrong)
        else:
            names = [name or f"column {number}" for number, name in enumerate(names)]
            header = ([cell.strip() for cell in line.split(delimiter)] for line in lines[first : at - 1])
            entries = {cells[0]: cells for cells in header}
            is_uneven = len({said for said in entries.get("Samples", [])[1:] if said}) > 1
            _prepare(lines, range(at + 1, stop), delimiter, len(names) if is_uneven else 0)
            kinds = ("empty" if preamble.clocks == "no" else "number", *["number"] * (len(names) - 1))
            form = RowForm(preamble.dialect, kinds, remark=True, by_instrument=True, ragged=True)
            mended = mend(read_rows(pieces_of(lines, at + 1, stop), form), names)
            segments.append(Segment(entries, names, mended.columns))
            lengths = zip(names, entries.get("Samples", ()), map(filled_length, mended.columns), strict=False)
            lacking = ((name, said, size) for name, said, size in lengths if said.isdecimal() and int(said) > size)
            warnings += mended.warnings
            warnings += [
                f'the samples below line {at + 1} end too early: the header says {said}, "{name}" has {size}'
                for name, said, size in islice(lacking, 1)
            ]
        at = stop
    return segments, warnings


def _prepare(lines: list[str], rows: range, delimiter: str, width: int) -> None:
    """Empty the lines of special blocks, and fill up rows in which channels with fewer samples have no more cells."""
    is_special = False
    for number in rows:
        line = lines[number]
        is_special |= line.startswith("***")
        if is_special:
            lines[number] = ""
        elif width and line.strip():
            lines[number] += delimiter * (width - 1 - line.count(delimiter))
        is_special &= not line.startswith("***End")


recognise = by_first_line(re.compile(f"^{SIGNATURE}"), f'"{SIGNATURE}"')


def read(path: Path, options: TextOptions) -> Recording:
    """Read a LabVIEW file; channels of one name are joined over its segments by each segment's own date and time."""
    text = Text.of(path, options.encoding)
    lines = text.lines()
    preamble = read_preamble(path, lines)
    segments, warnings = read_segments(path, lines, preamble)
    pieces: dict[tuple[int, str], list[RecordedChannel]] = {}
    for segment in segments:
        for column, piece in _columns(segment, preamble):
            pieces.setdefault((column, piece.name), []).append(piece)
    timed = ((piece.time, piece.start) for same in pieces.values() for piece in same if piece.time is not None)
    first, origin = next(timed, (np.empty(0), None))
    start = moment_after(origin, float(first[0])) if first.size else None
    channels = tuple(_joined(same, origin, preamble) for same in pieces.values())
    notes = [f"encoding {text.encoding.name}", CLOCKS.get(preamble.clocks, "clock: X_Value")]
    if len(segments) > 1:
        notes.append(f"{len(segments)} segments, joined by their dates and times")
    return Recording(path, "lvm", channels, start, tuple(notes), tuple(dict.fromkeys(warnings)))


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
            step = preamble.dialect.number(segment.entry("Delta_X", column))
            begin = preamble.dialect.number(segment.entry("X0", column) or "0")
            times = even_times(values.size, step, begin) if step > 0 and np.isfinite(begin) else None
        else:
            times = segment.columns[clock][: values.size]
            if times.size and times[0] > SINCE_EPOCH:
                began = moment_after(LABVIEW_EPOCH, float(times[0]))
                times = times - times[0]
        unit = "s" if is_clock else segment.entry("Y_Unit_Label", column) or take_apart(name)[1]
        yield column, RecordedChannel(name, unit, values, times, is_clock=is_clock, start=began)


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
    text = re.sub(r"(\.\d{6})\d+", r"\1", f"{date} {time}".replace(",", "."))
    return moment_of(text, ("%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S"))


FORMAT = Format(
    name="lvm",
    summary="LabVIEW measurement text, in segments with headers.",
    suffixes=(".lvm",),
    options=TextOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
