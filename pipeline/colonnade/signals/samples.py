"""Samples of long records: stretches of them, missing ones, piece by piece, several records in threads."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask

Item = TypeVar("Item")
Result = TypeVar("Result")

BLOCK = 1 << 15
"""Samples processed together, so that they stay in the processor's cache."""

MOST = 4
"""Threads; more wait for memory rather than for a processor."""


def stretches(chosen: Mask) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """
    Find the stretches of chosen samples.

    Parameters
    ----------
    chosen : ndarray of bool, shape (n,)

    Returns
    -------
    starts, stops : ndarray of int, shape (m,)
        Of each, as in a slice.

    Examples
    --------
    >>> starts, stops = stretches(np.array([True, True, False, True]))
    >>> starts.tolist(), stops.tolist()
    ([0, 3], [2, 4])
    """
    padded = np.zeros(chosen.size + 2, dtype=bool)
    padded[1:-1] = chosen
    edges = np.flatnonzero(padded[1:] != padded[:-1])
    return edges[::2], edges[1::2]


def filled_in(values: Array, fewest: int = 0) -> Array:
    """Return values with straight lines where some are missing, the nearest at the ends; none if too few are there."""
    finite = np.isfinite(values)
    if np.count_nonzero(finite) < fewest:
        return np.empty(0)
    return values if finite.all() else np.interp(np.arange(values.size), np.flatnonzero(finite), values[finite])


def blocks(size: int, length: int = BLOCK) -> Iterator[slice]:
    """
    Go through an array piece by piece.

    Examples
    --------
    >>> list(blocks(5, 3))
    [slice(0, 3, None), slice(3, 5, None)]
    """
    return (slice(start, min(start + length, size)) for start in range(0, size, length))


def threads() -> int:
    """Count the threads that are worth while here."""
    return min(MOST, os.cpu_count() or 1)


def side_by_side(function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """
    Apply a function to each item, in threads.

    Parameters
    ----------
    function : callable
        Spends its time where Python lets other threads run, as numpy does in long arrays.
    items : iterable

    Returns
    -------
    results : list
        In the order of the items.

    Examples
    --------
    >>> side_by_side(abs, [-1, 2, -3])
    [1, 2, 3]
    """
    with ThreadPoolExecutor(threads()) as pool:
        return list(pool.map(function, items))
