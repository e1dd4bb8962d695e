"""The virtual specimen against closed forms, step by step and whole: uplift, impacts, rest, catch, outcomes."""

import json
from itertools import pairwise
from math import acosh, cos, pi, sin, tan

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.laboratory.runs import with_truth
from colonnade.laboratory.table import TableMotion, ramped_sine
from colonnade.laboratory.truth import REST_ANGLE, Simulation, simulate
from every import every
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
UNEVEN = Block.measured(mass=10.0, pole_distance=(0.3, 0.32), critical_angle=(0.15, 0.2), inertia=(1.2, 1.4))


def still(instant):
    return 0.0


def running(angle, velocity, *, block=PRISM, restitution=0.9, catch=pi / 2, time=(5.0,)):
    return Simulation(block, np.array(time), restitution, catch, (angle, velocity))


@pytest.mark.parametrize(("push", "side"), [(1.0, -1), (-1.0, 1)], ids=["towards +x", "towards -x"])
def test_each_side_lifts_at_g_tan_of_its_own_critical_angle(push, side):
    critical = {-1: 0.15, 1: 0.2}[side]
    instant = UNEVEN.gravity * tan(critical) / 3.0
    before, after = running(0.0, 0.0, block=UNEVEN), running(0.0, 0.0, block=UNEVEN)
    before.go(0.0, instant * (1 - 1e-9), lambda time: 3.0 * push * time)
    assert before.resting
    after.go(0.0, instant + 0.02, lambda time: 3.0 * push * time)
    assert (after.resting, after.side) == (False, side)
    # From uplift on θ̈ = p² cos α · 3 (t − t₀) / g to first order: θ = p² cos α · 3 (t − t₀)³ / 6 g.
    risen = UNEVEN.side_p(after.geometry) ** 2 * cos(critical) * 3.0 * 0.02**3 / (6 * UNEVEN.gravity)
    assert after.theta == pytest.approx(side * risen, rel=2e-3)


def test_an_arc_shorter_than_a_look_has_its_impact():
    risen = 1e-7  # of α: below the rule of rest, which holds after an impact only
    velocity = P * (2 * risen * ALPHA * sin(ALPHA)) ** 0.5
    run = running(0.0, velocity)
    run.go(0.0, 1.0, still)
    # A parabola: up and down with θ̈ = −p² sin α.
    assert run.impact_times == pytest.approx([2 * velocity / (P**2 * sin(ALPHA))], rel=1e-5)
    assert run.impact_velocities == pytest.approx([-velocity], rel=1e-6)
    assert run.resting


SLENDER = Block.measured(mass=1.0, pole_distance=1.0, critical_angle=1e-4, inertia=1.3)


def one_sine(ratio, block, period):
    """One whole sine of amplitude `ratio` g tan α."""

    def wave(piece, time):
        return ratio * block.gravity * tan(block.critical_angle) * sin(2 * pi * time / period)

    return TableMotion(tuple(np.linspace(0.0, period, 9).tolist()), wave, np.zeros_like)


def published(pole_distance):
    """Block and e of Numerics-in-Motion/blocks: α = 0.2, e = 1 − 1.5 sin²α, g = 9.80665."""
    sizes = {"pole_distance": pole_distance, "critical_angle": 0.2, "inertia": 4 / 3 * pole_distance**2}
    return Block.measured(mass=1.0, gravity=9.80665, **sizes), 1 - 1.5 * sin(0.2) ** 2


@pytest.mark.parametrize("amplitude", [0.1, 0.5, 0.9, 0.99])
def test_free_rocking_of_a_slender_block_has_housners_quarter_period(amplitude):
    truth = simulate(SLENDER, [3.0], restitution=0.9, theta0=amplitude * SLENDER.critical_angle)
    # Housner 1963, eq. 3; the nonlinear equation differs from it by parts of α².
    assert truth.impact_times[0] * SLENDER.p == pytest.approx(acosh(1 / (1 - amplitude)), rel=1e-8)


def test_peaks_of_a_slender_block_follow_housner():
    time = np.arange(0.0, 12.0, 5e-4)
    truth = simulate(SLENDER, time, restitution=0.7**0.5, theta0=0.5 * SLENDER.critical_angle)
    edges = np.searchsorted(time, truth.impact_times)[:9]
    peaks = [truth.amplitude[start:stop].max() for start, stop in pairwise(edges)]
    # Housner 1963 with e² = 0.7, φ₀ = 0.5, to the digits given there.
    expected = [0.3108, 0.2047, 0.1382, 0.0945, 0.0651, 0.0451, 0.0314, 0.0219]
    np.testing.assert_allclose(peaks, expected, atol=6e-5)


