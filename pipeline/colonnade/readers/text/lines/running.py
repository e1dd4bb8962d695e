"""Numbers that run on from row to row, in fields that may touch -> one array."""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np

from colonnade.arrays import Array

FREE = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?")
SHOWN = 50


def read_running(lines: Iterable[tuple[int, str]], *, width: int | None = None) -> tuple[Array, list[str]]:
    """
    Read numbers row by row.

    Parameters
    ----------
    lines : iterable of (int, str)
        Number and text of each line.
    width : int, optional
        Characters of a field, as in `8F10.5`; without it, spaces or signs separate the fields.

    Returns
    -------
    values : ndarray, shape (n,)
        NaN for a field that is not a number.
    warnings : list of str
        Lines with such fields.
    """
    pieces: list[list[float]] = []
    faults: list[str] = []
    count = 0
    for number, line in lines:
        bare = line.rstrip()
        if not bare:
            continue
        values = _fields(bare, width)
        if any(value != value for value in values):
            count += 1
            faults = faults or [f'{number}: "{bare.strip()[:SHOWN]}"']
        pieces.append(values)
    warnings = []
    if count:
        what = "1 line holds" if count == 1 else f"{count} lines hold"
        first = "first " if count > 1 else ""
        warnings.append(f"{what} something that is not a number ({first}on line {faults[0]}); missing")
    return np.array([value for piece in pieces for value in piece], dtype=np.float64), warnings


def shortage(source: str, announced: int, found: int) -> list[str]:
    """Warn if there are fewer numbers than what is above them says."""
    if found >= announced:
        return []
    return [f"{source} gives {announced} points, but the file has {found}: it ends too early"]


def _fields(line: str, width: int | None) -> list[float]:
    """Numbers of a line."""
    if width is not None:
        return [_number(line[start : start + width]) for start in range(0, len(line), width)]
    return split_numbers(line)


def split_numbers(line: str) -> list[float]:
    """Numbers of a line, separated by blanks or by their signs; NaN for what is not a number."""
    fields = line.split()
    try:
        return [_finite(float(field)) for field in fields]
    except ValueError:
        pass
    values: list[float] = []
    for field in fields:
        parts = FREE.findall(field)
        # Without a blank between, a new number starts with its sign.
        whole = parts and "".join(parts) == field and all(part[0] in "+-" for part in parts[1:])
        values += [_number(part) for part in parts] if whole else [float("nan")]
    return values


def _number(field: str) -> float:
    text = field.strip()
    if FREE.fullmatch(text) is None:
        return float("nan")
    return _finite(float(text.replace("D", "E").replace("d", "e")))


def _finite(value: float) -> float:
    return value if abs(value) != float("inf") else float("nan")
