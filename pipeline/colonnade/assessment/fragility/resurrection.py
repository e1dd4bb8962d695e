"""Histories that overturn at one level and survive at a higher one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.assessment.fragility.outcomes import Outcomes


@dataclass(frozen=True)
class Resurrection:
    """
    How often a stronger motion spares what a weaker one overturned.

    Attributes
    ----------
    pairs : float
        Share of the pairs of record and draw (in each direction) that overturn at a level and survive at a higher one.
    records : tuple of str
        In which it happens.
    lost : float
        Share of all histories that survive although the same pair overturned at a lower level: what the curve would
        gain if overturning once were overturning at all higher levels.
    """

    pairs: float
    records: tuple[str, ...]
    lost: float


def resurrection(outcomes: Outcomes) -> Resurrection:
    """Count resurrections; the levels of a record are compared by their intensities."""
    over, was_run = by_intensity(outcomes)[1:]
    before = np.logical_or.accumulate(over, axis=1)
    lost: Mask = before & ~over & was_run
    pairs: Mask = np.any(lost, axis=1)
    counted = np.any(was_run, axis=1)
    names = tuple(name for name, has in zip(outcomes.records, np.any(pairs, axis=(1, 2)), strict=True) if has)
    return Resurrection(float(pairs.sum() / counted.sum()), names, float(lost.sum() / was_run.sum()))


def by_intensity(outcomes: Outcomes) -> tuple[Array, Mask, Mask]:
    """Give intensity, overturned and was_run with the levels of each record and direction in rising order."""
    intensity = np.broadcast_to(outcomes.intensity[:, :, None, :], outcomes.peak.shape)
    order = np.argsort(intensity, axis=1)
    over, was_run = (np.take_along_axis(each, order, axis=1) for each in (outcomes.overturned, outcomes.was_run))
    return np.take_along_axis(intensity, order, axis=1), over, was_run
