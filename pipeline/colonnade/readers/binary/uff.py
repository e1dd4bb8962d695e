"""Universal files with functions at nodes (UFF, data set 58), as text or with binary values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import BinaryIO

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording
from colonnade.readers.text.numbered import read_running

MARK = "-1"
HEADER_LINES = 11
TIME = 17
"""Kind of abscissa, among the data characteristics."""
TIME_RESPONSE = 1
"""Kind of function."""
REAL_KINDS = {2: "f4", 4: "f8"}
"""Kinds of ordinates that are real, in single and double precision."""
IEEE = "2"
BYTE_ORDERS = {"1": "<", "2": ">"}
LONGEST_LINE = 4096
OPENING = re.compile(rb" {4}-1 *\r?\n *\d{2,4} *\r?\n")
"""As Fortran writes the mark and the number of a data set; numbers of a table look otherwise."""
KNOWN_SETS = frozenset(
    (15, 18, 55, 56, 57, 58, 82, 151, 164, 227, 252, 781, 1858, 2400, 2411, 2412, 2414, 2420, 2423, 2429, 2467, 3033)
)
"""Data sets of geometry, units, results and functions that programs of modal analysis write."""
DIRECTIONS = {
    **{1: "+X", -1: "-X", 2: "+Y", -2: "-Y", 3: "+Z", -3: "-Z"},
    **{4: "+RX", -4: "-RX", 5: "+RY", -5: "-RY", 6: "+RZ", -6: "-RZ"},
}


@dataclass(frozen=True)
class Function:
    """What the eleven lines of a data set 58 say (records 6 to 9 of its definition)."""

    name: str
    unit: str
    function: int
    kind: int
    points: int
    is_even: bool
    begin: float
    step: float
    is_time: bool
    time_unit: str


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first lines open a data set: one of any number, if they are written as universal files are."""
    lines = [line.strip() for line in head.content.split(b"\n")]
    opened = lines[0] == b"-1" and len(lines) > 1
    if opened and lines[1].split(b" ")[0] in (b"58", b"58b"):
        return Recognition(True, "it opens with a data set 58")
    found = opened and any(one == b"-1" and two.split(b" ")[0] in (b"58", b"58b") for one, two in pairwise(lines))
    if found:
        return Recognition(True, "it opens with -1 and holds a data set 58")
    if opened and OPENING.match(head.content) and int(lines[1]) in KNOWN_SETS:
        return Recognition(True, f"it opens with -1 and a data set {int(lines[1])}")
    return Recognition(False, "it does not open with -1 and the number of a data set")


def read(path: Path, options: Options) -> Recording:
    """
    Read the functions of time in a universal file.

    Raises
    ------
    ReadError
        If it holds none.
    """
    warnings: list[str] = []
    notes: list[str] = []
    channels: list[RecordedChannel] = []
    functions, others = 0, dict[str, None]()
    with path.open("rb") as stream:
        for place, header in _data_sets(stream):
            fields = header.split()
            if fields[0] not in ("58", "58b"):
                notes.append(f"data set {fields[0]} at byte {place}: left out")
                others[fields[0]] = None
                continue
            functions += 1
            try:
                channel = _function(stream, fields, warnings, notes, place)
            except (ValueError, IndexError, OverflowError) as error:
                warnings.append(f"the data set 58 at byte {place} is damaged or was cut off ({error}); left out")
                continue
            if channel is not None:
                channels.append(channel)
    if not functions:
        held = ", ".join(others) or "of no kind"
        raise ReadError(
            f"{path.name}: a universal file without functions: it holds data sets {held}, but no "
            'data set 58, the one with recorded histories. Export the time histories ("functions at '
            'nodal DOF", data set 58).'
        )
    names = [channel.name for channel in channels]
    if len(set(names)) < len(names):
        notes.append("several functions have the same name: refer to them by number")
    if any(channel.time is not None for channel in channels):
        notes.append("clock: each function's own abscissa")
    return Recording(path, "uff", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))


def _data_sets(stream: BinaryIO) -> Iterator[tuple[int, str]]:
    """Find the data sets; each is left to the caller to read from the line below its number on."""
    while line := stream.readline(LONGEST_LINE):
        if line.strip() == MARK.encode():
            header = MARK
            while header == MARK:  # the mark that closes one set and the one that opens the next
                place = stream.tell()
                header = stream.readline(LONGEST_LINE).decode("latin-1").strip()
            if header:
                yield place, header


