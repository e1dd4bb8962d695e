"""Rocking by an adaptive method of eighth order with events: slow, and independent of the package's kernels."""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

REST_ANGLE = 1e-6
"""Of α: after an impact whose next arc would stay below it, the block rests; part of the model, so the same here."""


def overturns(pull, begin, end, *, critical, restitution, nonlinear):
    """
    Tell whether a symmetric block at rest overturns.

    Parameters
    ----------
    pull : callable
        a/g over x = p t, smooth between `begin` and `end`, zero outside.
    critical, restitution : float
        α, rad; e.
    nonlinear : bool
    """
    threshold = math.tan(critical) if nonlinear else critical
    now, theta, rate = begin, 0.0, 0.0
    while now < end:
        if theta == 0.0 and rate == 0.0:
            now, side = _uplift(pull, now, end, threshold)
            if side == 0.0:
                return False
        else:
            side = math.copysign(1.0, theta if theta else rate)

        def slope(x, state, side=side):
            lean = side * critical - state[0]
            if nonlinear:
                return [state[1], -math.sin(lean) - pull(x) * math.cos(lean)]
            return [state[1], -lean - pull(x)]

        def lands(x, state, side=side):
            return side * state[0]

        def lies(x, state, side=side):
            return side * state[0] - 1.5

        lands.terminal, lands.direction, lies.terminal = True, -1, True
        # The first step leaves θ = 0, where the event would be seen at once.
        first = min(1e-3, 0.5 * (end - now))
        run = solve_ivp(slope, (now, now + first), [theta, rate], method="DOP853", rtol=1e-12, atol=1e-16)
        if side * run.y[0, -1] <= 0.0:
            # An arc that is over within the first step: it is put to rest.
            now, theta, rate = now + first, 0.0, 0.0
            continue
        run = solve_ivp(
            slope, (now + first, end), run.y[:, -1], method="DOP853", rtol=1e-12, atol=1e-16, events=(lands, lies)
        )
        if run.t_events[1].size:
            return True
        now, theta, rate = run.t[-1], *run.y[:, -1]
        if run.t_events[0].size:
            theta, rate = 0.0, restitution * rate
            sine, cosine = (math.sin(critical), math.cos(critical)) if nonlinear else (critical, 1.0)
            holding = sine + math.copysign(1.0, rate) * pull(now) * cosine
            if holding >= 0.0 and 0.5 * rate**2 <= REST_ANGLE * critical * holding:
                rate = 0.0
    return not _stands(theta, rate, critical, restitution, nonlinear)


def _uplift(pull, now, end, threshold):
    """When, from `now` on, the block uplifts, and to which side."""
    points = np.linspace(now, end, 20001)
    over = np.abs([pull(x) for x in points]) > threshold
    if not over.any():
        return end, 0.0
    index = int(np.argmax(over))
    side = -math.copysign(1.0, pull(points[index]))
    if index == 0:
        return now, side
    return brentq(lambda x: abs(pull(x)) - threshold, points[index - 1], points[index], xtol=1e-15), side


def _stands(theta, rate, critical, restitution, nonlinear):
    """Whether the block, left to itself, comes back: by its energy on this side and after one impact."""
    height, climb = abs(theta), rate * (math.copysign(1.0, theta) if theta else 1.0)

    def hill(angle):
        return math.cos(critical - angle) - 1 if nonlinear else -0.5 * (critical - angle) ** 2

    energy = 0.5 * climb**2 + hill(height)
    if (height > critical and climb > 0.0) or (height <= critical and climb > 0.0 and energy > 0.0):
        return False
    if height > critical and energy <= 0.0:
        return False
    arriving = 2 * (energy - hill(0.0))
    return 0.5 * restitution**2 * arriving + hill(0.0) <= 0.0
