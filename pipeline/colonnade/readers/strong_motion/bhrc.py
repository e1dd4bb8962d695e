"""Strong-motion records of the Iranian network (BHRC, .V1): three components, each with a header, in one text."""

from __future__ import annotations

import re
from itertools import islice
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.lines.numbered import NumberedLines, first_lines
from colonnade.readers.text.lines.running import read_running, shortage

FIRST_LINE = "* VOL"
COMPONENT = re.compile(r"\s*COMP\s+(?P<name>\S+)")
SIZE = re.compile(r"\s*NO\. OF POINTS\s*=\s*(?P<points>\d{1,12})\s+DURATION\s*=\s*(?P<duration>\d+\.?\d*|\.\d+)")
UNITS = re.compile(r"\s*UNITS ARE SECONDS AND\s+(?P<unit>\S+)")
KNOWN_UNITS = {"g/10": ("g", 0.1), "g": ("g", 1.0), "cm/sec2": ("cm/s^2", 1.0), "cm/sec/sec": ("cm/s^2", 1.0)}
"""Unit and factor of the units that a header names; a tenth of g has no sign of its own."""
WHOLE_ROWS, REAL_ROWS = 8, 7
"""Lines below that of the units: a blank one and seven of whole numbers, then seven of real ones."""
RATE = 6
"""Place, from 0, of the nominal sampling rate among the real numbers."""
REALS_WIDTH = 13
PER_ROW = 10


def recognise(path: Path) -> Recognition:
    """Say whether the head is that of a BHRC record."""
    head = first_lines(path, 13)
    if head and head[0].startswith(FIRST_LINE) and any(COMPONENT.match(line) for line in head):
        return Recognition(True, 'the first line is "* VOL…" and one below starts with COMP')
    return Recognition(False, 'the first line is not "* VOL…", with COMP below')


def read(path: Path, options: Options) -> Recording:
    """
    Read a BHRC record.

    Raises
    ------
    ReadError
        If a header is in a unit that is not known.
    """
    channels: list[RecordedChannel] = []
    notes: list[str] = []
    warnings: list[str] = []
    begun = 0
    name, size = "", None
    with NumberedLines(path) as lines:
        for number, line in lines.rest():
            if line.startswith(FIRST_LINE):
                begun = number
            elif found := COMPONENT.match(line):
                name = found["name"]
            elif found := SIZE.match(line):
                size = int(found["points"]), float(found["duration"])
            elif (found := UNITS.match(line)) and size is not None:
                channels.append(_component(path, lines, name, found["unit"], *size, notes, warnings))
                begun, size = 0, None
    if begun:
        warnings.append(f"the header that begins on line {begun} is incomplete: the file was cut off")
    return Recording(path, "bhrc", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))


def _component(
    path: Path,
    lines: NumberedLines,
    name: str,
    written: str,
    points: int,
    duration: float,
    notes: list[str],
    warnings: list[str],
) -> RecordedChannel:
    """Read a component from the line of its units on; the step is that of its rate, else of its duration."""
    number = lines.number
    unit, factor = KNOWN_UNITS.get(written.casefold(), ("", 1.0))
    if not unit or points < 2 or not duration > 0:
        raise ReadError(
            f"{path.name}: the header above line {number} gives {points} points, {duration:g} s, unit "
            f'"{written}"; two points or more and a unit among {", ".join(KNOWN_UNITS)} were expected.'
        )
    lines.skip(WHOLE_ROWS)
    reals, _ = read_running(islice(lines.rest(), REAL_ROWS), width=REALS_WIDTH)
    rate = float(reals[RATE]) if reals.size > RATE else float("nan")
    step = 1 / rate if 0 < rate < np.inf else duration / (points - 1)
    values, told = read_running(islice(lines.rest(), -(-points // PER_ROW)), width=REALS_WIDTH)
    values = factor * values[:points]
    by = "the header's rate" if rate > 0 else "from the header's duration"
    notes.append(f'"{name}": {points} points at {1 / step:.6g} Hz, {by} (line {number})')
    warnings += [*told, *shortage(f'"{name}": the header', points, values.size)]
    lasts = points * step
    if abs(lasts - duration) > max(2 * step, 0.01 * duration):  # they may differ by a step or two
        warnings.append(
            f'"{name}": {points} points at the header\'s {rate:g} Hz last {lasts:g} s, and the header says '
            f"{duration:g} s: one of them is wrong; the rate is used"
        )
    return RecordedChannel(name, unit, values, even_times(values.size, step))


FORMAT = Format(
    name="bhrc",
    summary="Strong-motion records of the Iranian network (BHRC).",
    suffixes=(".v1",),
    recognise=recognise,
    read=read,
    in_process=True,
)
