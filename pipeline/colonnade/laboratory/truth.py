"""The true motion of the virtual specimen on the virtual table, and its outcome."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.laboratory.integration import Integration
from colonnade.laboratory.table import TableMotion, still

NO_ROCKING_RATIO = 1e-3
"""A block whose largest |θ|/α stays at or below this has not rocked."""


@dataclass(frozen=True)
class Truth:
    """
    The true rocking history of one test.

    Attributes
    ----------
    block : Block
    time, angle : ndarray, shape (n,)
        s, rad.
    impact_times, impact_velocities : ndarray, shape (m,)
        s; rad/s just before each impact.
    overturning_time : float
        s, when |θ| passed α for good; NaN for a block that stands.
    """

    block: Block
    time: Array
    angle: Array
    impact_times: Array
    impact_velocities: Array
    overturning_time: float

    @property
    def amplitude(self) -> Array:
        """|θ|/α, shape (n,), with the critical angle of the side that each sample is on."""
        return np.asarray(np.abs(self.angle) / self.block.critical_angle_at(self.angle))

    @property
    def outcome(self) -> str:
        """no-rocking, rocking or overturned."""
        if np.isfinite(self.overturning_time):
            return "overturned"
        return "rocking" if self.amplitude.max() > NO_ROCKING_RATIO else "no-rocking"

    @property
    def peak_ratio(self) -> float | None:
        """Largest |θ|/α, of a free vibration after its first impact; None for a block that overturned."""
        return None if self.outcome == "overturned" else float(self.amplitude[self._rocked].max())

    @property
    def peak_time(self) -> float | None:
        """When that is, s."""
        if self.outcome == "overturned":
            return None
        return float(self.time[self._rocked][np.argmax(self.amplitude[self._rocked])])

    @property
    def release_ratio(self) -> float | None:
        """|θ|/α from which a free vibration was released; None for other tests."""
        return float(self.amplitude[0]) if self._is_released else None

    @property
    def _is_released(self) -> bool:
        return bool(self.angle[0] != 0.0)

    @property
    def _rocked(self) -> slice:
        """Samples of a free vibration from its first impact on, of other tests all."""
        if not (self._is_released and self.impact_times.size):
            return slice(None)
        return slice(int(np.searchsorted(self.time, self.impact_times[0])), None)


def simulate(
    block: Block,
    time: ArrayLike,
    table: TableMotion | None = None,
    *,
    restitution: float,
    theta0: float = 0.0,
    omega0: float = 0.0,
    release: float = 0.0,
    catch: float = pi / 2,
) -> Truth:
    """
    Integrate the rocking of a block.

    Parameters
    ----------
    block : Block
    time : array_like, shape (n,)
        When the angle is wanted, s, increasing; the test begins at 0 and ends with the last of them.
    table : TableMotion, optional
        Default: a table that stands still.
    restitution : float
        e of every impact.
    theta0, omega0 : float, optional
        Angle at which the block is held until `release` (s), and angular velocity with which it leaves, rad and rad/s.
    catch : float, optional
        |θ| at which the safety frame catches the block, which then stays there, rad.

    Returns
    -------
    truth : Truth

    Raises
    ------
    ValueError
        If e is not between 0 and 1, or the block is not released between the frame and its catch.
    """
    if not 0.0 <= restitution <= 1.0:
        raise ValueError(f"restitution is {restitution}; a number between 0 and 1 was expected")
    if not abs(theta0) < catch:
        raise ValueError(f"theta0 is {theta0} rad; an angle within the catch of {catch} rad was expected")
    run = Integration(block, np.atleast_1d(np.asarray(time, dtype=np.float64)), restitution, catch, theta0)
    run.move_to(release)
    run.release(theta0, omega0)
    for start, stop, acceleration in _pieces(table or still(), release, float(run.time[-1])):
        run.go(start, stop, acceleration)
        if run.caught:
            break
    overturning_time = run.passed if np.isfinite(run.passed) or run.stands_when_left_alone() else run.now
    impact_times, impact_velocities = np.array(run.impact_times), np.array(run.impact_velocities)
    return Truth(block, run.time, run.angles, impact_times, impact_velocities, overturning_time)


def _pieces(table: TableMotion, start: float, stop: float) -> list[tuple[float, float, Callable[[float], float]]]:
    """Pieces of the base motion from `start` to `stop`, rest included."""
    first = table.pieces[0].start if table.pieces else stop
    moving = ((piece.start, piece.stop, piece.acceleration) for piece in table.pieces)
    pieces = [(start, first, _no_acceleration), *moving, (table.stop, stop, _no_acceleration)]
    clipped = [(max(left, start), min(right, stop), function) for left, right, function in pieces]
    return [piece for piece in clipped if piece[1] > piece[0]]


def _no_acceleration(instant: float) -> float:
    return 0.0
