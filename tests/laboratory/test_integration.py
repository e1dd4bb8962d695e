"""The virtual specimen step by step: uplift, impacts, rest, catch and overturning against closed forms."""

from __future__ import annotations

from itertools import pairwise
from math import cos, isnan, pi, sin, tan

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.laboratory.truth import REST_ANGLE, Integration
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
UNEVEN = Block.measured(mass=10.0, pole_distance=(0.3, 0.32), critical_angle=(0.15, 0.2), inertia=(1.2, 1.4))


def still(instant: float) -> float:
    return 0.0


def running(
    angle: float,
    velocity: float,
    *,
    block: Block = PRISM,
    restitution: float = 0.9,
    catch: float = pi / 2,
    time: np.ndarray | None = None,
) -> Integration:
    run = Integration(block, np.array([5.0]) if time is None else time, restitution, catch, angle)
    run.release(angle, velocity)
    return run


@pytest.mark.parametrize(
    ("angle", "velocity", "side", "resting"),
    [(0.1, 0.0, 1, False), (-0.1, 2.0, -1, False), (0.0, 0.3, 1, False), (0.0, -0.3, -1, False), (0.0, 0.0, 1, True)],
    ids=["held to the right", "held to the left", "pushed to the right", "pushed to the left", "upright"],
)
def test_a_released_block_turns_about_the_edge_of_its_side(
    angle: float, velocity: float, side: int, resting: bool
) -> None:
    run = running(angle, velocity, block=UNEVEN)
    assert (run.side, run.resting) == (side, resting)
    assert run.geometry.critical_angle == {-1: 0.15, 1: 0.2}[side]
    assert run.p == UNEVEN.side_p(UNEVEN.positive if side > 0 else UNEVEN.negative)


def test_time_passes_for_a_held_block_with_its_angle() -> None:
    time = np.array([0.0, 0.5, 1.0, 1.5])
    run = Integration(PRISM, time, 0.9, pi / 2, 0.1)
    run.angle = 0.05
    run.move_to(1.0)
    assert run.angles.tolist() == [0.05, 0.05, 0.05, 0.1]
    assert (run.filled, run.now) == (3, 1.0)


@pytest.mark.parametrize(("push", "side"), [(1.0, -1), (-1.0, 1)], ids=["towards +x", "towards -x"])
def test_each_side_lifts_at_g_tan_of_its_own_critical_angle(push: float, side: int) -> None:
    critical = {-1: 0.15, 1: 0.2}[side]
    instant = UNEVEN.gravity * tan(critical) / 3.0

    def ramp(time: float) -> float:
        return 3.0 * push * time

    before, after = running(0.0, 0.0, block=UNEVEN), running(0.0, 0.0, block=UNEVEN)
    before.go(0.0, instant * (1 - 1e-9), ramp)
    assert before.resting
    after.go(0.0, instant + 0.02, ramp)
    assert (after.resting, after.side) == (False, side)
    # From uplift on θ̈ = p² cos α · 3 (t − t₀) / g to first order: θ = p² cos α · 3 (t − t₀)³ / 6 g.
    risen = UNEVEN.side_p(after.geometry) ** 2 * cos(critical) * 3.0 * 0.02**3 / (6 * UNEVEN.gravity)
    assert after.angle == pytest.approx(side * risen, rel=2e-3)


@pytest.mark.parametrize("pushed", [-0.8, 0.0, 0.1], ids=["towards the pole", "not at all", "away from it"])
def test_energy_and_work_of_a_constant_push_are_kept_in_an_arc(pushed: float) -> None:
    run = running(0.02, 0.7)

    def constant(instant: float) -> float:
        return pushed

    def energy() -> float:
        lean = ALPHA - run.angle
        return run.velocity**2 / 2 + P**2 * (cos(lean) - pushed / PRISM.gravity * sin(lean))

    first = energy()
    for stop in (0.05, 0.1):
        run.go(run.now, stop, constant)
        assert not run.impact_times
        assert energy() == pytest.approx(first, rel=1e-10)


def test_angles_between_steps_are_those_of_shorter_pieces() -> None:
    time = np.linspace(0.0, 2.0, 41)
    whole, parts = (running(0.6 * ALPHA, 0.0, time=time) for _ in range(2))
    whole.go(0.0, 2.0, still)
    for start, stop in pairwise(time.tolist()):
        parts.go(start, stop, still)
    assert len(whole.impact_times) >= 3
    np.testing.assert_allclose(parts.impact_times, whole.impact_times, atol=1e-9)
    np.testing.assert_allclose(parts.angles, whole.angles, atol=1e-9)


