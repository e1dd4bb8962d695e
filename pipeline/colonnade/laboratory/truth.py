"""
The true motion of the virtual specimen on the virtual table, and its outcome: by an adaptive 8th-order method.

    θ̈ = −p² [ sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ) ]

Nothing here is shared with the models that predict: scipy's DOP853, started anew at every kink of the base motion, at
every impact and at every uplift, all of which are located as events.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise, product
from math import cos, nextafter, pi, sin, tan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import DOP853
from scipy.optimize import brentq

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Side
from colonnade.laboratory.table import Acceleration, TableMotion, still

Curve = Callable[[Any], Array]

RELATIVE_TOLERANCE = 1e-11
ABSOLUTE_TOLERANCE = 1e-15
"""rad and rad/s."""

LOOKS_PER_STEP = 8
"""Where a step is looked at for an impact, so that two crossings inside one step are not missed."""

LARGEST_STEP = 0.25
"""Of p t."""

REST_ANGLE = 1e-6
"""Rest rule: after an impact whose next arc would rise to less than this fraction of α, the block stands still until
the base acceleration lifts it again."""

NO_ROCKING_RATIO = 1e-3
"""A block whose largest |θ|/α stays at or below this has not rocked."""


def simulate(
    block: Block,
    time: ArrayLike,
    table: TableMotion | None = None,
    *,
    restitution: float,
    theta0: float = 0.0,
    release: float = 0.0,
    catch: float = pi / 2,
) -> Simulation:
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
    theta0 : float, optional
        Angle at which the block is held until `release` (s), rad.
    catch : float, optional
        |θ| at which the safety frame catches the block, which then stays there, rad; more than |theta0|.

    Returns
    -------
    truth : Simulation
    """
    wanted = np.atleast_1d(np.asarray(time, dtype=np.float64))
    run = Simulation(block, wanted, restitution, catch, (float(theta0), 0.0), release)
    for start, stop, acceleration in (table or still()).pieces(release, float(wanted[-1])):
        run.go(start, stop, acceleration)
    return run