def test_energy_is_kept_between_impacts_and_each_impact_leaves_e_squared_of_it():
    truth = simulate(PRISM, [20.0], restitution=0.976, theta0=0.6 * ALPHA)
    first = P * (2 * (cos(0.4 * ALPHA) - cos(ALPHA))) ** 0.5
    assert abs(truth.impact_velocities[0]) == pytest.approx(first, rel=1e-11)
    for run, e in ((truth, 0.976), (simulate(UNEVEN, [10.0], restitution=0.9, theta0=-0.1), 0.9)):
        speeds = np.abs(run.impact_velocities)
        np.testing.assert_allclose(speeds[1:] / speeds[:-1], e, rtol=1e-9)


def test_free_rocking_ends_by_the_rest_rule():
    truth = simulate(PRISM, np.arange(0.0, 25.0, 0.002), restitution=0.976, theta0=0.5 * PRISM.critical_angle)
    # The last arc rises above the rule's angle, the next, of e² its height, would not.
    last = truth.impact_velocities[-1] ** 2 / (2 * PRISM.p**2 * sin(PRISM.critical_angle) * PRISM.critical_angle)
    assert REST_ANGLE < last < REST_ANGLE / 0.976**2 * 1.000001
    assert not truth.angle[truth.time > truth.impact_times[-1]].any()


@every(("pole_distance", "limit"), [(0.25, 1.2618896), (0.5, 1.4584424), (1.0, 2.1637842), (2.0, 5.1549268)])
def test_one_sine_overturns_from_the_published_amplitude(pole_distance, limit):
    # T = 0.5 s, ± 4.9e-6.
    block, e = published(pole_distance)
    outcomes = [
        simulate(block, [12.0], one_sine(limit + step, block, 0.5), restitution=e).outcome for step in (-6e-6, 6e-6)
    ]
    assert outcomes[0] != outcomes[1] == "overturned"
    largest, e = published(4.0)  # no amplitude up to six overturns it
    assert (
        simulate(largest, np.linspace(0.0, 12.0, 200), one_sine(6.0, largest, 0.5), restitution=e).outcome == "rocking"
    )


@every(
    ("pole_distance", "energy"),
    [(0.25, 2.6769386150), (0.5, 1.7110938843), (1.0, 0.9245234031), (2.0, 0.4769203393), (4.0, 0.2418237131)],
)
def test_one_sine_leaves_the_published_energy(pole_distance, energy):
    # A = 2, over the energy barrier, to 1e-8.
    block, e = published(pole_distance)
    run = Simulation(block, np.array([0.5]), e, pi / 2, (0.0, 0.0))
    for piece in one_sine(2.0, block, 0.5).pieces(0.0, 0.5):
        run.go(*piece)
    risen = (cos(0.2 - abs(run.theta)) - cos(0.2)) / (1 - cos(0.2))
    assert run.omega**2 / (2 * block.p**2 * (1 - cos(0.2))) + risen == pytest.approx(energy, abs=1e-8)


def test_the_frame_catches_and_holds_an_overturning_block():
    table = ramped_sine(2.0, 1.8 * PRISM.uplift_acceleration, start=0.5, cycles=8, ramp=3)
    truth = simulate(PRISM, np.arange(0.0, 8.0, 0.002), table, restitution=0.976, catch=0.28)
    assert truth.outcome == "overturned"
    assert truth.peak == (None, None)
    caught = np.flatnonzero(np.abs(truth.angle) >= 0.28)
    assert np.all(np.abs(truth.angle[caught[0] :]) == 0.28)


def test_a_held_block_stays_until_its_release():
    time = np.arange(0.0, 3.0, 0.01)
    held = simulate(PRISM, time, restitution=0.976, theta0=0.1, release=1.0)
    free = simulate(PRISM, time, restitution=0.976, theta0=0.1)
    assert np.all(held.angle[time <= 1.0] == 0.1)
    np.testing.assert_allclose(held.angle[101:], free.angle[1:-100], atol=1e-10)


def test_each_number_has_its_truth_next_to_it(tmp_path):
    true = {"outcome": "rocking", "peak_ratio": 0.4, "release_ratio": 0.5}
    truth = {"specimens": {"prism": {"restitution": 0.95}}, "tests": {"free-01": true}}
    found = {"outcome": "overturned", "peak_ratio": None, "release_ratio": 0.49, "predicted": {"linear": {}}}
    summary = {"specimens": {"prism": {"restitution": {"value": 0.951}}}, "tests": {"free-01": found}}
    path = tmp_path / "summary.json"
    path.write_text(json.dumps(summary), encoding="utf-8")
    compared = with_truth(truth, path)
    assert compared["restitution"] == {"prism": {"true": 0.95, "value": 0.951}}
    assert compared["tests"]["free-01"] == found | {f"true_{name}": value for name, value in true.items()}
