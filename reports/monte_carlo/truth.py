"""
Free rocking by the full nonlinear equation in closed form, from release to rest.

    θ̈ = −p² sin(α sgn θ − θ)

The lean ψ = α − |θ| is a pendulum upside down: from its turning point ψₙ on,

    sin(ψ/2) = sin(ψₙ/2) / dn(p t | cos²(ψₙ/2))

For what needs derivatives and impacts; Jacobi's functions are SciPy's. The records themselves are integrated.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from colonnade.arrays import Array

SMALLEST_ENERGY = 1e-18
"""Of that at release: what is left of it after later impacts is rest."""


@dataclass(frozen=True)
class FreeRocking:
    """
    A block held at `release_angle` (rad, signed) until `release_time` (s), and then left alone.

    Attributes
    ----------
    critical_angle, p, restitution : float
        rad; rad/s; e of every impact.
    release_angle, release_time : float
    zero_offset : float
        rad, added to every angle.
    """

    critical_angle: float
    p: float
    restitution: float
    release_angle: float
    release_time: float
    zero_offset: float = 0.0

    def course(self) -> tuple[Array, Array]:
        """Half durations of all arcs, s, the first being that of the release; sin²(ψₙ/2) at their turning points."""
        top = np.sin(self.critical_angle / 2) ** 2
        depth = top - np.sin((self.critical_angle - abs(self.release_angle)) / 2) ** 2
        impacts = int(np.ceil(0.5 * np.log(SMALLEST_ENERGY) / np.log(self.restitution)))
        fallen = depth * self.restitution ** (2.0 * np.arange(impacts + 1))
        turning = top - fallen
        # sn² = (1 − dn²)/m and cn² where dn = sin(ψₙ/2) / sin(α/2), each without a difference of near numbers.
        phase = np.arctan2(np.sqrt(fallen), np.sqrt(turning * (1 - top)))
        return special.ellipkinc(phase, 1 - turning) / self.p, turning

    def impact_times(self) -> Array:
        """When the block passes from side to side, s."""
        half, _ = self.course()
        return self.release_time + half[0] + np.concatenate(([0.0], np.cumsum(2 * half[1:])))

    def peak_angles(self) -> Array:
        """Angle at each turning point, rad, signed; the first is the release."""
        _, turning = self.course()
        sides = np.sign(self.release_angle) * (-1.0) ** np.arange(turning.size)
        return sides * (self.critical_angle - 2 * np.arcsin(np.sqrt(turning)))

    def angle(self, time: Array) -> Array:
        """Angle at given times, rad."""
        half, turning = self.course()
        impacts = self.release_time + half[0] + np.concatenate(([0.0], np.cumsum(2 * half[1:])))
        summits = np.concatenate(([self.release_time], impacts[:-1] + half[1:]))
        arc = np.searchsorted(impacts, time, side="right")
        moving = arc < half.size
        arc = np.minimum(arc, half.size - 1)
        argument = self.p * np.maximum(time - summits[arc], -half[arc])
        argument = np.where(time < self.release_time, 0.0, argument)
        _, _, dn, _ = special.ellipj(argument, 1 - turning[arc])
        lean = 2 * np.arcsin(np.sqrt(turning[arc]) / dn)
        side = np.sign(self.release_angle) * (1.0 - 2.0 * (arc % 2))
        return np.where(moving, side * (self.critical_angle - lean), 0.0) + self.zero_offset
