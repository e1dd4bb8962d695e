"""Strong-motion records in the COSMOS text format (.V1, .V1C, .V2, .V2C): headers give their length, numbers follow."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options
from colonnade.readers.head import by_first_line
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.encoding import Text
from colonnade.readers.text.peer import spelled
from colonnade.readers.text.running import read_running, shortage

END_OF_DATA = re.compile(r"\s*(?:/&|end.of.data|$)", re.IGNORECASE)
FIRST_LINE = re.compile(r"\(Format v[\d.]+\s+with\s+\d{1,12}\s+text lines\)", re.IGNORECASE)
REALS = re.compile(
    r"\s*\d+\s+Real-header values follow on\s+(?P<lines>\d{1,12})\s+lines.*?\(\d*[EFI](?P<width>[1-9]\d{0,3})",
    re.IGNORECASE,
)
DATA = re.compile(
    r"\s*(?P<points>\d{1,12})\s+(?P<quantity>\w+)\s+(?:pts|points|data)\b"
    r".*?units?\s*=\s*(?P<unit>[^(,\s]*).*?\((?P<count>\d{0,4})[EFI](?P<width>[1-9]\d{0,3})",
    re.IGNORECASE,
)
LONGEST_LINE = 1000
"""Characters that are looked at; a line has 80 or 132."""
STEP = 61
"""Place, from 0, of the time step in ms among the real header values (COSMOS 1.20, Table 9, value 62)."""

recognise = by_first_line(FIRST_LINE, '"(Format v… with … text lines)"')


def read(path: Path, options: Options) -> Recording:
    """Read a COSMOS record of one or more channels; ReadError if a header is not whole or gives no time step."""
    lines = [line[:LONGEST_LINE] for line in Text.of(path).lines()]
    starts = [number for number, line in enumerate(lines) if FIRST_LINE.search(line)]
    channels: list[RecordedChannel] = []
    warnings: list[str] = []
    for number, (first, end) in enumerate(pairwise([*starts, len(lines)]), 1):
        channel = _channel(path, lines, first, end, warnings)
        is_known = channel.name in [other.name for other in channels]
        name = f"{channel.name} {number}" if is_known else channel.name
        channels.append(replace(channel, name=name, heading=name))
    return Recording(path, "cosmos", tuple(channels), warnings=tuple(warnings))


def _channel(path: Path, lines: list[str], first: int, end: int, warnings: list[str]) -> RecordedChannel:
    """Read the channel between two lines."""
    matches = ((number, match) for number in range(first, end) if (match := DATA.match(lines[number])))
    at, data = next(matches, (end, None))
    if data is None:
        raise ReadError(
            f"{path.name}: the header on line {first + 1} has no line of data in a unit: the file was cut off, "
            "or holds raw counts (V0). Copy it again, or download volume 1 (V1) or 2 (V2) of the record."
        )
    reals = np.empty(0)
    for number in range(first, at):
        if block := REALS.match(lines[number]):
            below = lines[number + 1 : min(number + 1 + int(block["lines"]), at)]
            reals, _ = read_running(enumerate(below, number + 2), width=int(block["width"]))
    points = int(data["points"])
    step = float(reals[STEP]) / 1000 if reals.size > STEP else float("nan")
    if not 0 < step < np.inf:
        raise ReadError(
            f"{path.name}: the real header values above line {at + 1} give no time step (value {STEP + 1})."
        )
    stop = min(at + 1 - (-points // int(data["count"] or 1)), end)
    stray = next((number for number in range(stop, end) if not END_OF_DATA.match(lines[number])), None)
    if stray is not None:
        told = f'line {stray + 1} ("{lines[stray].strip()[:30]}")'
        warnings.append(f"{told} does not belong to a channel: the file may have been cut off there")
    values, told_of = read_running(enumerate(lines[at + 1 : stop], at + 2), width=int(data["width"]))
    values = values[:points]
    warnings += [*told_of, *shortage(f"line {at + 1}", points, values.size)]
    times = even_times(values.size, step)
    return RecordedChannel(data["quantity"].casefold(), spelled(data["unit"]), values, times)


FORMAT = Format(
    name="cosmos",
    summary="Strong-motion records in the COSMOS text format: V1, V1C, V2, V2C.",
    suffixes=(".v1", ".v2", ".v1c", ".v2c"),
    recognise=recognise,
    read=read,
    in_process=True,
)
