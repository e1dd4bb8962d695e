"""
Speed of the harmonic engines beside heyoka's Taylor integrator in the same run, one thread, processor time.

Blocks that rock throughout: 30 cycles, at least 50 impacts, none overturns. heyoka's state is reset at each impact by a
Python callback, which takes about half of its time and is the only way its Python package offers; it starts a little
after uplift from our state, since its events cannot begin on a crossing. Errors are those of the last state against
heyoka at its finest tolerance. Compilation is excluded.

Marked slow; `python -m pytest -m slow tests/benchmarks/test_harmonic_speed.py -s` prints the figures. heyoka is
installed by the extra `bench`.
"""

import math

import numpy as np
import pytest

from colonnade.dynamics.plane.run import Harmonic, outcomes_of
from harmonic import harmonic_run
from peers import integrator, least_seconds
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
CYCLES, RESTITUTION = 30, 0.976
FREQUENCIES = np.linspace(4.5, 7.8, 6)


class Peer:
    """heyoka on the same equation: x = p t, angle over α."""

    def __init__(self, model, tolerance):
        self.integrator = integrator(
            lambda heyoka: heyoka.par[1] * heyoka.sin(heyoka.par[2] * heyoka.time),
            is_linearised=model == "linear",
            restitution=RESTITUTION,
            tolerance=tolerance,
        )

    def run(self, ratio, amplitude, start, state):
        integrator = self.integrator
        integrator.time = start
        integrator.state[:] = state
        integrator.pars[:] = [math.copysign(1.0, state[0]), amplitude * math.tan(ALPHA), ratio]
        integrator.reset_cooldowns()
        outcome = integrator.propagate_until(2 * math.pi * CYCLES / ratio, max_steps=100_000)[0]
        assert "time_limit" in str(outcome)
        return integrator.state.copy()


def rocking_cases(model):
    """Pairs of Ω and A that rock throughout, and heyoka's start for each: x and state, half a radian after uplift."""
    rng, cases = np.random.default_rng(7), []
    for ratio in FREQUENCIES:
        motion = Harmonic.cycles(ratio * P, CYCLES)
        for amplitude in np.sort(rng.uniform(1.1, 1.8, 40)):
            run = harmonic_run(PRISM, motion, amplitude, (RESTITUTION,) * 2, model=model)
            if run.outcome == "rocking" and run.impact_times.size >= 50:
                start = (math.pi / 2 + 0.5) / ratio
                early = harmonic_run(
                    PRISM, motion, amplitude, (RESTITUTION,) * 2, model=model, samples=2, interval=start / P
                )
                state = [early.angle[1] / ALPHA, early.angular_velocity[1] / (ALPHA * P)]
                cases.append((ratio, amplitude, start, state))
    return cases


def last_state(model, ratio, amplitude):
    end = 2 * math.pi * CYCLES / (ratio * P)
    motion = Harmonic(ratio * P, 0.0, (0.0, 1.001 * end, 1.001 * end))
    run = harmonic_run(PRISM, motion, amplitude, (RESTITUTION,) * 2, model=model, samples=2, interval=end)
    return np.array([run.angle[1] / ALPHA, run.angular_velocity[1] / (ALPHA * P)])


@pytest.mark.slow
@pytest.mark.parametrize(("model", "least"), [("linear", 13.0), ("nonlinear", 3.0)])
def test_trajectories_a_second_beside_heyoka(capsys, model, least):
    cases = rocking_cases(model)
    amplitudes = {ratio: np.array([case[1] for case in cases if case[0] == ratio]) for ratio in FREQUENCIES}
    peer, reference = Peer(model, 1e-10), Peer(model, 1e-17)
    expected = np.array([reference.run(*case) for case in cases])
    errors = {
        "heyoka": np.abs(np.array([peer.run(*case) for case in cases]) - expected).max(axis=1),
        "own": np.abs(np.array([last_state(model, *case[:2]) for case in cases]) - expected).max(axis=1),
    }

    def own():
        for ratio, levels in amplitudes.items():
            outcomes_of(
                levels,
                block=PRISM,
                forcing=Harmonic.cycles(ratio * P, CYCLES).forcing(),
                restitution=(RESTITUTION,) * 2,
                model=model,
            )

    seconds, theirs = least_seconds(own, lambda: [peer.run(*case) for case in cases], rounds=20)
    impacts = sum(harmonic_run(PRISM, Harmonic.cycles(ratio * P, CYCLES), level, (RESTITUTION,) * 2, model=model)
                  .impact_times.size for ratio, level, *_ in cases)  # fmt: skip
    with capsys.disabled():
        print(f"\n{model}: {len(cases)} trajectories, {impacts / len(cases):.0f} impacts each")
        print(f"  heyoka {len(cases) / theirs:.0f}/s, own {len(cases) / seconds:.0f}/s: {theirs / seconds:.1f} times")
        for name, error in errors.items():
            print(f"  error of the last state, {name}: median {np.median(error):.1e}, largest {error.max():.1e} α")
    assert len(cases) >= 50
    assert np.median(errors["own"]) <= max(np.median(errors["heyoka"]), 1e-12)
    assert theirs / seconds > least
