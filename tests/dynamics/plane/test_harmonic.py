"""The harmonic engines against closed forms, an independent integration and the engines for recorded motions."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import Harmonic, outcomes_of
from colonnade.dynamics.rock import RestitutionLaw, rock
from every import every
from harmonic import harmonic_run
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
LOPSIDED = Block.measured(mass=5.0, pole_distance=(0.24, 0.25), critical_angle=(0.17, 0.22), inertia=(0.39, 0.42))
MODELS = ("linear", "nonlinear")


def level(motion, time):
    """Envelope of a harmonic motion, written once more."""
    rise, flat, end = motion.edges
    return time / rise if time < rise else 1.0 if time <= flat else max(0.0, (end - time) / (end - flat))


def integrated(block, motion, amplitude, restitution, model, impacts):
    """Times and arriving velocities of the first impacts: DOP853, restarted at each; the start by a root search."""
    scale = amplitude * math.tan(block.critical_angle)
    sides = {-1.0: block.negative, 1.0: block.positive}

    def base(time):
        return scale * level(motion, time) * math.sin(motion.omega * time + motion.phase)

    def excess(time):
        side = block.negative if base(time) > 0 else block.positive
        return abs(base(time)) - (side.critical_angle if model == "linear" else math.tan(side.critical_angle))

    steps = np.linspace(0.0, motion.edges[2], 40_001)
    first = next(i for i, time in enumerate(steps) if excess(time) > 0)
    now = 0.0 if first == 0 else brentq(excess, steps[first - 1], steps[first], xtol=1e-15)
    side, state = -math.copysign(1.0, base(now + 1e-9)), [0.0, 0.0]
    found = []
    while len(found) < impacts and now < motion.edges[2]:
        alpha, p = sides[side].critical_angle, block.side_p(sides[side])

        def equation(time, y, alpha=alpha, p=p, s=side):
            if model == "linear":
                return [y[1], p**2 * (y[0] - s * alpha - base(time))]
            return [y[1], -(p**2) * (math.sin(s * alpha - y[0]) + base(time) * math.cos(s * alpha - y[0]))]

        landing = lambda time, y: y[0]  # noqa: E731
        landing.terminal, landing.direction = True, -side
        solution = solve_ivp(
            equation, (now, motion.edges[2]), state, "DOP853", rtol=1e-12, atol=1e-15, events=landing, max_step=0.01
        )
        if solution.status != 1:
            break
        now, arriving = float(solution.t[-1]), float(solution.y[1, -1])
        found.append((now, arriving))
        e = restitution(abs(arriving)) if callable(restitution) else restitution[0 if side < 0 else 1]
        state, side = [0.0, float(e) * arriving], -side
    return np.array(found)


LAW = RestitutionLaw([0.0, 0.3, 0.7, 2.0], [1.0, 0.95, 0.9, 0.8])
"""Kinks lie among the speeds of the cases below."""

CASES = {
    "from rest at phase 0": (PRISM, Harmonic.cycles(5.0 * P, 5), 1.6, (0.976, 0.976)),
    "linear rise and fall": (PRISM, Harmonic.cycles(6.0 * P, 3, ramp=2), 2.2, (0.9, 0.9)),
    "starting at its peak": (PRISM, Harmonic.cycles(7.0 * P, 4, phase=math.pi / 2), 3.0, (0.95, 0.95)),
    "unequal sides and e": (LOPSIDED, Harmonic.cycles(6.0 * LOPSIDED.p, 4, ramp=1), 2.0, (0.9, 0.8)),
    "ramps shorter than a cycle": (PRISM, Harmonic.cycles(6.0 * P, 2, phase=0.6, ramp=0.4), 2.0, (0.9, 0.9)),
    "e over the speed of the impact": (PRISM, Harmonic.cycles(6.0 * P, 4, ramp=1), 2.2, LAW),
    "long sub-harmonic arcs": (PRISM, Harmonic.cycles(7.5 * P, 12), 4.5, (0.976, 0.976)),
}


@every("model", MODELS)
@every(("block", "motion", "amplitude", "restitution"), CASES.values(), ids=CASES)
def test_impacts_agree_with_an_adaptive_integration(block, motion, amplitude, restitution, model):
    expected = integrated(block, motion, amplitude, restitution, model, 8)
    run = harmonic_run(block, motion, amplitude, restitution, model=model)
    count = len(expected)
    assert count >= 3
    np.testing.assert_allclose(run.impact_times[:count], expected[:, 0], atol=2e-10)
    np.testing.assert_allclose(run.impact_velocities[:count], expected[:, 1], atol=1e-9)


@every("model", MODELS)
@every("restitution", [0.0, 0.3, 0.7])
def test_rest_and_uplift_again_agree_with_the_engine_for_recorded_motions(model, restitution):
    motion = Harmonic.cycles(3.0 * P, 6, ramp=1)
    count = 80_001
    interval = motion.edges[2] / (count - 1)
    run = harmonic_run(PRISM, motion, 1.3, (restitution,) * 2, model=model, samples=count, interval=interval)
    time = np.arange(count) * interval
    base = np.array([level(motion, t) for t in time]) * np.sin(motion.omega * time)
    recorded = Motion(1.3 * PRISM.uplift_acceleration * base, interval)
    history = rock(PRISM, recorded, restitution=restitution, model=model)
    assert (np.abs(run.angle) == 0).sum() > 1000
    assert run.outcome == history.outcome
    # The record is the sine's chords: they differ from it by (ω interval)²/8 of A, 1e-8.
    np.testing.assert_allclose(run.angle, history.angle, atol=1e-6 * ALPHA)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("seed", range(3))
def test_no_impact_is_missed_however_short_its_arc(model, seed):
    rng = np.random.default_rng(seed)
    motion = Harmonic.cycles(rng.uniform(1.5, 3.0) * P, 4, phase=rng.uniform(0, 6))
    restitution = (rng.uniform(0.2, 0.6),) * 2
    count = 60_001
    interval = motion.edges[2] / (count - 1)
    run = harmonic_run(PRISM, motion, 1.02, restitution, model=model)
    base = np.sin(motion.omega * np.arange(count) * interval + motion.phase)
    history = rock(PRISM, Motion(1.02 * PRISM.uplift_acceleration * base, interval), restitution=restitution,
                   model=model)  # fmt: skip
    assert run.impact_times.size == history.impact_times.size > 7
    np.testing.assert_allclose(run.impact_times, history.impact_times, atol=1e-5)


@pytest.mark.parametrize(("omega", "amplitude", "restitution"), [(5.0, 2.0, 0.9), (7.0, 2.5, 0.9), (4.0, 3.0, 0.7)])
def test_the_symmetric_steady_response_is_the_closed_form(omega, amplitude, restitution, symmetric_responses):
    expected = symmetric_responses(PRISM, frequency_ratio=omega, amplitude_ratio=amplitude, restitution=restitution)[0]
    run = harmonic_run(PRISM, Harmonic.cycles(omega * P, 400), amplitude, (restitution, restitution))
    np.testing.assert_allclose(np.abs(run.impact_velocities[-20:]), expected.velocity / restitution, rtol=1e-11)
    onto_positive = run.impact_times[-20:][run.impact_velocities[-20:] > 0]
    phases = (omega * P * onto_positive) % (2 * math.pi)
    np.testing.assert_allclose(phases, expected.phase, atol=1e-10)


@pytest.mark.parametrize("model", MODELS)
def test_a_ramp_uplifts_the_block_where_its_envelope_first_reaches_the_threshold(model):
    motion = Harmonic.cycles(4.0 * P, 2, ramp=6)
    count = 120_001
    interval = motion.edges[2] / (count - 1)
    run = harmonic_run(PRISM, motion, 1.8, (0.9, 0.9), model=model, samples=count, interval=interval)
    threshold = (ALPHA / math.tan(ALPHA) if model == "linear" else 1.0) / 1.8
    time = np.arange(count) * interval
    envelope = np.array([level(motion, t) for t in time])
    expected = int(np.argmax(np.abs(envelope * np.sin(motion.omega * time)) > threshold))
    assert abs(int(np.argmax(run.angle != 0)) - expected) <= 1


@pytest.mark.parametrize("model", MODELS)
def test_a_block_left_to_itself_after_the_motion_loses_by_the_law(model):
    motion = Harmonic.cycles(5.0 * P, 2)
    free_loss = RestitutionLaw([0.0, 1e-9], [1.0, 0.0])
    assert harmonic_run(PRISM, motion, 9.0, 1.0, model=model).outcome == "overturned"
    stopped = harmonic_run(PRISM, motion, 2.5, free_loss, model=model)
    assert stopped.outcome == "rocking"
    kept = harmonic_run(PRISM, motion, 2.5, 0.0, model=model)
    np.testing.assert_allclose(stopped.impact_velocities, kept.impact_velocities, rtol=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_overturning_told_early_is_what_a_long_record_shows(model):
    rng = np.random.default_rng(4)
    outcomes = []
    for omega, amplitude in zip(rng.uniform(2, 8, 40), rng.uniform(1.2, 9, 40), strict=True):
        motion = Harmonic.cycles(omega * P, 6)
        run = harmonic_run(PRISM, motion, amplitude, (0.9, 0.9), model=model)
        if run.impact_times.size > 6:
            continue  # so many impacts may part the sine from its chords
        samples = np.sin(omega * P * np.linspace(0, motion.edges[2], 6001))
        recorded = Motion(amplitude * PRISM.uplift_acceleration * samples, motion.edges[2] / 6000)
        outcomes.append((run.outcome, rock(PRISM, recorded, restitution=0.9, model=model).outcome))
    assert len(outcomes) > 10
    assert {own for own, _ in outcomes} == {"rocking", "overturned"}
    assert [own for own, _ in outcomes] == [other for _, other in outcomes]


@pytest.mark.parametrize("model", MODELS)
def test_a_block_past_return_lies_down_in_the_samples(model):
    run = harmonic_run(PRISM, Harmonic.cycles(2.0 * P, 8), 3.0, (0.9, 0.9), model=model, samples=400, interval=0.01)
    assert run.outcome == "overturned"
    assert abs(run.angle[-1]) == math.pi / 2
    assert np.abs(run.angle).max() == math.pi / 2


@pytest.mark.parametrize("model", MODELS)
def test_many_amplitudes_at_once_have_the_outcomes_of_single_runs(model):
    motion = Harmonic.cycles(5.5 * P, 20)
    amplitudes = np.linspace(0.9, 4.0, 40)
    codes = outcomes_of(amplitudes, block=PRISM, forcing=motion.forcing(), restitution=(0.95, 0.95), model=model)
    single = [harmonic_run(PRISM, motion, amplitude, (0.95, 0.95), model=model).outcome for amplitude in amplitudes]
    assert [("no-rocking", "rocking", "overturned")[code] for code in codes] == single
    assert set(codes.tolist()) == {0, 1, 2}


def test_peaks_are_those_of_a_finely_sampled_history():
    motion = Harmonic.cycles(5.0 * P, 10)
    run = harmonic_run(PRISM, motion, 1.5, (0.9, 0.9), samples=100_001, interval=motion.edges[2] / 1e5)
    assert run.peak_ratio == pytest.approx(np.abs(run.angle).max() / ALPHA, rel=1e-8)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"model": "linera"}, 'Unknown plane model "linera"'),
        ({"restitution": (0.9, 1.1)}, "restitution is 1.1"),
    ],
)
def test_impossible_arguments_are_clear_errors(arguments, message):
    given = {"amplitude_ratio": 1.0, "restitution": (0.9, 0.9)} | arguments
    with pytest.raises(ValueError, match=message):
        harmonic_run(PRISM, Harmonic.cycles(10.0, 2), **given)


@pytest.mark.parametrize("model", MODELS)
def test_extreme_motions_and_blocks_end_with_an_outcome(model):
    rng = np.random.default_rng(11)
    for _ in range(300):
        sides = rng.uniform(0.02, 1.2, 2)
        distances = rng.uniform(0.1, 3, 2)
        block = Block.measured(
            mass=1.0, pole_distance=tuple(distances), critical_angle=tuple(sides),
            inertia=tuple(distances**2 * rng.uniform(1, 5, 2)),
        )  # fmt: skip
        omega = 10 ** rng.uniform(-2, 2) * block.p
        cycles, ramp, phase = rng.choice([1, 3, 20]), rng.choice([0.0, 0.3, 2.0]), rng.uniform(0, 7)
        amplitude = 10 ** rng.uniform(-0.1, 3) if rng.random() < 0.5 else rng.uniform(0.98, 1.1)
        restitution = rng.choice([0.0, 0.5, 0.976, 1.0], 2)
        motion = Harmonic.cycles(omega, cycles, phase=phase, ramp=ramp)
        run = harmonic_run(block, motion, amplitude, restitution, model=model)
        assert np.isfinite(run.peak_ratio)
        assert (np.diff(run.impact_times) >= 0).all()
        assert (run.impact_times <= motion.edges[2] * (1 + 1e-12)).all()
        if amplitude * math.tan(block.critical_angle) <= min(sides):
            assert run.outcome == "no-rocking"
