"""Universal files with functions at nodes (UFF, data set 58), as text or with binary values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path
from typing import BinaryIO

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording
from colonnade.readers.text.encoding import encoding_of
from colonnade.readers.text.running import read_running

MARK = b"-1"
FUNCTIONS = ("58", "58b")
"""Data sets of functions at nodes, in text and in binary."""
HEADER_LINES = 11
TIME = 17
"""Kind of abscissa, among the data characteristics."""
TIME_RESPONSE = 1
"""Kind of function."""
REAL_KINDS = {2: "f4", 4: "f8"}
"""Kinds of ordinates that are real, in single and double precision."""
IEEE = "2"
BYTE_ORDERS = {"1": "<", "2": ">"}
OPENING = re.compile(rb" {4}-1 *\r?\n *(?:\d{2,4}|58b .*) *\r?\n")
"""As Fortran writes the mark and the number of a data set; numbers of a table look otherwise."""
DIRECTIONS = {
    **{1: "+X", -1: "-X", 2: "+Y", -2: "-Y", 3: "+Z", -3: "-Z"},
    **{4: "+RX", -4: "-RX", 5: "+RY", -5: "-RY", 6: "+RZ", -6: "-RZ"},
}


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first lines open a data set."""
    if OPENING.match(head.content):
        return Recognition(True, "it opens with -1 and the number of a data set")
    return Recognition(False, "it does not open with -1 and the number of a data set")


def read(path: Path, options: Options) -> Recording:
    """Read the functions of time in a universal file; ReadError if it holds no functions."""
    warnings: list[str] = []
    notes: list[str] = []
    channels: list[RecordedChannel] = []
    held: list[str] = []
    with path.open("rb") as stream:
        for place, fields in _data_sets(stream):
            held.append(fields[0])
            if fields[0] not in FUNCTIONS:
                notes.append(f"data set {fields[0]} at byte {place}: left out")
                continue
            try:
                channels += _function(stream, fields, warnings, notes)
            except (ValueError, IndexError, OverflowError) as error:
                warnings.append(f"the data set 58 at byte {place} is damaged or was cut off ({error}); left out")
    if not {*FUNCTIONS} & {*held}:
        raise ReadError(
            f"{path.name}: a universal file without functions: it holds data sets {', '.join(dict.fromkeys(held))}, "
            'but no data set 58, the one with recorded histories. Export the time histories ("functions at nodal '
            'DOF", data set 58).'
        )
    if any(channel.time is not None for channel in channels):
        notes.append("clock: each function's own abscissa")
    return Recording(path, "uff", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))


def _data_sets(stream: BinaryIO) -> Iterator[tuple[int, list[str]]]:
    """Find the data sets; each is left to the caller to read from the line below its number on."""
    while line := stream.readline():
        if line.strip() == MARK:
            header = MARK
            while header == MARK:  # the mark that closes one set and the one that opens the next
                place = stream.tell()
                header = stream.readline().strip()
            if header:
                yield place, header.decode("latin-1").split()


def _function(stream: BinaryIO, fields: list[str], warnings: list[str], notes: list[str]) -> Iterator[RecordedChannel]:
    """Read a data set 58, its eleven lines by their columns; ValueError or IndexError if it is incomplete."""
    lines = [stream.readline() for _ in range(HEADER_LINES)]
    texts = (line.decode(encoding_of(line).name, errors="replace").rstrip("\r\n") for line in lines)
    title, *_, kinds, form, abscissa, ordinate, _, _ = texts
    direction = DIRECTIONS.get(int(kinds[51:55] or 0), "")
    node = f"node {kinds[31:41].strip()} {kinds[41:51].strip()} {direction}"
    name = _label(title) or node.replace("NONE", "").strip()
    number, points, spacing, start, interval = (*form.split(), *[""] * 5)[:5]
    function, kind, size, begin, step = int(kinds[:5]), int(number), int(points), float(start), float(interval)
    if size < 0:
        raise ValueError(f"{size} points")
    is_even, is_time = int(spacing) == 1, int(abscissa[:10]) == TIME
    if kind not in REAL_KINDS or not (is_time or function == TIME_RESPONSE):
        notes.append(f'"{name}": not a real function of time (kind {function}); left out')
        return
    if fields[0] == "58b":
        numbers = _binary(stream, fields, kind, is_even=is_even)
    else:
        rows = takewhile(lambda line: line.strip() != MARK, iter(stream.readline, b""))
        numbers, told = read_running(enumerate((row.decode("latin-1") for row in rows), 1))
        warnings += [f'"{name}", below its header: {text}' for text in told]
    wanted = size if is_even else 2 * size
    if numbers.size < wanted:
        warnings.append(f'"{name}": the data set should have {wanted} numbers but has {numbers.size}: cut off')
    values = numbers[:wanted] if is_even else numbers[1:wanted:2]
    time = None if is_even else numbers[: 2 * values.size : 2]
    if is_even and step > 0:
        time = even_times(values.size, step, begin)
    second = TIME_UNITS.get(_label(abscissa[46:66]).casefold(), 1.0)
    yield RecordedChannel(name, _label(ordinate[46:66]) or None, values, None if time is None else time * second)


def _label(text: str) -> str:
    bare = text.strip()
    return "" if bare.upper() == "NONE" else bare


def _binary(stream: BinaryIO, fields: list[str], kind: int, *, is_even: bool) -> Array:
    """Read binary numbers; uneven abscissae are in single precision."""
    order = BYTE_ORDERS.get(fields[1])
    if order is None or fields[2] != IEEE:
        raise ValueError(f"byte order {fields[1]}, floating point {fields[2]}")
    ordinate = [("y", order + REAL_KINDS[kind])]
    form = np.dtype(ordinate if is_even else [("x", order + "f4"), *ordinate])
    content = stream.read(int(fields[4]))
    found = np.frombuffer(content[: len(content) // form.itemsize * form.itemsize], form)
    return np.column_stack([found[each].astype(np.float64) for each in form.names or ()]).ravel()


FORMAT = Format(
    name="uff",
    summary="Universal files with functions at nodes (data set 58), text or binary.",
    suffixes=(".uff", ".unv", ".uf"),
    recognise=recognise,
    read=read,
)
