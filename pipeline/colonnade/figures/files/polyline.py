"""Paths of straight lines in SVG, in fewer characters: from point to point instead of from the corner."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

_STRAIGHT = re.compile(r"\s*(?:M[\s\d.eE+L-]*z?\s*)+")


def shorter(path: str) -> str:
    """
    Write a path of straight lines by steps, rounded to hundredths.

    Points are rounded first, so that no error grows along a line.

    Parameters
    ----------
    path : str
        The attribute `d` with M, L and z, as matplotlib writes it.

    Returns
    -------
    shorter : str
        The same lines; a path with curves comes back as it is.

    Examples
    --------
    >>> shorter("M 72 50.404 L 72.5 49.1 L 73 60 z")
    'M72 50.4l.5-1.3 .5 10.9z'
    """
    if not _STRAIGHT.fullmatch(path):
        return path
    return "".join(map(_line, path.split("M")[1:]))


class _Steps(dict[int, str]):
    """Hundredths as text, each written once; the sign or a space parts it from what is before."""

    def __missing__(self, hundredths: int) -> str:
        text = f"{abs(hundredths) / 100:.2f}".strip("0").rstrip(".") or "0"
        self[hundredths] = f"-{text}" if hundredths < 0 else f" {text}"
        return self[hundredths]


_STEPS = _Steps()


def _line(text: str) -> str:
    numbers = np.fromstring(text.replace("L", " ").replace("z", " "), sep=" ")
    points = np.rint(100 * numbers).astype(np.int64).reshape(-1, 2)
    start, steps = _written(points[:1]), _written(np.diff(points, axis=0))
    return f"M{start}{'l' if steps else ''}{steps}{'z' if 'z' in text else ''}"


def _written(hundredths: NDArray[np.int64]) -> str:
    return "".join(map(_STEPS.__getitem__, hundredths.ravel().tolist())).lstrip()
