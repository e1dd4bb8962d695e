"""The models against closed forms of the literature and an independent integration."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

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


@given(
    levels=st.lists(st.floats(-3, 3), min_size=2, max_size=40),
    restitution=st.floats(0, 1),
    steps=st.sampled_from([0.003, 0.05, 0.7]),
    released=st.floats(-0.9, 0.9),
)
@example(levels=[-3.0, 1.5], restitution=0.5, steps=0.05, released=0.0)
@example(levels=[3.0, -1.5], restitution=0.5, steps=0.05, released=0.0)
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


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_accumulating_impacts_end_at_rest(model):
    history = rock(PRISM, model=model, restitution=0.8, theta0=0.5 * ALPHA, duration=20.0)
    assert history.angle[-1] == 0.0
    assert 20 < history.impact_times.size < 80


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_block_released_beyond_its_critical_angle_overturns_and_lies_down(model):
    history = rock(PRISM, model=model, theta0=1.01 * ALPHA, duration=5.0)
    assert history.outcome == "overturned"
    assert history.overturning_time == 0.0
    assert history.angle[-1] == pytest.approx(math.pi / 2)


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
        ({"duration": 1.0, "theta0": math.nan}, "theta0 is nan; an angle"),
        ({"duration": 1.0, "model": "linaer"}, 'Did you mean "linear"'),
        ({"motion": Motion([0.0, 0.0], 0.1, transverse=[0.0, 1.0])}, "along x and z only"),
    ],
)
def test_arguments_out_of_range_are_refused_with_what_was_expected(arguments, words):
    with pytest.raises(ValueError, match=words):
        rock(PRISM, **arguments)


def _block(radius, angle, gravity=9.80665):
    """A rectangle of given pole distance (m) and critical angle (rad)."""
    width, height = 2 * radius * math.sin(angle), 2 * radius * math.cos(angle)
    return Block.prism(width=width, depth=width, height=height, mass=1.0, gravity=gravity)


@pytest.mark.parametrize(
    ("radius", "energy"),
    [(0.25, 2.6769386150), (0.5, 1.7110938843), (1.0, 0.9245234031), (2.0, 0.4769203393), (4.0, 0.2418237131)],
)  # Numerics-in-Motion/blocks, A = 2, 1e-8
def test_one_sine_pulse_leaves_its_published_energy(radius, energy):
    block = _block(radius, 0.2)
    time = np.linspace(0, 0.5, 200_001)
    motion = Motion(-2 * block.uplift_acceleration * np.sin(4 * np.pi * time), 0.5 / 200_000)
    history = rock(block, motion, model="nonlinear")
    kinetic = (history.angular_velocity[-1] / block.p) ** 2 / 2
    height = math.cos(0.2 - abs(history.angle[-1])) - math.cos(0.2)
    assert (kinetic + height) / (1 - math.cos(0.2)) == pytest.approx(energy, abs=1e-8)


def test_a_slender_block_at_small_angles_rocks_as_the_linear_one():
    block = _block(1.0, 0.001)
    histories = [
        rock(block, model=model, theta0=0.0005, restitution=0.9, duration=3.0) for model in ("linear", "nonlinear")
    ]
    np.testing.assert_allclose(histories[0].angle, histories[1].angle, atol=2e-7 * 0.001 * 10)