class Simulation:
    """
    A block on its way through a test; see `simulate` for the arguments.

    Attributes
    ----------
    block : Block
    time, angle : ndarray, shape (n,)
        s, rad; filled as the test goes on.
    impact_times, impact_velocities : list of float
        s; rad/s just before each impact.
    now, theta, omega : float
        s, rad, rad/s.
    resting, caught : bool
        The block stands, or rests in its safety frame.
    """

    def __init__(
        self, block: Block, time: Array, restitution: float, catch: float, state: tuple[float, float], now: float = 0.0
    ) -> None:
        self.block, self.time, self.restitution, self.catch = block, time, restitution, catch
        (self.theta, self.omega), self.now = state, now
        self.angle = np.full(time.size, self.theta)
        self.filled = int(np.searchsorted(time, now, side="right"))
        self.resting, self.caught = state == (0.0, 0.0), False
        self.impact_times: list[float] = []
        self.impact_velocities: list[float] = []
        self._stand_on(1.0 if state >= (0.0, 0.0) else -1.0)

    @property
    def amplitude(self) -> Array:
        """|θ|/α, shape (n,), with the critical angle of the side that each sample is on."""
        return np.asarray(np.abs(self.angle) / self.block.critical_angle_at(self.angle))

    @property
    def outcome(self) -> str:
        """no-rocking, rocking or overturned: beyond α at the end."""
        if self.amplitude[-1] > 1.0:
            return "overturned"
        return "rocking" if self.amplitude.max() > NO_ROCKING_RATIO else "no-rocking"

    @property
    def peak(self) -> tuple[float | None, float | None]:
        """Largest |θ|/α, of a free vibration after its first impact, and when, s; None of a block that overturned."""
        if self.outcome == "overturned":
            return None, None
        first = int(np.searchsorted(self.time, self.impact_times[0])) if self.angle[0] and self.impact_times else 0
        sample = first + int(np.argmax(self.amplitude[first:]))
        return float(self.amplitude[sample]), float(self.time[sample])

    def move_to(self, instant: float, curve: Curve | None = None) -> None:
        """Let time pass, along the curve of a step, or without a change of the angle."""
        end = int(np.searchsorted(self.time, instant, side="right"))
        if end > self.filled:
            self.angle[self.filled : end] = self.theta if curve is None else curve(self.time[self.filled : end])[0]
            self.filled = end
        self.now = instant

    def go(self, start: float, stop: float, acceleration: Acceleration) -> None:
        """Integrate one smooth piece of the base motion."""
        self.now = start
        while self.now < stop and not self.caught:
            if self.resting:
                self._rest(stop, acceleration)
            else:
                self._rock(stop, acceleration)

    def _stand_on(self, side: float) -> None:
        self.side = side
        self.geometry: Side = self.block.positive if side > 0 else self.block.negative
        self.p = self.block.side_p(self.geometry)

    def _rest(self, stop: float, acceleration: Acceleration) -> None:
        """Stand still up to uplift or to the end of the piece."""
        looks = np.linspace(self.now, stop, LOOKS_PER_STEP + 1).tolist()
        for (left, right), side in product(pairwise(looks), (-1.0, 1.0)):
            excess = partial(self._excess, side, acceleration)
            if excess(right) > 0.0:
                instant = left if excess(left) > 0.0 else _root(excess, left, right)
                # The end of the bracket that is past the threshold: there the block does rise.
                while excess(instant) <= 0.0:
                    instant = nextafter(instant, right)
                self.move_to(instant)
                self._stand_on(side)
                self.omega, self.resting = 0.0, False
                return
        self.move_to(stop)

    def _excess(self, side: float, acceleration: Acceleration, instant: float) -> float:
        """Base acceleration over g, less that which lifts the block onto a side."""
        return -side * acceleration(instant) / self.block.gravity - tan(self.block.critical_angle_at(side))

    def _rock(self, stop: float, acceleration: Acceleration) -> None:
        """Integrate up to an impact, the catch or the end of the piece."""
        side, critical, square, gravity = self.side, self.geometry.critical_angle, self.p**2, self.block.gravity

        def rate(instant: float, state: Array) -> tuple[float, float]:
            lean = critical * side - state[0]
            return state[1], -square * (sin(lean) + acceleration(instant) / gravity * cos(lean))

        solver = DOP853(
            rate,
            self.now,
            np.array([self.theta, self.omega]),
            stop,
            first_step=min(stop - self.now, 0.02 / self.p),
            max_step=LARGEST_STEP / self.p,
            rtol=RELATIVE_TOLERANCE,
            atol=ABSOLUTE_TOLERANCE,
        )
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise ArithmeticError(f"the integration of the virtual specimen stopped at {solver.t} s: {message}")
            curve = solver.dense_output()
            looks = np.linspace(self.now, solver.t, LOOKS_PER_STEP + 1)
            heights = side * curve(looks)[0]
            crossed = np.flatnonzero((heights[1:] < 0.0) | (heights[1:] >= self.catch))
            if crossed.size:
                low, high = looks[crossed[0] : crossed[0] + 2].tolist()
                if heights[crossed[0] + 1] < 0.0:
                    self._land(curve, low, high, acceleration)
                else:
                    self._fall_into_frame(curve, low, high)
                return
            self.move_to(solver.t, curve)
            self.theta, self.omega = solver.y.tolist()

    def _land(self, curve: Curve, low: float, high: float, acceleration: Acceleration) -> None:
        """Find the impact between two looks, and go on from it."""
        if low == self.now and self.side * self.theta <= 0.0:
            if self.side * self.omega <= 0.0:
                # An uplift that was only rounding: the block stands.
                self.theta, self.omega, self.resting = 0.0, 0.0, True
                self.move_to(high)
                return
            # The whole arc lies between the looks: its impact comes after its turning point.
            low = _root(lambda t: curve(t)[1], low, high)
        instant = _root(lambda t: curve(t)[0], low, high)
        self.move_to(instant, curve)
        velocity = float(curve(instant)[1])
        self.impact_times.append(instant)
        self.impact_velocities.append(velocity)
        self._stand_on(-self.side)
        self.theta, self.omega = 0.0, self.restitution * velocity
        critical = self.geometry.critical_angle
        holding = sin(critical) + self.side * acceleration(instant) / self.block.gravity * cos(critical)
        risen = self.omega**2 / (2 * self.p**2)
        if holding > 0.0 and risen <= REST_ANGLE * critical * holding:
            self.omega, self.resting = 0.0, True

    def _fall_into_frame(self, curve: Curve, low: float, high: float) -> None:
        self.move_to(_root(lambda t: self.side * curve(t)[0] - self.catch, low, high), curve)
        self.theta, self.omega, self.caught = self.side * self.catch, 0.0, True
        self.move_to(float(self.time[-1]))


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    return float(brentq(function, low, high, xtol=1e-15, rtol=1e-15))
