"""Strong-motion records in the COSMOS text format (.V1, .V1C, .V2, .V2C): headers give their length, numbers follow."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime
from itertools import islice
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times, moment_after, on_one_zero
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.numbered import NumberedLines, read_running, shortage
from colonnade.readers.text.peer import spelled

RAW_COUNTS = re.compile(r"\s*Raw\b", re.IGNORECASE)
"""How the first line of a record of volume 0 starts: counts of the recorder."""
END_OF_DATA = re.compile(r"/&|end.of.data", re.IGNORECASE)
FIRST_LINE = re.compile(r"\(Format v[\d.]+\s+with\s+(?P<lines>\d{1,12})\s+text lines\)", re.IGNORECASE)
BLOCK = re.compile(
    r"\s*\d+\s+(?P<kind>Integer|Real)-header values follow on\s+(?P<lines>\d{1,12})\s+lines"
    r".*?\(\d*[EFI](?P<width>[1-9]\d{0,3})",
    re.IGNORECASE,
)
COMMENTS = re.compile(r"\s*(?P<lines>\d{1,12})\s+Comment line", re.IGNORECASE)
DATA = re.compile(
    r"\s*(?P<points>\d{1,12})\s+(?P<quantity>\w+)\s+(?:pts|points|data)\b"
    r"(?:.*?approx\s+(?P<seconds>\d+\.?\d*|\.\d+)\s+secs)?.*?units?\s*=\s*(?P<unit>[^(,\s]*).*?\((?P<count>\d{0,4})[EFI](?P<width>[1-9]\d{0,3})",
    re.IGNORECASE,
)
STEP = 61
"""Place, from 0, of the time step in ms among the real header values (COSMOS 1.20, Table 9, value 62)."""
START = re.compile(
    r"start time\s*:\s*(\d{1,4})/(\d{1,4})/(\d{1,4}),?\s+(\d{1,2}):(\d{1,2}):([\d.]+)\s*(\w*)", re.IGNORECASE
)
COMPONENT = re.compile(r"^Sta\s+Cha\w*[\s:]*(?P<name>.*?)\s*(?:\(Rcrdr|Location|$)", re.IGNORECASE)


Part = tuple[RecordedChannel, str, str]
"""A record within a file: one channel, as far as it is there, its component, and a note."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first line gives a version of the COSMOS format."""
    if FIRST_LINE.search(head.first_line):
        return Recognition(True, "the first line gives a version of the COSMOS format")
    return Recognition(False, 'the first line does not give "(Format v… with … text lines)"')


def read(path: Path, options: Options) -> Recording:
    """
    Read a COSMOS record, with one or more channels.

    Raises
    ------
    ReadError
        If a header is not whole or gives no time step.
    """
    with NumberedLines(path) as lines:
        strays: list[str] = []
        warnings: list[str] = []
        parts = list(_parts(path, lines, strays, warnings))
    channels: list[RecordedChannel] = []
    notes: list[str] = []
    told = [f"{stray} does not belong to a channel: the file may have been cut off there" for stray in strays[:1]]
    for channel, component, note in parts:
        name = channel.name
        if name in [other.name for other in channels]:
            name = f"{name} {component or len(parts)}"
        channels.append(replace(channel, name=name, heading=name))
        notes.append(f'"{name}": {note}')
    timed, start = on_one_zero(channels)  # a damaged header may lack its zone
    return Recording(path, "cosmos", timed, start, tuple(notes), (*told, *warnings))


def _parts(path: Path, lines: NumberedLines, strays: list[str], warnings: list[str]) -> Iterator[Part]:
    """Read channel after channel; lines between them are added to the strays."""
    while (line := lines.peek()) is not None:
        found = FIRST_LINE.search(line)
        if found is None:
            lines.take()
            if line.strip() and not END_OF_DATA.match(line.strip()):
                strays.append(f'line {lines.number} ("{line.strip()[:30]}")')
            continue
        if RAW_COUNTS.match(line):
            raise ReadError(
                f"{path.name}: this is a COSMOS record of volume 0 (V0): raw counts of the recorder, not "
                "accelerations. Download or export the same record as volume 1 (V1) or volume 2 (V2)."
            )
        texts = [text for _, text in islice(lines.rest(), int(found["lines"]))]
        reals: Array = np.empty(0)
        data = None
        while (line := lines.take()) is not None and data is None:
            if block := BLOCK.match(line):
                below = islice(lines.rest(), int(block["lines"]))
                values, _ = read_running(below, width=int(block["width"]))
                reals = values if block["kind"].casefold() == "real" else reals
            elif comments := COMMENTS.match(line):
                lines.skip(int(comments["lines"]))
            elif data := DATA.match(line):
                break
            elif line.strip():
                raise ReadError(
                    f'{path.name}: line {lines.number} is "{line.strip()[:50]}"; a COSMOS header was expected there.'
                )
        if data is None:
            raise ReadError(f"{path.name}: the file ends within the headers, on line {lines.number}: it was cut off.")
        yield _part(path, lines, texts, reals, data, warnings)


def _part(
    path: Path, lines: NumberedLines, texts: list[str], reals: Array, data: re.Match[str], warnings: list[str]
) -> Part:
    """Read a channel's numbers."""
    line = lines.number
    points, width = int(data["points"]), int(data["width"])
    step = float(reals[STEP]) / 1000 if reals.size > STEP else float("nan")
    if not 0 < step < np.inf:
        raise ReadError(f"{path.name}: the real header values above line {line} give no time step (value {STEP + 1}).")
    rows = -(-points // int(data["count"] or 1))
    values, told = read_running(islice(lines.rest(), rows), width=width)
    values = values[:points]
    warnings += [*told, *shortage(f"line {line}", points, values.size)]
    seconds = float(data["seconds"] or "nan")
    if abs(points * step - seconds) > max(1.0, 0.02 * seconds):
        warnings.append(
            f"line {line} gives {seconds:g} s, but {points} points at {step:g} s are {points * step:g} s: "
            "the step is in doubt"
        )
    component = next((found["name"] for text in texts if (found := COMPONENT.match(text))), "")
    component = " ".join(component.split())
    times = even_times(values.size, step)
    quantity, unit = data["quantity"].casefold(), spelled(data["unit"])
    channel = RecordedChannel(quantity, unit, values, times, start=_start(texts))
    return channel, component, f"{points} points, step {step:g} s, {component} (line {line})"


def _start(texts: list[str]) -> datetime | None:
    """Date and time of the first sample, `06/16/2005, 20:53:04.400 UTC` or `2018/11/30 17:29:39.137 UTC`."""
    found = next((match for text in texts if (match := START.search(text))), None)
    if found is None:
        return None
    first, second, third, hour, minute = (int(group) for group in found.groups()[:5])
    year, month, day = (first, second, third) if first > 31 else (third, first, second)
    try:
        whole = datetime(year, month, day, hour, minute, tzinfo=UTC if found[7] in ("UTC", "GMT") else None)
        return moment_after(whole, float(found[6]))
    except ValueError:
        return None


FORMAT = Format(
    name="cosmos",
    summary="Strong-motion records in the COSMOS text format: V1, V1C, V2, V2C.",
    suffixes=(".v1", ".v2", ".v1c", ".v2c"),
    recognise=recognise,
    read=read,
    in_process=True,
)
