"""LabVIEW measurement files (.lvm): text in segments, each with a header of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times, moment_of, on_one_zero
from colonnade.readers.format import Format
from colonnade.readers.head import by_first_line
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.damage import mend
from colonnade.readers.text.dialect import Dialect
from colonnade.readers.text.encoding import Text, TextOptions, pieces_of
from colonnade.readers.text.heading import take_apart
from colonnade.readers.text.rows import RowForm, filled_length, read_rows

SIGNATURE = "LabVIEW Measurement"
END_OF_HEADER = "***End_of_Header***"
HEADER_STARTS = ("Channels", "Notes")
"""With what a segment's header starts; notes are written in front of all else."""
SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";", "space": " "}
SINCE_EPOCH = 1e9
"""Seconds: larger x-values count from 1904, not from the start of the recording."""


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
            same = pieces.setdefault((column, piece.heading), [])
            # x-values that go on where the segment before ended count from its beginning, not from their own.
            goes_on = preamble.clocks != "no" and bool(same) and _begins_behind(same[-1], piece)
            same.append(replace(piece, start=same[-1].start) if goes_on else piece)
    timed, start = on_one_zero([piece for same in pieces.values() for piece in same])
    in_turn = iter(timed)
    channels = tuple(_joined([*islice(in_turn, len(same))]) for same in pieces.values())
    notes = [f"encoding {text.encoding.name}", f"clock: X_Columns is {preamble.clocks}"]
    if len(segments) > 1:
        notes.append(f"{len(segments)} segments, joined by their dates and times")
    return Recording(path, "lvm", channels, start, tuple(notes), tuple(dict.fromkeys(warnings)))


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
        end = next((n for n in range(at, len(lines)) if lines[n].startswith(END_OF_HEADER)), len(lines))
        stop = next((n for n in range(end + 2, len(lines)) if lines[n].startswith(HEADER_STARTS)), len(lines))
        names = [name.strip() for line in lines[end + 1 : end + 2] for name in line.split(delimiter)]
        while names and names[-1] in ("", "Comment"):
            names.pop()
        wrong = ""
        if not lines[at].startswith(HEADER_STARTS):
            wrong = f'line {at + 1}: "Channels" was expected, the start of a segment\'s header; the file is damaged.'
        elif not names:
            wrong = f"the segment that starts on line {at + 1} ends within its header: the file was cut off"
        if wrong and not segments:
            raise ReadError(f"{path.name}: {wrong}")
        if wrong:
            warnings.append(wrong)
        else:
            names = [name or f"column {number}" for number, name in enumerate(names)]
            header = ([cell.strip() for cell in line.split(delimiter)] for line in lines[at:end])
            entries = {cells[0]: cells for cells in header}
            samples = entries.get("Samples", [])
            kinds = ("empty" if preamble.clocks == "no" else "number", *["number"] * (len(names) - 1))
            ragged = len({*filter(None, samples[1:])}) > 1
            form = RowForm(preamble.dialect, kinds, trailing=1, by_instrument=True, ragged=ragged)
            mended = mend(read_rows(pieces_of(lines, end + 2, stop), form), names)
            segments.append(Segment(entries, names, mended.columns))
            warnings += mended.warnings
            for name, said, column in zip(names, samples, mended.columns, strict=False):
                if said.isdecimal() and int(said) > (size := filled_length(column)):
                    told = f'the header says {said}, "{name}" has {size}'
                    warnings.append(f"the samples below line {end + 2} end too early: {told}")
                    break
        at = stop
    return segments, warnings


def _columns(segment: Segment, preamble: Preamble) -> Iterator[tuple[int, RecordedChannel]]:
    """Take a segment's columns apart, each with its number; their times, if x is a time, count from their start."""
    clock = 0
    for column, (name, whole) in enumerate(zip(segment.names, segment.columns, strict=True)):
        is_clock = column == 0 or (preamble.clocks == "multi" and column % 2 == 0)
        if is_clock and preamble.clocks == "no":
            continue  # an empty column
        clock = column if is_clock else clock
        owner = min(column + 1, len(segment.names) - 1) if is_clock else column
        values = whole[: filled_length(whole)]
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
                times = times - times[0]
        began = _moment(segment.entry("Date", owner), segment.entry("Time", owner))
        began = began or _moment(preamble.entries.get("Date", ""), preamble.entries.get("Time", ""))
        bare, in_name = take_apart(name)
        unit = "s" if is_clock else segment.entry("Y_Unit_Label", column) or in_name
        yield column, RecordedChannel(bare, unit, values, times, name, is_clock, start=began)


def _begins_behind(before: RecordedChannel, piece: RecordedChannel) -> bool:
    """Whether a piece begins later than the one before it ends."""
    return before.time is not None and piece.time is not None and bool((piece.time[:1] > before.time[-1:]).any())


def _joined(pieces: list[RecordedChannel]) -> RecordedChannel:
    """Join a channel's pieces."""
    values = np.concatenate([piece.values for piece in pieces])
    times = [piece.time for piece in pieces if piece.time is not None]
    whole = np.concatenate(times) if len(times) == len(pieces) else None
    return replace(pieces[0], values=values, time=whole, start=None)


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
