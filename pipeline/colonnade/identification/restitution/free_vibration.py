"""A free vibration as the estimators of e use it: its samples, its arcs about their zero, and the settings."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.arcs import Arcs, arcs_between, find_impacts, noise_level
from colonnade.identification.restitution.estimators.estimator import Estimator, FitT_co
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion
from colonnade.identification.restitution.fitting.samples import AngleSamples
from colonnade.identification.restitution.result import Peaks

NOISE_MARGIN = 8.0
"""Excursions below this many standard deviations of the smoothed noise are not counted."""

SMOOTHED = 0.1
"""Over p: length over which the record is averaged to find its excursions."""

MOVING_TABLE = "The table moves: this estimator takes it to be at rest."


@dataclass(frozen=True)
class FreeVibration:
    """
    A record with the arcs seen in it.

    Attributes
    ----------
    block : Block
    samples : AngleSamples
        About the zero of the record.
    arcs : Arcs
        n of them, about the block's zero as far as it is known.
    usable : ndarray of bool, shape (n,)
        Arcs whose peak is known, below α and above `lowest`.
    lowest : float
        rad; lower peaks are not counted.
    noise : float
        Standard deviation of the averaged angle at rest, rad.
    least : float
        rad; arcs with lower peaks are not followed by a whole history.
    level : float
        Of the intervals.
    lowpass : float or None
        Hz, of the zero-phase Butterworth filter that the record went through; found from the residuals if None.
    free : tuple of {"critical_angle", "p"}
        What is identified with e.
    base : BaseMotion or None
        Motion of a table that moves.
    zero : float
        rad, what was taken off the angle for `arcs`.
    left_out : int
        Number of the first arcs that do not enter.
    fits : dict
        Fits of this record by the estimator's name, kept by `fitted`.
    """

    block: Block
    samples: AngleSamples
    arcs: Arcs
    usable: Mask
    lowest: float
    noise: float
    least: float
    level: float = 0.95
    lowpass: float | None = None
    free: tuple[str, ...] = ()
    base: BaseMotion | None = None
    zero: float = 0.0
    left_out: int = 0
    fits: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def seen(
        cls, samples: AngleSamples, block: Block, *, lowest_amplitude: float, noise: float | None, **settings: Any
    ) -> FreeVibration:
        """Find the arcs in the averaged samples, and fit them in the samples themselves."""
        step = samples.interval or float(np.median(np.diff(samples.time)))
        length = max(int(SMOOTHED / (block.p * step)), 1)
        smooth = _averaged(samples.angle, length)
        sampled = smooth[::length]
        scatter = noise_level(sampled[np.isfinite(sampled)]) if noise is None else noise
        least = lowest_amplitude * block.critical_angle
        lowest = max(least, NOISE_MARGIN * scatter)
        impacts = find_impacts(samples.time, smooth, lowest=lowest)
        arcs = arcs_between(impacts, samples.time, samples.angle, block.p, critical=block.critical_angle)
        return cls(block, samples, arcs, _usable(arcs, lowest, block), lowest, scatter, least, **settings)

    def about(self, zero: float) -> FreeVibration:
        """Return the record with its arcs about another zero (rad); what followed the samples stays as it is."""
        impacts = np.append(self.arcs.start, self.arcs.end[-1:])
        block, samples = self.block, self.samples
        arcs = arcs_between(impacts, samples.time, samples.angle - zero, block.p, critical=block.critical_angle)
        return replace(self, arcs=arcs, usable=_usable(arcs, self.lowest, block), zero=zero)

    def without_first(self, count: int) -> FreeVibration:
        """Return the record without its first arcs, which stay in `arcs` for their numbers."""
        if count == 0:
            return self
        usable = self.usable & (np.arange(self.usable.size) >= count)
        return replace(self, usable=usable, left_out=count, fits={})

    def fitted(self, estimator: Estimator[FitT_co]) -> FitT_co:
        """Return an estimator's fit; made when it is first asked for."""
        if estimator.name not in self.fits:
            refused = self.base is not None and not estimator.follows_table
            fit = estimator.refuse(self.level, MOVING_TABLE) if refused else estimator.fit(self)
            self.fits[estimator.name] = fit
        found: FitT_co = self.fits[estimator.name]
        return found

    @property
    def followed_arcs(self) -> Arcs:
        """Arcs from the first one on that enters."""
        return self.arcs.later(self.left_out)

    @property
    def peaks(self) -> Peaks:
        """The peaks of all arcs, without a fit."""
        arcs = self.arcs
        unfitted = np.full(arcs.peak_angle.shape, np.nan)
        return Peaks(arcs.peak_time, arcs.peak_angle, arcs.peak_standard_error, unfitted, self.usable)


def _usable(arcs: Arcs, lowest: float, block: Block) -> Mask:
    size = np.abs(arcs.peak_angle)
    high = size < block.critical_angle_at(arcs.peak_angle)
    return np.asarray(np.isfinite(arcs.peak_standard_error) & (size > lowest) & high)


def _averaged(angle: Array, length: int) -> Array:
    """Mean over `length` samples (made odd) about each; NaN where one is missing, and as recorded at the ends."""
    half = length // 2
    if half == 0 or angle.size <= 2 * half:
        return angle
    windows = np.lib.stride_tricks.sliding_window_view(angle, 2 * half + 1)
    return np.concatenate((angle[:half], windows.mean(axis=1), angle[-half:]))
