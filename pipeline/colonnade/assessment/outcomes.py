"""Outcomes of histories over intensity: records at levels, under draws of the block's properties, in directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.errors import count

FEWEST = 2
"""Of a curve: one record has no scatter between records."""


class Cells(NamedTuple):
    """
    Histories counted where record and intensity are the same.

    Attributes
    ----------
    log_intensity : ndarray, shape (r, m)
    events, histories : ndarray, shape (r, m)
        Histories in which it happened, and all of them; 0 where none was run.
    """

    log_intensity: Array
    events: Array
    histories: Array


@dataclass(frozen=True)
class Outcomes:
    """
    What became of each history; made by `gather`.

    Attributes
    ----------
    records : tuple of str, length r
        Their names. A record at many levels is one record: intervals resample records.
    levels : ndarray, shape (l,)
        Intensities to which all records are scaled, positive and rising.
    peak : ndarray, shape (r, l, d, c)
        max |θ| / α; 0 without uplift, NaN if the history was not run. Axes: record, level, draw, direction (components
        and signs). A draw is the same at all levels of its record. Other records have draws of their own; if all share
        the same few, every interval holds for those few alone.
    overturned : ndarray of bool, shape (r, l, d, c)
    """

    records: tuple[str, ...]
    levels: Array
    peak: Array
    overturned: Mask

    @property
    def was_run(self) -> Mask:
        """Which histories were run, shape (r, l, d, c)."""
        return ~np.isnan(self.peak)

    def cells(self, event: Mask | None = None, intensity: Array | None = None) -> Cells:
        """
        Count histories by record and intensity.

        Parameters
        ----------
        event : ndarray of bool, shape (r, l, d, c), optional
            What is counted. Default: overturning.
        intensity : ndarray, shape (r, l, 1) or (r, l, c), optional
            Of another measure, positive.
        """
        event = self.overturned if event is None else event
        rows = len(self.records)
        if intensity is None:
            intensity = np.tile(self.levels[:, None], (rows, 1, 1))
        axes = (2, 3) if intensity.shape[2] == 1 else (2,)
        events = (event & self.was_run).sum(axis=axes, dtype=np.float64)
        histories = self.was_run.sum(axis=axes, dtype=np.float64)
        return Cells(np.log(intensity).reshape(rows, -1), events.reshape(rows, -1), histories.reshape(rows, -1))

    def stripes(self) -> Cells:
        """Count overturned histories by record and level, of the levels at which there are histories."""
        cells = self.cells()
        counted = cells.histories.any(axis=0)
        return Cells(*(each[:, counted] for each in cells))


def gather(records: Sequence[str], levels: ArrayLike, peak: ArrayLike, overturned: Mask | None = None) -> Outcomes:
    """
    Bring outcomes to their axes.

    Parameters
    ----------
    records : sequence of str, length r
        Names, each once.
    levels : array_like, shape (l,)
        As of `Outcomes`.
    peak : array_like, shape (r, l), (r, l, d) or (r, l, d, c)
        max |θ| / α; NaN if the history was not run. Each record has a history.
    overturned : ndarray of bool, shape of peak, optional
        Default: peak above 1.

    Raises
    ------
    ValueError
        If there are fewer than `FEWEST` records.
    """
    if len(records) < FEWEST:
        raise ValueError(f"records has {count(len(records), 'name')}; at least {FEWEST} were expected")
    peaks = np.asarray(peak, dtype=np.float64)
    peaks = peaks.reshape(*peaks.shape, *(1,) * (4 - peaks.ndim))
    over = peaks > 1.0 if overturned is None else overturned.reshape(peaks.shape)
    return Outcomes(tuple(records), np.asarray(levels, dtype=np.float64), peaks, over & ~np.isnan(peaks))
