"""
The exact linear engine beside three other ways of solving the same equation on the same random records.

Two double-precision runs of one record part sooner or later, so agreement is asked up to a horizon: where the exact
engine's runs with the motion as it is and times 1 + 1e-13 differ by 1e-10 of α. All share the rule of rest.
"""

from functools import cache

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.march import propagate
from colonnade.dynamics.plane.run import NONE, Forcing
from colonnade.dynamics.plane.sides import sides_of
from independent_rocking import Reference
from prism import PRISM

ALPHA, P, GRAVITY = PRISM.critical_angle, PRISM.p, PRISM.gravity
REST = 1e-6
INTERVAL = 0.02


def _record(seed, duration=40 / P):
    """Base acceleration over gravity: six sines of random frequency, sampled, linear in between."""
    rng = np.random.default_rng(seed)
    time = np.arange(0, duration, INTERVAL)
    parts = [rng.normal() * np.sin(2 * np.pi * rng.uniform(0.8, 6) * time + rng.uniform(0, 6)) for _ in range(6)]
    base = np.sum(parts, axis=0)
    return base * rng.uniform(1.2, 3.0) * ALPHA / np.abs(base).max(), rng.uniform(0.8, 0.99)


def _exact(base, restitution, weights=NONE):
    forcing = Forcing(0.0, np.pi / 2, INTERVAL, NONE, base, weights)
    return propagate(forcing, sides_of(PRISM, (restitution, restitution), REST), is_linearised=True)


def _horizon(base, restitution):
    """Samples up to which one engine agrees with itself, and up to which the block has not passed α."""
    angles = [_exact(base * factor, restitution)[0] for factor in (1.0, 1.0 + 1e-13)]
    parted = (np.abs(angles[0] - angles[1]) > 1e-10 * ALPHA) | (np.abs(angles[0]) > ALPHA)
    return int(np.argmax(parted)) if parted.any() else base.size


@cache
def _integrators():
    """heyoka's of the arc on either side, which end with the landing, and without events."""
    heyoka = pytest.importorskip("heyoka", reason="the extra `bench` is not installed")
    angle, velocity = heyoka.make_vars("angle", "velocity")
    side, base, slope = heyoka.par[0], heyoka.par[1], heyoka.par[2]
    system = [(angle, velocity), (velocity, P**2 * (angle - ALPHA * side - base - slope * heyoka.time))]
    integrators = {0.0: heyoka.taylor_adaptive(system, [0.0, 0.0], pars=[0.0] * 3)}
    for sign, direction in ((1.0, heyoka.event_direction.negative), (-1.0, heyoka.event_direction.positive)):
        landing = heyoka.t_event(angle, direction=direction)
        integrators[sign] = heyoka.taylor_adaptive(system, [0.0, 0.0], pars=[0.0] * 3, t_events=[landing])
    return integrators, heyoka.taylor_outcome(-1)


class _Heyoka(Reference):
    """
    The same by heyoka's Taylor integrator.

    Where θ is exactly 0 at the start of a step it finds no landing in that step (7.13): each arc begins with 1e-5/p
    without events, in which none can land that the rule of rest has let rise.
    """

    def arc(self, t, dt, angle, velocity, sign, pull, lift):
        given = sign, pull(0.0), (pull(dt) - pull(0.0)) / dt
        if angle == 0.0:
            t, angle, velocity, _ = self._run(0.0, t, min(dt, t + 1e-5 / P), (angle, velocity), given)
        return self._run(sign, t, dt, (angle, velocity), given) if t < dt else (t, angle, velocity, False)

    def _run(self, which, t, end, state, pars):
        integrators, landing = _integrators()
        integrator = integrators[which]
        if which:
            integrator.reset_cooldowns()
        integrator.time, integrator.state[:], integrator.pars[:] = t, state, pars
        landed = integrator.propagate_until(end)[0] == landing
        return integrator.time, *integrator.state, landed


def _walked(kind):
    def walk(base, restitution, horizon):
        motion = Motion(base[:horizon] * GRAVITY, INTERVAL)
        return kind(PRISM, motion, lambda *_: restitution, "linear").angles(0.0, 0.0)

    return walk


def _series(base, restitution, horizon):
    return _exact(base, restitution, np.ones_like(base))[0][:horizon]


PEERS = {
    "the Taylor series of the nonlinear engine": _series,
    "SciPy's DOP853": _walked(Reference),
    "heyoka": _walked(_Heyoka),
}


def _largest_difference(peer, seed, duration=40 / P):
    base, restitution = _record(seed, duration)
    horizon = _horizon(base, restitution)
    mine = _exact(base, restitution)[0][:horizon]
    return np.abs(mine - peer(base, restitution, horizon)).max(initial=0.0) / ALPHA, horizon, mine


@pytest.mark.parametrize("name", PEERS)
def test_the_exact_engine_agrees_with(name):
    peer = PEERS[name]
    rocked = 0
    for seed in range(4):
        difference, _, mine = _largest_difference(peer, seed, 10 / P)
        assert difference < 1e-9, seed
        rocked += np.abs(mine).max() > 0.01 * ALPHA
    assert rocked >= 3


@pytest.mark.slow
@pytest.mark.parametrize("name", PEERS)
def test_the_exact_engine_agrees_on_two_hundred_records_with(name, capsys):
    peer = PEERS[name]
    found = [_largest_difference(peer, seed)[:2] for seed in range(200)]
    differences, horizons = (np.array(values) for values in zip(*found, strict=True))
    with capsys.disabled():
        print(
            f"\n{name}: largest difference {differences.max():.1e} α, median {np.median(differences):.1e} α; median "
            f"horizon {np.median(horizons) * INTERVAL * P:.1f}/p, {np.mean(horizons < 40 / P / INTERVAL):.0%} end early"
        )
    assert differences.max() < 1e-9
    assert np.median(horizons) * INTERVAL * P > 10
