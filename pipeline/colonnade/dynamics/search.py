"""
One search over the amplitude of a base motion, for stability maps, overturning spectra and limits of pulses.

A scan is run, and each change between its outcomes is halved: from where on it overturns, and up to where it may not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, log2
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Codes, Mask
from colonnade.dynamics.plane.run import OVERTURNS
from colonnade.units.text import Digested
from colonnade.validation import number, samples

WIDTH = 0.01
"""In A: narrower intervals of overturning, or of survival, are islands and make no limit."""

LEAST_EDGE = 1e-9
"""In A: the least edge; a finer one is lost in rounding, so that the search for it would not end."""

STEPS_A_WIDTH = 4
"""Scan steps a width, at least: nothing wider than a fourth of a width is passed over."""

MOST_STEPS = 1_000_000
"""Of the scan over A, and cells of a map; a thousand times what a map has."""

LARGEST_RATIO = 1e6
"""Of Ω and A, and one over their least."""

Runs = Callable[[Array], Codes]
"""Returns the outcomes at some A, indices into `OUTCOMES`."""


class Limits(NamedTuple):
    """
    Limits in A.

    Attributes
    ----------
    lower : float
        Start of the first overturning interval at least `width` wide; NaN without one.
    upper : float
        End of the last surviving interval by the same rule; NaN if that reaches the largest A, or without one.
    intervals : ndarray, shape (k, 2)
        Every interval of A that overturns, from and to.
    codes : ndarray of int8, shape (n,)
        Outcomes of the A that were scanned.
    """

    lower: float
    upper: float
    intervals: Array
    codes: Codes


def checked_ratios(name: str, values: ArrayLike, *, fewest: int = 1) -> Array:
    """Check rising values of Ω or A; ValueError if one is out of the range of all motions and blocks."""
    ratios = samples(name, values, dimensions=(0, 1), fewest=fewest).ravel()
    expected = f"a number from {1 / LARGEST_RATIO:g} to {LARGEST_RATIO:g}"
    for end in (ratios.min(), ratios.max()):
        number(name, end, expected, low=1 / LARGEST_RATIO, high=LARGEST_RATIO)
    if not (np.diff(ratios) > 0).all():
        raise ValueError(f"{name} has to be increasing")
    return ratios.copy()


def checked_widths(width: float, edge: float, height: float) -> tuple[float, float]:
    """
    Check the least width of a limit and the closeness of its edges where A goes over `height`, so that the search ends.
    """
    finest = STEPS_A_WIDTH * height / MOST_STEPS
    width = number("width", width, f"a width in A, at least {finest:.3g} for the scan to end,", above=0.0, low=finest)
    expected = f"a number in A from {LEAST_EDGE:g} to the width, {width:g},"
    edge = number("edge", edge, expected, low=LEAST_EDGE, high=width)
    return width, edge


def scan_over(amplitudes: Array, width: float) -> Array:
    """Give the A to run: the rising ones given, and between them as many as make steps of width / 4."""
    steps = np.maximum(np.ceil(np.diff(amplitudes) / (width / STEPS_A_WIDTH) * (1 - 1e-9)), 1.0)
    knots = np.concatenate([[0.0], np.cumsum(steps)])
    return np.interp(np.arange(knots[-1] + 1.0), knots, amplitudes)


def limits_of(scan: Array, runs: Runs, *, width: float, edge: float) -> Limits:
    """
    Run some A, rising, and find the limits between their outcomes; intervals narrower than `width` make no limit, edges
    are found to `edge`.
    """
    codes = runs(scan)
    intervals = _intervals(scan, codes == OVERTURNS, lambda amplitudes: runs(amplitudes) == OVERTURNS, edge)
    stands = np.concatenate([scan[:1], intervals.ravel(), scan[-1:]]).reshape(-1, 2)
    falls, stands = (each[each[:, 1] - each[:, 0] >= width] for each in (intervals, stands))
    lower = float(falls[0, 0]) if falls.size else float("nan")
    upper = float(stands[-1, 1]) if stands.size and stands[-1, 1] < scan[-1] else float("nan")
    return Limits(lower, upper, intervals, codes)


def onset_of(scan: Array, codes: Codes, runs: Runs, *, edge: float) -> float:
    """Find the A from which a block first does not stay at rest, to `edge`; NaN if it always does. As `limits_of`."""
    moves = codes > 0
    if not moves.any():
        return float("nan")
    first = slice(int(np.argmax(moves)) + 1)
    return float(_intervals(scan[first], moves[first], lambda amplitudes: runs(amplitudes) > 0, edge)[0, 0])


def _intervals(scan: Array, found: Mask, holds: Callable[[Array], Mask], edge: float) -> Array:
    """Intervals in which something holds, shape (k, 2): each change in the scan halved down to `edge`."""
    changes = np.flatnonzero(found[1:] != found[:-1])
    low, high, before = scan[changes], scan[changes + 1], found[changes]
    if changes.size:
        for _ in range(max(0, ceil(log2(float((high - low).max()) / edge)))):
            middle = 0.5 * (low + high)
            as_before = holds(middle) == before
            low, high = np.where(as_before, middle, low), np.where(as_before, high, middle)
    first = scan[:1] if found[0] else scan[:0]
    last = scan[-1:] if found[-1] else scan[:0]
    return np.concatenate([first, 0.5 * (low + high), last]).reshape(-1, 2)


@dataclass(frozen=True, repr=False, kw_only=True)
class OverFrequency(Digested):
    """
    Limits of overturning over frequency.

    Attributes
    ----------
    frequency_ratio : ndarray, shape (n,)
        Ω = ω / p.
    lower, upper : ndarray, shape (n,)
        A = a / (g tan α), a the largest acceleration: from which the block first overturns over at least `width`, and
        up to which it last survives over at least `width`; NaN if there is no such limit up to the largest A.
    interval_frequency_ratio, interval_start, interval_end : ndarray, shape (k,)
        Every interval of A that overturns, islands included, by its Ω.
    options : dict
        All that the limits depend on.
    """

    _ESSENCE = "frequency_ratio, lower, upper"

    frequency_ratio: Array
    lower: Array
    upper: Array
    interval_frequency_ratio: Array
    interval_start: Array
    interval_end: Array
    options: dict[str, Any]

    @property
    def islands(self) -> Array:
        """Overturning intervals narrower than `width`: rows of Ω, start and end in A, shape (k, 3)."""
        rows = np.column_stack([self.interval_frequency_ratio, self.interval_start, self.interval_end])
        return np.asarray(rows[self.interval_end - self.interval_start < self.options["width"]])


def over_frequency(frequency_ratio: Array, limits: Sequence[Limits]) -> dict[str, Array]:
    """Put the limits at each Ω together, by the names of `OverFrequency`."""
    intervals = np.concatenate([each.intervals for each in limits])
    return {
        "frequency_ratio": frequency_ratio,
        "lower": np.array([each.lower for each in limits]),
        "upper": np.array([each.upper for each in limits]),
        "interval_frequency_ratio": np.repeat(frequency_ratio, [len(each.intervals) for each in limits]),
        "interval_start": intervals[:, 0],
        "interval_end": intervals[:, 1],
    }