def _function(
    stream: BinaryIO, fields: list[str], warnings: list[str], notes: list[str], place: int
) -> RecordedChannel | None:
    """Read a data set 58; raises ValueError or IndexError if it is incomplete."""
    head = _head([_decoded(stream.readline(LONGEST_LINE)).rstrip("\r\n") for _ in range(HEADER_LINES)])
    if head.kind not in REAL_KINDS or not (head.is_time or head.function == TIME_RESPONSE):
        notes.append(f'"{head.name}": not a real function of time (kind {head.function}); left out')
        return None
    if fields[0] == "58b":
        numbers = _binary(stream, fields, head)
    else:
        numbers, told = _text(stream, head)
        warnings += [f'"{head.name}", the data set at byte {place}: {text}' for text in told]
    wanted = head.points if head.is_even else 2 * head.points
    if numbers.size < wanted:
        warnings.append(f'"{head.name}": the data set should have {wanted} numbers but has {numbers.size}: cut off')
    numbers = numbers[:wanted]
    values = numbers if head.is_even else numbers[1::2]
    time: Array | None
    if head.is_even:
        time = even_times(values.size, head.step, head.begin) if head.step > 0 else None
    else:
        time = numbers[0::2][: values.size].copy()
    if time is not None:
        time *= TIME_UNITS.get(head.time_unit.casefold(), 1.0)
    return RecordedChannel(head.name, head.unit or None, values, time)


def _head(lines: list[str]) -> Function:
    """Take the eleven lines apart, by their columns."""
    kinds, sizes, abscissa, ordinate = lines[5], lines[6].split(), lines[7], lines[8]
    points = int(sizes[1])
    if points < 0:
        raise ValueError(f"{points} points")
    direction = DIRECTIONS.get(int(kinds[51:55] or 0), "")
    node = f"{kinds[31:41].strip()} {kinds[41:51].strip()} {direction}".replace("NONE", "").strip()
    title = lines[0].strip()
    return Function(
        name=title if title and title.upper() != "NONE" else f"node {node}",
        unit=_label(ordinate[46:66]),
        function=int(kinds[:5]),
        kind=int(sizes[0]),
        points=points,
        is_even=int(sizes[2]) == 1,
        begin=float(sizes[3]),
        step=float(sizes[4]),
        is_time=int(abscissa[:10]) == TIME,
        time_unit=_label(abscissa[46:66]) or "s",
    )


def _decoded(line: bytes) -> str:
    """Text of a header's line: UTF-8 if it is valid, else Windows-1252."""
    try:
        return line.decode("utf-8")
    except UnicodeDecodeError:
        return line.decode("cp1252", errors="replace")


def _label(text: str) -> str:
    bare = text.strip()
    return "" if bare.upper() == "NONE" else bare


def _text(stream: BinaryIO, head: Function) -> tuple[Array, list[str]]:
    """Read the numbers of a text, up to the line that closes the data set."""

    def lines() -> Iterator[tuple[int, str]]:
        number = 0
        while line := stream.readline(LONGEST_LINE):
            number += 1
            if line.strip() == MARK.encode():
                return
            yield number, line.decode("latin-1")

    return read_running(lines())


def _binary(stream: BinaryIO, fields: list[str], head: Function) -> Array:
    """Read binary numbers; uneven abscissae are in single precision."""
    order, size = BYTE_ORDERS.get(fields[1]), int(fields[4])
    if order is None or fields[2] != IEEE or size < 0:
        raise ValueError(f"byte order {fields[1]}, floating point {fields[2]}")
    content = stream.read(size)
    kind = np.dtype(order + REAL_KINDS[head.kind])
    if head.is_even:
        return np.frombuffer(content[: len(content) // kind.itemsize * kind.itemsize], kind).astype(np.float64)
    pair = np.dtype([("x", order + "f4"), ("y", kind)])
    pairs = np.frombuffer(content[: len(content) // pair.itemsize * pair.itemsize], pair)
    numbers = np.empty(2 * pairs.size)
    numbers[0::2], numbers[1::2] = pairs["x"], pairs["y"]
    return numbers


FORMAT = Format(
    name="uff",
    summary="Universal files with functions at nodes (data set 58), text or binary.",
    suffixes=(".uff", ".unv", ".uf"),
    recognise=recognise,
    read=read,
)