def test_a_mirrored_push_gives_a_mirrored_history() -> None:
    time = np.linspace(0.0, 2.0, 101)
    runs = []
    for sign in (1.0, -1.0):
        run = running(sign * 0.3 * ALPHA, 0.0, time=time)
        run.go(0.0, 2.0, lambda instant, sign=sign: sign * 1.2 * sin(8 * instant))
        runs.append(run)
    assert runs[0].impact_times
    np.testing.assert_allclose(runs[1].angles, -runs[0].angles, atol=1e-12)
    np.testing.assert_allclose(runs[1].impact_velocities, -np.array(runs[0].impact_velocities), atol=1e-12)


def test_an_arc_shorter_than_a_look_has_its_impact() -> None:
    risen = 1e-7  # of α: below the rule of rest, which holds after an impact only
    velocity = P * (2 * risen * ALPHA * sin(ALPHA)) ** 0.5
    run = running(0.0, velocity)
    run.go(0.0, 1.0, still)
    # A parabola: up and down with θ̈ = −p² sin α.
    assert run.impact_times == pytest.approx([2 * velocity / (P**2 * sin(ALPHA))], rel=1e-5)
    assert run.impact_velocities == pytest.approx([-velocity], rel=1e-6)
    assert run.resting


@pytest.mark.parametrize(("factor", "rests"), [(0.999, True), (1.001, False)], ids=["below the rule", "above it"])
def test_a_block_rests_where_the_next_arc_would_be_too_low(factor: float, rests: bool) -> None:
    rebound = factor * P * (2 * REST_ANGLE * ALPHA * sin(ALPHA)) ** 0.5
    run = running(0.0, rebound / 0.5, restitution=0.5)
    duration = 2 * run.velocity / (P**2 * sin(ALPHA))
    run.go(0.0, 1.01 * duration, still)
    assert len(run.impact_times) == 1
    assert run.resting is rests


def test_an_impact_without_restitution_ends_the_motion() -> None:
    run = running(0.5 * ALPHA, 0.0, restitution=0.0, time=np.linspace(0.0, 3.0, 31))
    run.go(0.0, 3.0, still)
    assert len(run.impact_times) == 1
    assert run.resting
    assert not run.angles[run.time > run.impact_times[0]].any()


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_frame_holds_what_falls_into_it_to_the_end(side: float) -> None:
    time = np.linspace(0.0, 5.0, 501)
    run = running(side * 1.01 * ALPHA, 0.0, catch=1.5 * ALPHA, time=time)
    run.go(0.0, 5.0, still)
    assert run.caught
    assert run.angle == run.angles[-1] == side * 1.5 * ALPHA
    assert np.abs(run.angles).max() == 1.5 * ALPHA
    assert np.all(np.diff(np.abs(run.angles)) >= 0)
    assert run.passed == 0.0  # it was past α when it was released
    assert (run.filled, run.now) == (501, 5.0)


def test_the_last_outward_pass_of_the_critical_angle_is_kept_and_a_return_forgets_it() -> None:
    outward = running(0.9 * ALPHA, 0.5)
    outward.go(0.0, 0.3, still)
    assert abs(outward.angle) > ALPHA
    there = running(0.9 * ALPHA, 0.5)
    there.go(0.0, outward.passed, still)
    assert there.angle == pytest.approx(ALPHA, rel=1e-9)
    inward = running(1.05 * ALPHA, -0.5)
    assert inward.passed == 0.0
    inward.go(0.0, 0.1, still)
    assert abs(inward.angle) < ALPHA
    assert isnan(inward.passed)


@pytest.mark.parametrize("factor", [0.999, 1.001], ids=["below the barrier", "above the barrier"])
@pytest.mark.parametrize("way", [-1.0, 1.0], ids=["by way of an impact", "outwards"])
def test_what_would_become_of_a_block_is_what_becomes_of_it(way: float, factor: float) -> None:
    angle, restitution = 0.4 * ALPHA, 0.9
    barrier = 2 * (1 - cos(ALPHA))
    held = 2 * (cos(ALPHA - angle) - cos(ALPHA))
    # Outwards the rest of the barrier is needed; inwards the whole of the other side's, after a loss of 1 − e².
    needed = barrier - held if way > 0 else barrier / restitution**2 - held
    velocity = way * P * (factor * needed) ** 0.5
    run = running(angle, velocity, restitution=restitution)
    stands = run.stands_when_left_alone()
    assert stands is (factor < 1)
    run.go(0.0, 5.0, still)
    assert isnan(run.passed) is stands


def test_a_resting_block_stands() -> None:
    assert running(0.0, 0.0).stands_when_left_alone()
