"""LabVIEW measurement files (.lvm): text in segments, each with a header of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times, moment_of, on_one_zero
from colonnade.readers.format import Format
from colonnade.readers.head import by_first_line
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.dialect import Dialect
from colonnade.readers.text.encoding import Text, TextOptions, pieces_of
from colonnade.readers.text.heading import take_apart
from colonnade.readers.text.rows import RowForm, filled_length, read_rows

SIGNATURE = "LabVIEW Measurement"
END_OF_HEADER = "***End_of_Header***"
HEADER_STARTS = ("Channels", "Notes")
"""With what a segment's header starts; notes are written in front of all else."""
COMMAS = re.compile(r"^Separator\W*comma", re.IGNORECASE | re.MULTILINE)
"""LabVIEW writes tabs or commas; this line may itself be written with the separator that it names."""
SINCE_EPOCH = 1e9
"""Seconds: larger x-values count from 1904, not from the start of the recording."""


class Header(NamedTuple):
    """A header, of the file or of a segment: its lines by their first cells, and the index of the line below it."""

    entries: dict[str, list[str]]
    below: int

    @classmethod
    def of(cls, lines: list[str], start: int, separator: str) -> Header:
        """Read the lines from one on, to the end mark or to the end of the file without one."""
        end = next((n for n in range(start, len(lines)) if lines[n].startswith(END_OF_HEADER)), len(lines))
        cells = [[cell.strip() for cell in line.split(separator)] for line in lines[start:end]]
        return cls({each[0]: each for each in cells}, end + 1)

    def entry(self, key: str, column: int = 1) -> str:
        """What it says of a column; empty if it says nothing."""
        return "".join(self.entries.get(key, [])[column : column + 1])

    @property
    def clocks(self) -> str:
        """How many columns hold times, as the header of the file says: "no", "one" or "multi"."""
        return (self.entry("X_Columns") or "One").casefold()

    def moment(self, column: int = 1) -> datetime | None:
        """Date and time of day of a column, `2013/02/19` and `09:51:40,7271890640258789063`."""
        return moment_of(f"{self.entry('Date', column)} {self.entry('Time', column)}")


recognise = by_first_line(re.compile(f"^{SIGNATURE}"), f'"{SIGNATURE}"')


def read(path: Path, options: TextOptions) -> Recording:
    """Read a LabVIEW file; channels of one name are joined over its segments by each segment's own date and time."""
    text = Text.of(path, options.encoding)
    lines, warnings = text.whole_lines()
    separator = "," if COMMAS.search("\n".join(lines[:12])) else "\t"
    header = Header.of(lines, 0, separator)
    if header.below > len(lines):
        raise ReadError(f'{path.name}: the line "{END_OF_HEADER}" is missing: the file was cut off in its header.')
    dialect = Dialect(separator, header.entry("Decimal_Separator") or ".")
    if dialect.decimal not in (".", ","):
        raise ReadError(f'{path.name}: Decimal_Separator is "{dialect.decimal[:20]}"; "." or "," was expected.')
    pieces: dict[tuple[int, str], list[RecordedChannel]] = {}
    at = next((n for n in range(header.below, len(lines)) if lines[n].strip()), len(lines))
    while at < len(lines):
        segment = Header.of(lines, at, separator)
        first = segment.below + 1
        stop = next((n for n in range(first, len(lines)) if lines[n].startswith(HEADER_STARTS)), len(lines))
        names = [name.strip() for line in lines[first - 1 : first] for name in line.split(separator)]
        while names and names[-1] in ("", "Comment"):
            names.pop()
        if names and lines[at].startswith(HEADER_STARTS):
            samples = segment.entries.get("Samples", [])
            kinds = ("empty" if header.clocks == "no" else "number", *["number"] * (len(names) - 1))
            form = RowForm(dialect, kinds, has_remarks=True, is_ragged=len({*filter(None, samples[1:])}) > 1)
            columns, told = read_rows(pieces_of(lines, first, stop), form, names)
            warnings += told
            for name, said, column in zip(names, samples, columns, strict=False):
                if said.isdecimal() and int(said) > (size := filled_length(column)):
                    ends = f'the header says {said}, "{name}" has {size}'
                    warnings.append(f"the samples below line {first} end too early: {ends}")
                    break
            for number, piece in _channels(names, columns, segment, header, dialect):
                pieces.setdefault((number, piece.heading), []).append(piece)
        else:
            wrong = f"line {at + 1}: the header of a segment is not whole: the file was cut off or is damaged"
            if not pieces:
                raise ReadError(f"{path.name}: {wrong}.")
            warnings.append(wrong)
        at = stop
    timed, start = on_one_zero([_joined(same) for same in pieces.values()])
    notes = (f"encoding {text.encoding}", f"clock: X_Columns is {header.clocks}")
    return Recording(path, "lvm", timed, start, notes, tuple(dict.fromkeys(warnings)))


def _channels(
    names: list[str], columns: list[Array], segment: Header, header: Header, dialect: Dialect
) -> Iterator[tuple[int, RecordedChannel]]:
    """Take a segment's columns apart, each with its number; their times count from the segment's start."""
    clock = 0
    for number, (name, whole) in enumerate(zip(names, columns, strict=True)):
        is_clock = number == 0 or (header.clocks == "multi" and number % 2 == 0)
        if is_clock and header.clocks == "no":
            continue  # an empty column
        clock = number if is_clock else clock
        owner = min(number + 1, len(names) - 1) if is_clock else number
        values = whole[: filled_length(whole)]
        if header.clocks == "no":
            step = dialect.number(segment.entry("Delta_X", number))
            begin = dialect.number(segment.entry("X0", number) or "0")
            times = even_times(values.size, step, begin) if step > 0 else None
        else:
            times = columns[clock][: values.size]
            if times.size and times[0] > SINCE_EPOCH:
                times = times - times[0]
        bare, in_name = take_apart(name or f"column {number + 1}")
        unit = "s" if is_clock else segment.entry("Y_Unit_Label", number) or in_name
        start = segment.moment(owner) or header.moment()
        yield number, RecordedChannel(bare, unit, values, times, name, is_clock, start=start)


def _joined(pieces: list[RecordedChannel]) -> RecordedChannel:
    """Join a channel's pieces; x-values behind those before go on from the same start, others count from their own."""
    begin, shift = pieces[0].start, 0.0
    times: list[Array] = []
    for before, piece in zip([pieces[0], *pieces], pieces, strict=False):
        if before.time is None or piece.time is None:
            break
        goes_on = (piece.time[:1] > before.time[-1:]).any()
        if not goes_on and begin is not None and piece.start is not None:
            shift = (piece.start - begin).total_seconds()
        times.append(piece.time + shift)
    whole = np.concatenate(times) if len(times) == len(pieces) else None
    return replace(pieces[0], values=np.concatenate([piece.values for piece in pieces]), time=whole)


FORMAT = Format(
    name="lvm",
    summary="LabVIEW measurement text, in segments with headers.",
    suffixes=(".lvm",),
    options=TextOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
