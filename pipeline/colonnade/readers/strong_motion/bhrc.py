"""Strong-motion records of the Iranian network (BHRC, .V1): three components, each with a header, in one text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import Format, Options, Recognition
from colonnade.readers.text.clock import even_times
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


@dataclass(frozen=True)
class Component:
    """One of the components, as far as it is there; `rate` is the header's nominal one, in Hz."""

    name: str
    unit: str
    points: int
    duration: float
    rate: float
    values: Array
    line: int
    warnings: tuple[str, ...]

    @property
    def step(self) -> float:
        """Time step, s: that of the nominal rate; of the duration, from first to last point, if no rate is given."""
        return 1 / self.rate if 0 < self.rate < np.inf else self.duration / (self.points - 1)


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
        If a header is not whole or in a unit that is not known, or no numbers follow.
    """
    with NumberedLines(path) as lines:
        begun: list[int] = []
        components = list(_components(path, lines, begun))
    if not any(component.values.size for component in components):
        raise ReadError(f"{path.name}: no component with numbers was found: the file was cut off.")
    channels = tuple(
        RecordedChannel(
            component.name, component.unit, component.values, even_times(component.values.size, component.step)
        )
        for component in components
    )
    notes = [
        f'"{component.name}": {component.points} points at {1 / component.step:.6g} Hz, '
        + ("the header's rate" if component.rate > 0 else "from the header's duration")
        + f" (line {component.line})"
        for component in components
    ]
    warnings = [warning for component in components for warning in (*component.warnings, *_contradiction(component))]
    warnings += [f"the header that begins on line {line} is not whole: the file was cut off" for line in begun]
    return Recording(path, "bhrc", channels, notes=tuple(notes), warnings=tuple(warnings))


def _contradiction(component: Component) -> list[str]:
    """Tell of a rate and a duration that do not belong together; they may differ by a step or two."""
    lasts = component.points * component.step
    if abs(lasts - component.duration) <= max(2 * component.step, 0.01 * component.duration):
        return []
    return [
        f'"{component.name}": {component.points} points at the header\'s {component.rate:g} Hz last {lasts:g} s, '
        f"and the header says {component.duration:g} s: one of them is wrong; the rate is taken"
    ]


def _components(path: Path, lines: NumberedLines, begun: list[int]) -> Iterator[Component]:
    """Read component after component; the line of a header without numbers stays among the begun."""
    name, size = "", None
    for number, line in lines.rest():
        if line.startswith(FIRST_LINE):
            begun[:] = [number]
        elif found := COMPONENT.match(line):
            name = found["name"]
        elif found := SIZE.match(line):
            size = found
        elif (found := UNITS.match(line)) and size is not None:
            unit, factor = KNOWN_UNITS.get(found["unit"].casefold(), ("", 1.0))
            points, duration = int(size["points"]), float(size["duration"])
            if not unit or points < 2 or not duration > 0:
                raise ReadError(
                    f"{path.name}: the header above line {number} gives {points} points, {duration:g} s, unit "
                    f'"{found["unit"]}"; two points or more and a unit among {", ".join(KNOWN_UNITS)} were expected.'
                )
            list(islice(lines.rest(), WHOLE_ROWS))
            reals, _ = read_running(islice(lines.rest(), REAL_ROWS), width=REALS_WIDTH)
            values, warnings = read_running(islice(lines.rest(), -(-points // PER_ROW)), width=REALS_WIDTH)
            values = factor * values[:points]
            warnings += shortage(f'"{name}": the header', points, values.size)
            rate = float(reals[RATE]) if reals.size > RATE else float("nan")
            yield Component(name, unit, points, duration, rate, values, number, tuple(warnings))
            begun.clear()
            size = None


FORMAT = Format(
    name="bhrc",
    summary="Strong-motion records of the Iranian network (BHRC).",
    suffixes=(".v1",),
    recognise=recognise,
    read=read,
    in_process=True,
)
