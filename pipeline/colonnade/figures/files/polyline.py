"""Paths of straight lines in SVG, in fewer characters: from point to point instead of from the corner."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

_NUMBERS_ONLY = str.maketrans("MLz", "   ")


def shorter(path: str) -> str:
    """
    Write a path of straight lines by steps, rounded to hundredths.

    Points are rounded first, so that no error grows along a line.

    Parameters
    ----------
    path : str
        The attribute `d` with M, L, Q, C and z, as matplotlib writes it.

    Returns
    -------
    shorter : str
        The same lines; a path with curves comes back as it is.

    Examples
    --------
    >>> shorter("M 72 50.404 L 72.5 49.1 L 73 60 z")
    'M72 50.4l.5-1.3 .5 10.9z'
    """
    if "C" in path or "Q" in path:
        return path
    numbers = np.fromstring(path.translate(_NUMBERS_ONLY), sep=" ")
    return _steps(path.split("M")[1:], np.rint(100 * numbers).astype(np.int64))


class _Steps(dict[int, str]):
    """Hundredths as text, each written once; the sign or a space parts it from what is before."""

    def __missing__(self, hundredths: int) -> str:
        text = f"{abs(hundredths) / 100:.2f}".strip("0").rstrip(".") or "0"
        self[hundredths] = f"-{text}" if hundredths < 0 else f" {text}"
        return self[hundredths]


_STEPS = _Steps()


def _steps(lines: list[str], numbers: NDArray[np.int64]) -> str:
    """Write lines, as given behind each M, with all their coordinates in hundredths."""
    steps = numbers.copy()
    steps[2:] -= numbers[:-2]
    texts = [_STEPS[step] for step in steps.tolist()]
    written: list[str] = []
    start = 0
    for line in lines:
        end = start + 2 + 2 * line.count("L")
        written += "M", _joined(_STEPS[number] for number in numbers[start : start + 2].tolist())
        if end > start + 2:
            written += "l", _joined(texts[start + 2 : end])
        if "z" in line:
            written.append("z")
        start = end
    return "".join(written)


def _joined(texts: Iterable[str]) -> str:
    return "".join(texts).lstrip()
