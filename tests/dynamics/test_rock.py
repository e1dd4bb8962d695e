"""The models against closed forms of the literature and an independent integration."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from every import every
from prism import PRISM

ALPHA, P, GRAVITY = PRISM.critical_angle, PRISM.p, PRISM.gravity

QUARTER_PERIODS = [  # Housner 1963: p T/4 = acosh(1 / (1 − θ₀/α))
    (0.1, 0.46715), (0.2, 0.69315), (0.3, 0.89559), (0.5, 1.31696),
    (0.7, 1.87382), (0.9, 2.99322), (0.95, 3.68825), (0.99, 5.29829),
]  # fmt: skip


@every(("released", "quarter_period"), QUARTER_PERIODS)
def test_free_rocking_has_housners_quarter_period(released, quarter_period):
    history = rock(PRISM, restitution=0.9, theta0=released * ALPHA, duration=8 / P)
    assert P * history.impact_times[0] == pytest.approx(math.acosh(1 / (1 - released)), rel=1e-9)
    assert P * history.impact_times[0] == pytest.approx(quarter_period, abs=5.1e-6)


def test_free_rocking_follows_the_closed_form_up_to_the_first_impact():
    history = rock(PRISM, restitution=0.9, theta0=0.5 * ALPHA, duration=1.3 / P)
    expected = ALPHA - 0.5 * ALPHA * np.cosh(P * history.time)
    np.testing.assert_allclose(history.angle, expected, rtol=0, atol=1e-9 * ALPHA)


def test_peaks_fall_by_housners_relation():
    history = rock(PRISM, restitution=math.sqrt(0.7), theta0=0.5 * ALPHA, duration=14 / P)
    energy = (history.impact_velocities[:9] / (P * ALPHA)) ** 2
    peaks = 1 - np.sqrt(1 - energy)
    published = [0.5, 0.3108, 0.2047, 0.1382, 0.0945, 0.0651, 0.0451, 0.0314, 0.0219]  # Housner 1963, e² = 0.7
    np.testing.assert_allclose(peaks, published, atol=5.1e-5)
    np.testing.assert_allclose(energy, 0.75 * 0.7 ** np.arange(9), rtol=1e-9)


def _overturns_after_pulse(level, duration):
    """Constant a/(g α) = −level for `duration`, then a base at rest: two runs, so that the jump is exact."""
    motion = Motion(np.full(64, -level * ALPHA * GRAVITY), duration / 63)
    pulse = rock(PRISM, motion, restitution=0.9)
    free = rock(PRISM, restitution=0.9, theta0=pulse.angle[-1], omega0=pulse.angular_velocity[-1], duration=1 / P)
    return free.outcome == "overturned"


@pytest.mark.parametrize("length", [0.5, 1.0, 2.0])
def test_rectangular_pulse_overturns_from_its_closed_form(length):
    limit = 1 / (1 - math.exp(-length))  # a/(g α), linear
    assert not _overturns_after_pulse(limit * (1 - 1e-9), length / P)
    assert _overturns_after_pulse(limit * (1 + 1e-9), length / P)


@pytest.mark.parametrize(("ratio", "limit"), [(1, 1.322397), (2, 1.800724), (3, 2.293872), (4, 2.790798)])
def test_half_sine_pulse_overturns_from_its_closed_form(ratio, limit):
    # Start phase ψ is where the pulse passes the threshold: (ω/p) sin ψ − cos ψ = exp(−(p/ω)(π − ψ)), level 1/sin ψ.
    phase = brentq(lambda psi: ratio * math.sin(psi) - math.cos(psi) - math.exp(-(math.pi - psi) / ratio), 1e-3, 1.57)
    exact = 1 / math.sin(phase)
    assert exact == pytest.approx(limit, abs=5.1e-7)

    def overturns(level):
        time = np.linspace(phase, math.pi, 200_001)
        motion = Motion(-level * ALPHA * GRAVITY * np.sin(time), (math.pi - phase) / (200_000 * ratio * P))
        return rock(PRISM, motion, restitution=0.9).outcome == "overturned"

    # A chord of the sine lies below it by h²/12 of its area: 2e-11 here.
    assert not overturns(exact * (1 - 1e-9))
    assert overturns(exact * (1 + 1e-9))


def _integrated(acceleration, dt, restitution):
    """Integrate the same equation with an adaptive 8th-order method, restarted at every sample, impact and uplift."""
    angle, velocity, side, resting = 0.0, 0.0, 0.0, True
    angles = [0.0]
    for start, end in itertools.pairwise(acceleration):
        elapsed = 0.0
        while elapsed < dt:
            base = lambda t, start=start, end=end: (start + (end - start) * t / dt) / GRAVITY  # noqa: E731
            if resting:
                if max(abs(base(elapsed)), abs(base(dt))) <= ALPHA:
                    elapsed = dt
                    continue
                excess = lambda t, base=base: abs(base(t)) - ALPHA  # noqa: E731
                elapsed = brentq(excess, elapsed, dt, xtol=1e-16) if excess(elapsed) < 0 else elapsed
                side, resting, angle, velocity = -np.sign(base(dt)), False, 0.0, 0.0
            landing = lambda t, y, *_: y[0]  # noqa: E731
            landing.terminal, landing.direction = True, -side
            solution = solve_ivp(
                lambda t, y, s=side, base=base: [y[1], P**2 * (y[0] - ALPHA * s - base(t))],
                (elapsed, dt), [angle, velocity], method="DOP853", rtol=1e-12, atol=1e-15, events=landing,
            )  # fmt: skip
            elapsed, (angle, velocity) = solution.t[-1], solution.y[:, -1]
            if solution.status == 1:
                side, angle, velocity = -side, 0.0, restitution * velocity
                holding = ALPHA + side * base(elapsed)
                if holding >= 0 and velocity**2 / (2 * P**2) <= 1e-6 * ALPHA * holding:
                    resting, velocity = True, 0.0
        angles.append(0.0 if resting else angle)
    return np.array(angles)


@pytest.mark.parametrize("seed", range(6))
def test_random_motion_agrees_with_an_adaptive_integration(seed):
    rng = np.random.default_rng(seed)
    time = np.arange(0, 1.2, 0.01)
    acceleration = sum(
        rng.normal(0, 1) * np.sin(2 * np.pi * rng.uniform(0.8, 6) * time + rng.uniform(0, 6)) for _ in range(6)
    )
    acceleration *= 1.6 * PRISM.uplift_acceleration / np.abs(acceleration).max()
    history = rock(PRISM, Motion(acceleration, 0.01), restitution=0.95)
    expected = _integrated(acceleration, 0.01, 0.95)
    standing = np.abs(expected) < ALPHA
    assert history.peak_time > 0
    assert np.abs(history.angle).max() > 0.01 * ALPHA
    np.testing.assert_allclose(history.angle[standing], expected[standing], rtol=0, atol=2e-9 * ALPHA)


@given(
    levels=st.lists(st.floats(-3, 3), min_size=2, max_size=40),
    restitution=st.floats(0, 1),
    steps=st.sampled_from([0.003, 0.05, 0.7]),
    released=st.floats(-0.9, 0.9),
)
def test_a_coarse_sample_split_in_many_gives_the_same_history(levels, restitution, steps, released):
    # Two crossings and several impacts inside one sample are found: the refined record says the same.
    dt = steps / P
    coarse = Motion(np.array(levels) * PRISM.uplift_acceleration, dt)
    fine_time = np.linspace(0, coarse.duration, 32 * (len(levels) - 1) + 1)
    fine = Motion(np.interp(fine_time, coarse.time, coarse.acceleration), dt / 32)
    histories = [rock(PRISM, motion, restitution=restitution, theta0=released * ALPHA) for motion in (coarse, fine)]
    first, second = histories[0].angle, histories[1].angle[::32]
    up_to = int(np.argmax(np.abs(second) > ALPHA)) or second.size
    tolerance = 1e-7 * np.exp(steps * np.arange(up_to)) * ALPHA
    assert (np.abs(first - second)[:up_to] <= tolerance).all()


def test_a_constant_acceleration_exactly_at_the_threshold_does_not_start_rocking():
    motion = Motion(np.full(100, ALPHA * GRAVITY), 0.01)
    assert rock(PRISM, motion).outcome == "no-rocking"
    above = Motion(np.full(100, ALPHA * GRAVITY * (1 + 1e-9)), 0.01)
    assert np.abs(rock(PRISM, above).angle).max() > 0


def test_base_acceleration_to_plus_x_starts_rocking_with_a_negative_angle():
    history = rock(PRISM, Motion(np.full(10, 2 * ALPHA * GRAVITY), 0.005))
    assert history.angle[-1] < 0


def test_inelastic_impacts_come_to_rest_and_elastic_ones_do_not():
    still = rock(PRISM, restitution=0.0, theta0=0.5 * ALPHA, duration=5.0)
    assert still.impact_times.size == 1
    assert still.angle[-1] == 0.0
    lasting = rock(PRISM, restitution=1.0, theta0=0.5 * ALPHA, duration=50.0)
    assert np.abs(lasting.angle[-5000:]).max() == pytest.approx(0.5 * ALPHA, rel=1e-5)


def test_accumulating_impacts_end_at_rest():
    history = rock(PRISM, restitution=0.8, theta0=0.5 * ALPHA, duration=20.0)
    assert history.angle[-1] == 0.0
    assert 20 < history.impact_times.size < 80


def test_a_block_released_beyond_its_critical_angle_overturns_and_lies_down():
    history = rock(PRISM, theta0=1.01 * ALPHA, duration=5.0)
    assert history.outcome == "overturned"
    assert history.overturning_time == 0.0
    assert history.angle[-1] == pytest.approx(math.pi / 2)


def test_a_block_beyond_its_critical_angle_can_return():
    history = rock(PRISM, theta0=1.1 * ALPHA, omega0=-0.3 * ALPHA * P, duration=10.0, restitution=0.9)
    assert history.outcome == "rocking"
    assert history.peak_ratio == pytest.approx(1.1)


def test_a_record_that_ends_while_the_block_falls_counts_as_overturned():
    history = rock(PRISM, Motion(np.full(3, 0.0), 1e-3), theta0=0.9 * ALPHA, omega0=0.2 * ALPHA * P)
    assert history.outcome == "overturned"


def test_unequal_sides_each_rock_by_their_own_angle():
    block = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.21, 0.15), inertia=41.2)
    assert rock(block, theta0=-0.16, duration=2.0, restitution=0.5).outcome == "rocking"
    assert rock(block, theta0=0.16, duration=2.0, restitution=0.5).outcome == "overturned"
    # What the higher barrier held is too much for the lower one.
    assert rock(block, theta0=-0.20, duration=2.0, restitution=1.0).outcome == "overturned"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"duration": None}, "duration is None"),
        ({"duration": 1.0, "restitution": 1.2}, "between 0 and 1"),
        ({"duration": 1.0, "theta0": math.nan}, "theta0 is nan rad"),
        ({"duration": 1.0, "model": "linaer"}, 'Did you mean "linear"'),
        ({"motion": Motion([0.0, 0.0], 0.1, transverse=[0.0, 1.0])}, "along x and z only"),
    ],
)
def test_arguments_out_of_range_are_refused_with_what_was_expected(arguments, words):
    with pytest.raises(ValueError, match=words):
        rock(PRISM, **arguments)


def test_one_sample_is_a_history_of_one_state():
    history = rock(PRISM, Motion([0.0], 0.01))
    assert history.angle.tolist() == [0.0]
    assert history.outcome == "no-rocking"
