"""The coefficient of restitution from the samples of a free vibration, with what is known of the block beforehand."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from math import exp

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.identification.restitution.follower import FIXED, GAIN, MEAN, TILT, ZERO
from colonnade.identification.restitution.noise import find_knee
from colonnade.identification.restitution.path import LIKELY_SCATTER, Path, UnfollowedError
from colonnade.identification.restitution.result import Joint
from colonnade.identification.restitution.scatter import LinearModel, Solved

FEWEST_ARCS = 4
"""Arcs that have to be followed in the end, that after release included."""

LEAST_NOISE = 1e-6
"""Of α, standard deviation: less is the rounding of computed records."""

MISFIT = 4.0
"""Times as much residual power with the part from the release on, from which the block was not released from rest."""

FEWEST_SAMPLES = 64
"""From which a spectrum is looked at."""

MOST_LAID = 4
"""Times that a path is laid with the scatter, and the trend, that the last one shows."""

ODD_RELEASE = 2.0
"""Times as much residual power after the release as later, from which the block was not released from rest."""

SURE_TREND = 0.003
"""Probability of a change of e with the speed of impact by chance, below which the mean is that at the mean speed."""

FEWEST_OF_TREND = 5
"""Impacts."""

METHOD = "whole history: penalised least squares on the samples, with an e of its own at each impact about one mean"


@dataclass(frozen=True)
class Estimated:
    """A path through the record, and what it says of the unknowns about it."""

    path: Path
    model: LinearModel
    solved: Solved

    @cached_property
    def trend(self) -> tuple[float, float]:
        """Change of ln e over the speeds of impact seen, that all else leaves, and its error."""
        solved = self.model.with_direction(self.speeds).solved()
        return float(solved.mean[-1]), float(np.sqrt(solved.covariance[-1, -1]))

    @property
    def has_trend(self) -> bool:
        """Whether e surely changes with the speed of impact."""
        impacts = self.path.count - 1
        if impacts < FEWEST_OF_TREND:
            return False
        change, error = self.trend
        return 2 * float(scipy.special.stdtr(impacts - 2, -abs(change) / error)) < SURE_TREND

    @cached_property
    def answer(self) -> Solved:
        """What the record says of the mean e; of that at the mean speed, if e surely changes with the speed."""
        if not self.has_trend:
            return self.solved
        # It is not quite linear: e over the speed and ln e over it cannot both be.
        bent = self.speeds**2 - (self.speeds**2).mean()
        return self.model.with_direction(bent, 4 / self.trend[0] ** 4).with_direction(self.speeds).solved()

    @property
    def restitution(self) -> float:
        """The mean e."""
        return exp(float(self.answer.mean[MEAN]))

    @property
    def zero(self) -> float:
        """Zero of the angle in the middle of the record, rad."""
        return float(self.path.values[ZERO])

    @property
    def speeds(self) -> Array:
        """Speed of each impact between two arcs from their mean, over their range."""
        speed = self.path.followed.speeds[:-1]
        return np.asarray((speed - speed.mean()) / max(float(np.ptp(speed)), 1e-300))

    @property
    def joint(self) -> Joint:
        """ln e, and ln of α and of p over those of the block."""
        mean = self.answer.mean
        return Joint(mean[:GAIN], self.answer.covariance[:GAIN, :GAIN], float(mean[GAIN]))

    @property
    def tilt(self) -> tuple[float, float]:
        """Half the difference of ln α of the two sides beyond that of the block, and its error."""
        return float(self.answer.mean[TILT]), float(np.sqrt(self.answer.covariance[TILT, TILT]))


def estimate(path: Path, lowest: float) -> Estimated:
    """
    Follow a record from a path of its first arcs on, and say what is known of the unknowns then.

    Parameters
    ----------
    path : Path
    lowest : float
        rad; lower peaks are not followed.

    Raises
    ------
    UnfollowedError
        If no path follows the record.
    numpy.linalg.LinAlgError
        If the record does not separate the unknowns.
    """
    path = path.laid_forward(lowest)
    released = path.with_release()
    if released is not None:
        with suppress(UnfollowedError):
            found = _estimated(released)
            # On a table that moves, a release at rest may lead astray.
            if found.path.power < MISFIT * path.power and not _is_odd(found.path):
                return found
    return _estimated(path)


def _is_odd(path: Path) -> bool:
    """Whether the part after the release is not as near to the path as the rest."""
    residual, arc = path.residual, path.followed.arc
    first, rest = residual[(arc == 0) & path.counted], residual[(arc > 0) & path.counted]
    if first.size < 2:
        return False
    return bool((first**2).mean() > ODD_RELEASE * max((rest**2).mean(), _least(path)))


def _least(path: Path) -> float:
    return float((LEAST_NOISE * path.sides[0].min()) ** 2)


def _estimated(path: Path) -> Estimated:
    if path.count < FEWEST_ARCS:
        raise UnfollowedError(f"{FEWEST_ARCS} arcs are needed, and {path.count} could be followed")
    scatter, trend, passed = LIKELY_SCATTER, None, path.passed
    for _ in range(MOST_LAID):
        path = path.laid(scatter, trend)
        found = _linear(path)
        now, trend = max(found.answer.scatter, 1e-6), found.speeds if found.has_trend else None
        if abs(now - scatter) < 0.1 * scatter:
            break
        scatter = now
    has_spectrum = path.samples.is_even and path.counted.sum() >= FEWEST_SAMPLES
    if not (has_spectrum and passed.is_coloured(path.residual)):
        return found
    rows, frequency, _ = passed.whitened(path.columns, 0.0)
    knee = find_knee(rows, frequency, path.precision(now), found.model.level)
    return found if knee == 0 else _linear(path, knee)


def _linear(path: Path, knee: float = 0.0) -> Estimated:
    count = float(path.counted.sum())
    if knee == 0 and path.passed.cutoff_hz is None:
        both = path.products
    else:
        rows, _, share = path.passed.whitened(path.columns, knee)
        both, count = rows @ rows.T, count * share
    # As seen from the mean: what the impacts' own departures explain is left in the values.
    turn = np.eye(both.shape[0])
    turn[1 + FIXED :, 0] = path.deviations
    origin = path.values[:FIXED]
    model = LinearModel.of(turn.T @ both @ turn, path.precision(1.0)[:FIXED], origin, count, _least(path))
    return Estimated(path, model, model.solved())
