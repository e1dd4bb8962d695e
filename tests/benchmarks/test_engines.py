"""
Speed of the engines as a ratio to SciPy's DOP853 in the same run, one thread, compilation excluded.

Marked slow; `python -m pytest -m slow tests/benchmarks -s` prints the figures.
"""

import time

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
ALPHA, P = PRISM.critical_angle, PRISM.p
INTERVAL = 0.002
TIME = np.arange(0, 20 / 4, INTERVAL)
BASE = 1.5 * PRISM.gravity * ALPHA * np.sin(2 * np.pi * 4 * TIME)
"""Twenty cycles of 4 Hz, during which the prism rocks throughout."""


def _scipy(restitution):
    """Same equation and record with events, restarted at each impact; the integrator sees the record's chords."""
    start, state, side, impacts = 0.0, [0.0, 0.0], 0.0, 0
    begin = int(np.argmax(np.abs(BASE) > PRISM.gravity * ALPHA))
    start, side = float(TIME[begin]), -float(np.sign(BASE[begin]))
    while start < TIME[-1]:
        landing = lambda t, y: y[0]  # noqa: E731
        landing.terminal, landing.direction = True, -side
        solution = solve_ivp(
            lambda t, y, s=side: [y[1], P**2 * (y[0] - ALPHA * s - np.interp(t, TIME, BASE) / PRISM.gravity)],
            (start, TIME[-1]), state, method="DOP853", rtol=1e-9, atol=1e-12, max_step=0.02, events=landing,
        )  # fmt: skip
        if solution.status != 1:
            break
        start, side, state = solution.t[-1], -side, [0.0, restitution * solution.y[1, -1]]
        impacts += 1
    return impacts


def _seconds(function, times):
    function()
    best = np.inf
    for _ in range(times):
        begin = time.perf_counter()
        function()
        best = min(best, time.perf_counter() - begin)
    return best


@pytest.mark.slow
def test_engines_beside_dop853(capsys):
    motion = Motion(BASE, INTERVAL)
    histories = {model: rock(PRISM, motion, restitution=0.976, model=model) for model in ("linear", "nonlinear")}
    peer = _seconds(lambda: _scipy(0.976), 2)
    with capsys.disabled():
        print(f"\nDOP853, linear equation: {peer:.3f} s, {_scipy(0.976)} impacts")
        for model, history in histories.items():
            own = _seconds(lambda model=model: rock(PRISM, motion, restitution=0.976, model=model), 50)
            print(f"{model}: {1e6 * own:.0f} µs, {history.impact_times.size} impacts, {peer / own:.0f} times DOP853")
            assert history.outcome == "rocking"
            assert peer / own > 20
