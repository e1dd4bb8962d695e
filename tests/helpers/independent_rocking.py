"""Rocking by an adaptive method of eighth order with events: slow, and independent of the package's kernels."""

import itertools
import math
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion

LIES = 1.5
"""rad: beyond it a block has overturned."""
REST_ANGLE = 1e-6
"""Of α: after an impact whose next arc would stay below it, the block rests; part of the model, so the same here."""


def arc(rates, t, end, state, side):
    """From t to its landing, to lying or to the end: the time, angle and velocity there, and whether it landed."""
    solver = DOP853(rates, t, np.array(state), end, rtol=2.3e-14, atol=1e-17)
    while solver.status == "running" and side * solver.y[0] <= LIES:
        solver.step()
        dense = solver.dense_output()
        looks = np.linspace(solver.t_old, solver.t, 10)
        below = side * dense(looks)[0] < 0.0
        below[0] = False
        if below.any():
            last = int(np.argmax(below))
            landing = solver.t_old
            if side * dense(looks[last - 1])[0] > 0.0:
                landing = brentq(lambda x, dense=dense: dense(x)[0], looks[last - 1], looks[last], xtol=1e-17)
            return landing, 0.0, dense(landing)[1], True
    return solver.t, *solver.y, False


@dataclass
class Reference:
    """
    A block on a recorded motion, integrated arc by arc by SciPy's DOP853; uplift and landing by Brent's method.

    The landing is sought on the dense output, of which the sign is looked at nine times a step.
    """

    block: Block
    motion: Motion
    restitution: object
    model: str
    impacts: list = field(default_factory=list)
    uplifts: int = 0

    def _side(self, sign):
        side = self.block.positive if sign > 0 else self.block.negative
        return side.critical_angle, self.block.side_p(side)

    def _moment(self, lift, pull, sign):
        """Excess over what holds the block at rest on this side, over m g R."""
        critical, _ = self._side(sign)
        if self.model == "linear":
            return -sign * pull - lift * critical
        return -sign * pull * math.cos(critical) - lift * math.sin(critical)

    def angles(self, angle, velocity):
        gravity, dt = self.block.gravity, self.motion.dt
        pulls = self.motion.acceleration / gravity
        vertical = np.zeros_like(pulls) if self.motion.vertical is None else self.motion.vertical / gravity
        sign = math.copysign(1.0, angle if angle else velocity)
        resting = angle == 0.0 and velocity == 0.0
        found = [angle]
        for (a0, a1), (v0, v1) in zip(itertools.pairwise(pulls), itertools.pairwise(vertical), strict=True):
            pull = lambda t, a0=a0, a1=a1: a0 + (a1 - a0) * t / dt  # noqa: E731
            lift = lambda t, v0=v0, v1=v1: 1.0 + v0 + (v1 - v0) * t / dt  # noqa: E731
            t = 0.0
            while t < dt:
                if resting:
                    excess = {s: (lambda x, s=s: self._moment(lift(x), pull(x), s)) for s in (-1.0, 1.0)}  # noqa: B023
                    starts = [
                        (t if excess[s](t) > 0 else brentq(excess[s], t, dt, xtol=1e-16), s)
                        for s in excess
                        if excess[s](t) > 0 or excess[s](dt) > 0
                    ]
                    if not starts:
                        break
                    (t, sign), resting = min(starts), False
                    self.uplifts += 1
                t, angle, velocity, landed = self.arc(t, dt, angle, velocity, sign, pull, lift)
                if landed:
                    self.impacts.append(velocity)
                    angle, velocity, sign = 0.0, self.restitution(sign, abs(velocity)) * velocity, -sign
                    holding = -self._moment(lift(t), pull(t), sign)
                    critical, p = self._side(sign)
                    if holding >= 0 and velocity**2 / (2 * p**2) <= REST_ANGLE * critical * holding:
                        resting, velocity = True, 0.0
            found.append(angle)
        return np.array(found)

    def arc(self, t, dt, angle, velocity, sign, pull, lift):
        """From t to its landing or dt: the time, angle and velocity there, and whether it landed."""
        critical, p = self._side(sign)

        def rates(x, y):
            lean = critical * sign - y[0]
            if self.model == "linear":
                return np.array([y[1], -(p**2) * (lift(x) * lean + pull(x))])
            return np.array([y[1], -(p**2) * (lift(x) * math.sin(lean) + pull(x) * math.cos(lean))])

        return arc(rates, t, dt, (angle, velocity), sign)
