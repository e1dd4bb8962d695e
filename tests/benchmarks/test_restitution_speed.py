"""
Speed of the identification of e, as a ratio to one whole-history fit with lmfit and solve_ivp in the same run:
processor time of one thread, compilation excluded.

Marked slow; `python -m pytest -m slow tests/benchmarks/test_restitution_speed.py -s` prints the figures.
"""

import time

import lmfit
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from threadpoolctl import threadpool_limits

from colonnade.identification.restitution.identify import identify_restitution
from colonnade.laboratory.truth import simulate
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
RATE, DURATION = 1000.0, 20.0
RECORDS = 1000
TIMES_FASTER = 200
NOISE = 1e-3 * ALPHA

REST = 1e-3
"""Of p α: velocity after an impact below which the block stands, as the next arc would rise to 5e-7 α."""

pytestmark = pytest.mark.slow


def _record(time_, truth, seed):
    return truth + np.random.default_rng(seed).normal(0.0, NOISE, time_.size)


def _landing(_, state):
    return state[0]


_landing.terminal = True


def _history(moments, restitution, release, begin, offset):
    """Angle at the samples from scipy's solve_ivp, restarted at every impact; held until `begin`."""
    angles = np.full(moments.size, release)
    now, state, side = begin, [release, 0.0], np.sign(release)
    while now < moments[-1]:
        _landing.direction = -side
        solution = solve_ivp(
            lambda _, y, side=side: [y[1], -(P**2) * np.sin(ALPHA * side - y[0])],
            (now, moments[-1] + 1e-9),
            state,
            method="DOP853",
            rtol=1e-8,
            atol=1e-10,
            events=_landing,
            dense_output=True,
        )
        inside = (moments >= now) & (moments <= solution.t[-1])
        if inside.any():
            angles[inside] = solution.sol(moments[inside])[0]
        now, state, side = solution.t[-1], [0.0, restitution * solution.y[1, -1]], -side
        if abs(state[1]) < REST * P * ALPHA:
            angles[moments > now] = 0.0
            break
    return angles + offset


def _peer(moments, angles):
    """Fit e, release angle and time and zero offset with lmfit, from values near by; with standard errors."""
    parameters = lmfit.Parameters()
    parameters.add("restitution", value=0.975, min=0.5, max=0.9999)
    parameters.add("release", value=0.598 * ALPHA, min=0.1 * ALPHA, max=0.99 * ALPHA)
    parameters.add("begin", value=1e-3, min=-0.1, max=0.2)
    parameters.add("offset", value=0.0)

    def residual(values):
        return (
            _history(moments, *(values[name].value for name in ("restitution", "release", "begin", "offset"))) - angles
        )

    return lmfit.minimize(residual, parameters, method="leastsq", xtol=1e-8, ftol=1e-8, epsfcn=1e-8)


@pytest.fixture(autouse=True)
def _one_thread():
    """Threads of the linear algebra that wait for each other would count as processor time."""
    with threadpool_limits(1):
        yield


def test_a_thousand_free_decays_beside_one_fit_of_lmfit():
    moments = np.arange(0.0, DURATION, 1 / RATE)
    truth = simulate(PRISM, moments, restitution=0.976, theta0=0.6 * ALPHA).angle
    identify_restitution(moments, _record(moments, truth, RECORDS), PRISM)

    records = [_record(moments, truth, seed) for seed in range(RECORDS)]
    begin = time.process_time()
    found = [identify_restitution(moments, record, PRISM) for record in records]
    ours = (time.process_time() - begin) / RECORDS

    begin = time.process_time()
    fit = _peer(moments, records[0])
    peers = time.process_time() - begin

    assert fit.params["restitution"].value == pytest.approx(0.976, abs=5 * fit.params["restitution"].stderr)
    held = np.mean([each.low <= 0.976 <= each.high for each in found])
    print(
        f"\n{RECORDS} free decays of {DURATION:g} s at {RATE:g} Hz with intervals: {1e3 * ours:.1f} ms a record; "
        f"one fit of lmfit with solve_ivp ({fit.nfev} histories): {peers:.1f} s; ratio {peers / ours:.0f}; "
        f"intervals that hold e: {held:.3f}"
    )
    assert held > 0.9
    assert peers / ours >= TIMES_FASTER
