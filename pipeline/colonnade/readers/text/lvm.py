"""LabVIEW measurement files (.lvm): text in segments, each with a header of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.clock import even_times, moment_after
from colonnade.readers.format import Format, Recognition
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.heading import take_apart
from colonnade.readers.text.lines.encoding import TextOptions
from colonnade.readers.text.lines.numbered import NumberedLines, first_lines
from colonnade.readers.text.lines.rows import filled_length
from colonnade.readers.text.lvm_segments import Preamble, Segment, read_preamble, read_segments

SIGNATURE = "LabVIEW Measurement"
LABVIEW_EPOCH = datetime(1904, 1, 1)
SINCE_EPOCH = 1e9
"""Seconds: larger x-values count from LabVIEW's epoch, not from the start of the recording."""


Piece = tuple[RecordedChannel, datetime | None]
"""A column's samples in one segment, and when it began; their times, if x is a time, count from there."""


def recognise(path: Path) -> Recognition:
    """Say whether the first line is that of a LabVIEW measurement file."""
    head = first_lines(path, 1)
    if head and head[0].startswith(SIGNATURE):
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
    pieces: dict[tuple[int, str], list[Piece]] = {}
    for segment in segments:
        for column, piece in _columns(segment, preamble):
            pieces.setdefault((column, piece[0].name), []).append(piece)
    timed = ((piece.time, began) for same in pieces.values() for piece, began in same if piece.time is not None)
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


def _columns(segment: Segment, preamble: Preamble) -> Iterator[tuple[int, Piece]]:
    """Take a segment's columns apart, each with its number."""
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
        yield column, (RecordedChannel(name, unit, values, times, is_clock=is_clock), began)


def _even_times(segment: Segment, preamble: Preamble, column: int, count: int) -> Array | None:
    """Times by the header's interval; None if it gives none."""
    step = preamble.dialect.number(segment.entry("Delta_X", column))
    begin = preamble.dialect.number(segment.entry("X0", column) or "0")
    return even_times(count, step, begin) if step > 0 and np.isfinite(begin) else None


def _joined(pieces: list[Piece], origin: datetime | None, preamble: Preamble) -> RecordedChannel:
    """Join a channel's pieces, on the clock of the recording's first sample."""
    first, _ = pieces[0]
    values = np.concatenate([piece.values for piece, _ in pieces])
    name = take_apart(first.name)[0]
    times: list[Array] = []
    shift, end = 0.0, np.inf
    for piece, began in pieces:
        if piece.time is None:
            return RecordedChannel(name, first.unit, values, heading=first.name)
        # x-values that go on where the segment before ended count from its beginning, not from this one's.
        goes_on = preamble.clocks != "no" and bool((piece.time[:1] > end).any())
        if not goes_on and began is not None and origin is not None:
            shift = (began - origin).total_seconds()
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
