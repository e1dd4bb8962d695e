"""The result of a model: a rocking history and its outcome."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.models import DEFAULT, MODELS
from colonnade.units.text import Digested

Outcome = Literal["no-rocking", "rocking", "overturned"]

NO_ROCKING_RATIO = 1e-3
"""A block whose largest |θ|/α stays at or below this has not rocked; the same for measured and predicted histories."""


@dataclass(frozen=True, repr=False)
class History(Digested):
    """
    A rocking history.

    Attributes
    ----------
    block : Block
    time, angle, angular_velocity : ndarray, shape (n,)
        s, rad, rad/s, at the samples of the base motion. A block past return ends at ±π/2.
    impact_times, impact_velocities, rebound_velocities : ndarray, shape (m,)
        s; rad/s just before each impact, and e times that just after it.
    overturning_time : float
        s, when |θ| passed α for good; NaN if the block does not overturn.
    model : str
        Whose equation it solves.

    Examples
    --------
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> history = colonnade.rock(block, theta0=0.5 * block.critical_angle, restitution=0.9, duration=5.0)
    >>> history.outcome, history.peak_ratio, history.peak_time, history.impacts
    ('rocking', 0.5, 0.0, 28)
    >>> float(history.amplitude[0]), float(history.energy[0])
    (0.5, 0.75)
    >>> history
    <History: outcome rocking, peak_ratio 0.5, overturning_time –, impacts 28, model linear>
    """

    _ESSENCE = "outcome, peak_ratio, overturning_time s, impacts, model"

    block: Block
    time: Array
    angle: Array
    angular_velocity: Array
    impact_times: Array
    impact_velocities: Array
    rebound_velocities: Array
    overturning_time: float
    model: str = DEFAULT

    @property
    def amplitude(self) -> Array:
        """|θ|/α with the critical angle of the side rocked on, shape (n,), dimensionless."""
        return amplitude(self.angle, self.block)

    @property
    def energy(self) -> Array:
        """
        Mechanical energy over the overturning barrier of the side rocked on, shape (n,).

        0 at rest, 1 where the block stands still on the critical angle; that of the model's own equation:
        [(ω/p)² + α² − (α − |θ|)²] / α², or [(ω/p)²/2 + cos(α − |θ|) − cos α] / (1 − cos α).
        """
        side = np.where(self.angle == 0, self.angular_velocity, self.angle)
        critical = self.block.critical_angle_at(side)
        speed = self.angular_velocity / self.block.p_at(side)
        if MODELS[self.model].is_linearised:
            return np.asarray((speed**2 + critical**2 - (critical - np.abs(self.angle)) ** 2) / critical**2)
        rise = np.cos(critical - np.abs(self.angle)) - np.cos(critical)
        return np.asarray((speed**2 / 2 + rise) / (1 - np.cos(critical)))

    @property
    def outcome(self) -> Outcome:
        """no-rocking, rocking or overturned."""
        if np.isfinite(self.overturning_time):
            return "overturned"
        return "rocking" if self.amplitude.max() > NO_ROCKING_RATIO else "no-rocking"

    @property
    def peak_ratio(self) -> float | None:
        """Largest |θ|/α; None if the block overturned."""
        return None if np.isfinite(self.overturning_time) else float(self.amplitude.max())

    @property
    def peak_time(self) -> float:
        """Time of the largest |θ|/α up to overturning, s."""
        standing = self.time <= self.overturning_time if np.isfinite(self.overturning_time) else slice(None)
        return float(self.time[standing][np.argmax(self.amplitude[standing])])

    @property
    def impacts(self) -> int:
        """Number of impacts that are followed by a peak above `NO_ROCKING_RATIO` α."""
        if self.impact_times.size == 0:
            return 0
        starts = np.searchsorted(self.time, self.impact_times)
        ends = np.append(starts[1:], self.time.size)
        rises = [self.amplitude[start:end].max(initial=0.0) for start, end in zip(starts, ends, strict=True)]
        return int((np.array(rises) > NO_ROCKING_RATIO).sum())


def amplitude(angle: Array, block: Block) -> Array:
    """Return |θ|/α, shape of `angle`, with the critical angle of the side that each sample is on."""
    return np.asarray(np.abs(angle) / block.critical_angle_at(angle), dtype=np.float64)


def capped(time: Array, angle: Array, overturning_time: float, block: Block) -> Array:
    """
    Return the angle (rad) up to ± the critical angle, where a block that overturned stays.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, rad; NaN where missing, but not after overturning.
    overturning_time : float
        s; NaN for a block that stands.
    block : Block
    """
    inside = np.clip(angle, -block.negative.critical_angle, block.positive.critical_angle)
    fallen = time >= overturning_time
    if fallen.any():
        known = angle[: int(np.argmax(fallen)) + 1]
        known = known[np.isfinite(known)]
        to_negative = known.size > 0 and known[-1] < 0
        inside[fallen] = -block.negative.critical_angle if to_negative else block.positive.critical_angle
    return np.asarray(inside, dtype=np.float64)
