"""
Free rocking by the full nonlinear equation in closed form, from release on.

    θ̈ = −p² sin(α sgn θ − θ)

The lean ψ = α − |θ| is a pendulum upside down: from its turning point ψₙ on,

    sin(ψ/2) = sin(ψₙ/2) / dn(p t | cos²(ψₙ/2))

Jacobi's functions are SciPy's; the estimator of e steps through time instead. An impact multiplies ω by its e.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from colonnade.arrays import Array


@dataclass(frozen=True)
class FreeRocking:
    """
    A block held at `release_angle` (rad, signed) until `release_time` (s), and then left alone.

    Attributes
    ----------
    critical_angle, p : (float, float)
        Of the sides θ < 0 and θ > 0: rad; rad/s.
    restitution : ndarray, shape (m,)
        e of each impact, before its speed counts; the record ends before a further one.
    release_angle, release_time : float
    by_speed : float
        Change of e from an impact at rest to one with p α, the mean of both sides.
    """

    critical_angle: tuple[float, float]
    p: tuple[float, float]
    restitution: Array
    release_angle: float
    release_time: float
    by_speed: float = 0.0

    def course(self) -> tuple[Array, Array, Array]:
        """
        Follow the arcs.

        Returns
        -------
        impacts : ndarray, shape (m,)
            Their times, s.
        restitution : ndarray, shape (m,)
            e of each.
        turning : ndarray, shape (m + 1,)
            sin²(ψₙ/2) of each arc, that from the release included.
        """
        side, time = int(self.release_angle > 0), self.release_time
        top = np.sin(self.critical_angle[side] / 2) ** 2
        fallen = top - np.sin((self.critical_angle[side] - abs(self.release_angle)) / 2) ** 2
        impacts, used, turning = [], [], [top - fallen]
        unit = float(np.mean(np.multiply(self.p, self.critical_angle)))
        for number, e in enumerate(self.restitution):
            time += (1 if number == 0 else 2) * self._half(side, fallen)
            speed = 2 * self.p[side] * np.sqrt(fallen)
            e -= self.by_speed * speed / unit
            impacts.append(time)
            used.append(e)
            side = 1 - side
            fallen = (e * speed / (2 * self.p[side])) ** 2
            turning.append(np.sin(self.critical_angle[side] / 2) ** 2 - fallen)
        return np.array(impacts), np.array(used), np.array(turning)

    def _half(self, side: int, fallen: float) -> float:
        """Half the duration of an arc, s; from sn² = (1 − dn²)/m and cn², without a difference of near numbers."""
        top = np.sin(self.critical_angle[side] / 2) ** 2
        phase = np.arctan2(np.sqrt(fallen), np.sqrt((top - fallen) * (1 - top)))
        return float(special.ellipkinc(phase, 1 - top + fallen)) / self.p[side]

    def end(self) -> float:
        """Middle of the arc after the last impact, s."""
        impacts, _, turning = self.course()
        side = (int(self.release_angle > 0) + impacts.size) % 2
        return float(impacts[-1]) + self._half(side, np.sin(self.critical_angle[side] / 2) ** 2 - float(turning[-1]))

    def angle(self, time: Array) -> Array:
        """Angle at given times, rad."""
        impacts, _, turning = self.course()
        first = int(self.release_angle > 0)
        sides = (first + np.arange(turning.size)) % 2
        p, critical = np.array(self.p)[sides], np.array(self.critical_angle)[sides]
        half = np.array(
            [
                self._half(int(side), float(np.sin(alpha / 2) ** 2 - depth))
                for side, alpha, depth in zip(sides, critical, turning, strict=True)
            ]
        )
        summits = np.append(self.release_time, impacts + half[1:])
        arc = np.searchsorted(impacts, time, side="right")
        argument = p[arc] * np.clip(time - summits[arc], -half[arc], half[arc])
        argument = np.where(time < self.release_time, 0.0, argument)
        _, _, dn, _ = special.ellipj(argument, 1 - turning[arc])
        lean = 2 * np.arcsin(np.minimum(np.sqrt(turning[arc]) / dn, 1.0))
        return np.where(sides[arc] == 1, 1.0, -1.0) * (critical[arc] - lean)
