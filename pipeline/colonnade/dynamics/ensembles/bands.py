"""
Quantiles of many histories at each of their samples, in memory that does not grow with their number.

At each sample the deviations from one central history are counted in bins whose width grows with the deviation: eight
to each doubling, from 2⁻²² to 2⁶. Counts are whole numbers, so that parts of an ensemble add up to the same whatever
their order. A quantile is interpolated within its bin; it is right to a fraction of an eighth of the deviation.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

Counts = NDArray[np.uint32]

_MANTISSA_BITS = 3
_SHIFT = 23 - _MANTISSA_BITS
_LOWEST, _HIGHEST = 2.0**-22, 2.0**6
_FIRST = int(np.float32(_LOWEST).view(np.int32)) >> _SHIFT
_SIDE = (int(np.float32(_HIGHEST).view(np.int32)) >> _SHIFT) - _FIRST
BINS = 2 * _SIDE + 1
"""Bins at each sample: those of negative deviations, from the largest, then one about zero, then the positive ones."""


def empty_counts(samples: int) -> Counts:
    """Return counts of no history yet, shape (samples, `BINS`)."""
    return np.zeros((samples, BINS), dtype=np.uint32)


def count(counts: Counts, deviations: NDArray[np.float32]) -> None:
    """
    Add histories to the counts, in place.

    Parameters
    ----------
    counts : ndarray, shape (samples, BINS)
    deviations : ndarray of float32, shape (histories, samples)
        From the central history, over α.

    Raises
    ------
    ValueError
        If the shapes do not belong together or a deviation is NaN.
    """
    if deviations.ndim != 2 or deviations.shape[1] != counts.shape[0]:
        raise ValueError(f"deviations have shape {deviations.shape}; (histories, {counts.shape[0]}) was expected")
    if np.isnan(deviations).any():
        raise ValueError("a deviation is NaN; finite angles were expected")
    _count(counts, np.ascontiguousarray(deviations, dtype=np.float32).view(np.int32))


def band(counts: Counts, levels: Sequence[float]) -> Array:
    """
    Read quantiles of the deviations off the counts.

    Parameters
    ----------
    counts : ndarray, shape (samples, BINS)
    levels : sequence of float
        Between 0 and 1, increasing.

    Returns
    -------
    deviations : ndarray, shape (len(levels), samples)
        Over α.

    Raises
    ------
    ValueError
        If nothing was counted, or the levels are not increasing from 0 to 1.
    """
    asked = np.asarray(levels, dtype=np.float64)
    if asked.ndim != 1 or not (np.all(np.diff(asked) > 0) and np.all((asked >= 0) & (asked <= 1))):
        raise ValueError(f"levels are {list(levels)}; numbers between 0 and 1 that increase were expected")
    if not counts.any():
        raise ValueError("no history was counted; at least one was expected")
    return _band(counts, asked, _edges())


def _edges() -> Array:
    """Edges of the bins, shape (BINS + 1,)."""
    positive = ((np.arange(_SIDE + 1, dtype=np.int32) + _FIRST) << _SHIFT).view(np.float32).astype(np.float64)
    return np.concatenate((-positive[::-1], positive))


@kernel
def _count(counts: Counts, bits: NDArray[np.int32]) -> None:
    histories, samples = bits.shape
    for sample in range(samples):
        for history in range(histories):
            # The bits of a positive float grow with its logarithm: their leading ones are the number of its bin.
            place = ((bits[history, sample] & 0x7FFFFFFF) >> _SHIFT) - _FIRST + 1
            place = min(max(place, 0), _SIDE)
            counts[sample, _SIDE - place if bits[history, sample] < 0 else _SIDE + place] += 1


@kernel
def _band(counts: Counts, levels: Array, edges: Array) -> Array:
    samples, bins = counts.shape
    deviations = np.empty((levels.size, samples))
    for sample in range(samples):
        total = 0
        for place in range(bins):
            total += counts[sample, place]
        level, below = 0, 0
        for place in range(bins):
            here = counts[sample, place]
            while level < levels.size and here > 0 and below + here >= levels[level] * total:
                share = (levels[level] * total - below) / here
                deviations[level, sample] = edges[place] + share * (edges[place + 1] - edges[place])
                level += 1
            below += here
            if level == levels.size:
                break
    return deviations
