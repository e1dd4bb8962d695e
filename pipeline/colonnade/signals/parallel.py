"""Work on several long arrays in threads, with the same result as one by one."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

MOST = 4
"""Threads; more wait for memory rather than for a processor."""


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
