"""Free rocking extrapolated through a record, from the arcs that are seen to those that follow."""

from __future__ import annotations

from dataclasses import replace
from math import exp, sqrt
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.arcs import Arcs
from colonnade.identification.restitution.arcs.energy import released_energy
from colonnade.identification.restitution.arcs.rocking_arc import kinetic, peak_of
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, Decay, first_values
from colonnade.identification.restitution.fitting.least_squares import DecayFit, Stretch, UnfollowedError, fit_decay
from colonnade.identification.restitution.fitting.samples import AngleSamples

FEWEST_SEEN = 2
"""Arcs that have to be seen in a row."""

FIRST_ARCS = 10
"""Arcs that are followed first; their number then grows fourfold as long as the next impacts are foreseen."""

FORESEEN = 0.1
"""Largest standard error of the last impact's time, as a share of its arc."""

BLURRED = 0.08
"""Margin about impacts, over p, while the record's low-pass is not known: 1 / (2 × default cut-off)."""

RELEASED = 0.15
"""Share of the way from release to the first impact that is not followed: how the block was let go is not known."""


def first_guess(arcs: Arcs, block: Block, *, linearised: bool) -> Decay:
    """Return the decay of the longest run of arcs on alternating sides, by their peaks."""
    seen = np.isfinite(arcs.peak_angle)
    follows = seen[1:] & seen[:-1] & (np.sign(arcs.peak_angle[1:]) == -np.sign(arcs.peak_angle[:-1]))
    breaks = np.flatnonzero(np.concatenate(([True], ~follows, [True])))
    longest = int(np.argmax(np.diff(breaks)))
    run = slice(int(breaks[longest]), int(breaks[longest + 1]))
    peaks, times = arcs.peak_angle[run], arcs.peak_time[run]
    if peaks.size < FEWEST_SEEN or not np.isfinite(peaks).all():
        raise UnfollowedError(f"{int(seen.sum())} arcs are too few, at least {FEWEST_SEEN} in a row are needed")
    critical = block.critical_angle_at(peaks)
    if (np.abs(peaks) >= critical).any():
        raise UnfollowedError("a peak is above the critical angle")
    size = np.abs(peaks)
    values = first_values(released_energy(size, critical), size, peak=float(size[0]), time=float(times[0]))
    return Decay(values, int(peaks[0] > 0), min(peaks.size, FIRST_ARCS), block, linearised)


def stretch_of(samples: AngleSamples, decay: Decay, *, from_release: bool = False, **kept: Any) -> Stretch:
    """Return the samples between the start of the first arc and the end of the last."""
    _, times, ends = decay.arcs()
    if not np.isfinite(ends).all():
        raise UnfollowedError("the block would overturn")
    start = times[0] + RELEASED * (ends[0] - times[0]) if from_release else 2 * times[0] - ends[0]
    start += 0.0 if from_release else BLURRED / float(decay.p.min())
    inside = slice(*np.searchsorted(samples.time, (start, ends[-1])))
    return Stretch(samples.time[inside], samples.angle[inside], interval=samples.interval, group=samples.group, **kept)


def fit_forward(
    samples: AngleSamples, decay: Decay, names: tuple[str, ...], lowest: float, *, from_release: bool
) -> tuple[DecayFit, bool]:
    """Follow the first arcs, then as many more as are foreseen, to the end of the record or the lowest peak."""
    margin = BLURRED / float(decay.p.max())
    while True:
        followed = fit_decay(decay, stretch_of(samples, decay, margin=margin), ALWAYS)
        longer = _longer(followed, samples, lowest)
        if longer is None:
            break
        decay = longer
    before = earlier(followed.decay, samples) if from_release else None
    if names != ALWAYS:
        followed = fit_decay(followed.decay, stretch_of(samples, followed.decay, margin=margin), names)
    if before is not None:
        try:
            return fit_decay(before, stretch_of(samples, before, from_release=True, margin=margin), names), True
        except UnfollowedError:
            pass
    return followed, False


def _longer(followed: DecayFit, samples: AngleSamples, lowest: float) -> Decay | None:
    """Return the decay with as many more arcs as the record has and the fit foresees; None for none."""
    further = replace(followed.decay, count=4 * followed.decay.count)
    derivatives = further.derivatives(ALWAYS)[:, 1, :]
    # Residuals of filtered noise are correlated over a few samples: twice the error that white noise would give.
    error = 2 * np.sqrt(followed.mean_square * ((derivatives @ followed.inverse) * derivatives).sum(axis=1))
    return extended(followed.decay, further, error, samples, max(lowest, 2 * sqrt(followed.mean_square)))


def extended(decay: Decay, further: Decay, error: Array, samples: AngleSamples, lowest: float) -> Decay | None:
    """
    Return a decay with as many more arcs as the record has and a longer one foresees; None for none.

    Parameters
    ----------
    decay, further : Decay
        With the arcs that are followed, and with more.
    error : ndarray, shape (further.count,)
        Standard error of the time of each peak, s.
    samples : AngleSamples
    lowest : float
        rad; lower peaks are not followed.
    """
    peaks, times, ends = further.arcs()
    good = np.isfinite(peaks) & (peaks > lowest) & (times < samples.time[-1]) & (error < FORESEEN * (ends - times))
    more = decay.count + int(np.argmin(np.append(good[decay.count :], False)))
    return None if more == decay.count else replace(decay, count=more)


def earlier(decay: Decay, samples: AngleSamples) -> Decay | None:
    """Return the decay with the release before its first arc; None if no such release leads to it."""
    peaks, times, ends = decay.arcs()
    critical, p, side = decay.critical, decay.p, 1 - decay.side
    ratio = p[decay.side] / p[side] / exp(decay.values["restitution"])
    energy = ratio**2 * kinetic(float(peaks[0]), float(critical[decay.side]), decay.linearised)
    peak = peak_of(energy, float(critical[side]), decay.linearised)
    if not peak < 0.99 * critical[side]:
        return None
    before = replace(decay, side=side, values=decay.values | {"peak": peak, "time": 0.0}, count=2)
    impact = float(before.arcs()[2][0])
    time = 2 * float(times[0]) - float(ends[0]) - impact
    if samples.time[0] > time + 0.9 * impact:
        return None
    deviations = np.concatenate(([0.0], decay.by_impact))
    return replace(before, values=before.values | {"time": time}, count=decay.count + 1, deviations=deviations)


def without_first(decay: Decay) -> Decay:
    """Return the decay from its second arc on."""
    peaks, times, _ = decay.arcs()
    values = decay.values | {"peak": float(peaks[1]), "time": float(times[1])}
    return replace(decay, side=1 - decay.side, values=values, count=decay.count - 1, deviations=decay.by_impact[1:])
