"""The plan of a map: what is asked for, checked, and the A that every column runs."""

from math import tan

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import MapPlan
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.dynamics.search import LEAST_EDGE, MOST_STEPS, STEPS_A_WIDTH
from prism import PRISM

LOPSIDED = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.21, 0.15), inertia=41.2)


def plan(block=PRISM, **given):
    return MapPlan(block, **({"frequency_ratio": [2.0], "amplitude_ratio": [1.0, 1.5, 4.0], "width": 0.1} | given))


def test_the_scan_holds_the_amplitudes_of_the_map_and_steps_over_no_limit():
    scan = plan().scan
    assert np.isin([1.0, 1.5, 4.0], scan).all()
    assert (np.diff(scan) > 0).all()
    assert np.diff(scan).max() <= 0.1 / STEPS_A_WIDTH * (1 + 1e-9)
    assert scan.size == 1 + 3.0 / 0.1 * STEPS_A_WIDTH


def test_amplitudes_closer_than_a_step_are_scanned_as_they_are():
    np.testing.assert_array_equal(plan(amplitude_ratio=[1.0, 1.001, 1.002]).scan, [1.0, 1.001, 1.002])


def test_a_block_uplifts_at_alpha_by_the_linear_equation_and_at_its_tangent_by_the_full_one():
    alpha = PRISM.critical_angle
    assert plan().onset == pytest.approx(alpha / tan(alpha), rel=1e-15)
    assert plan(model="nonlinear").onset == 1.0


def test_the_side_that_uplifts_first_counts():
    assert plan(LOPSIDED, model="nonlinear").onset == pytest.approx(tan(0.15) / tan(LOPSIDED.critical_angle))


def test_a_recorded_motion_uplifts_by_its_larger_side_only_where_it_pulls_that_way():
    """All of it towards +x: only the side θ < 0, of 0.21, can uplift."""
    pushes = Motion(np.array([0.0, 2.0, 0.0]), 0.01)
    found = plan(LOPSIDED, model="nonlinear", motion=pushes, motion_frequency=3.0)
    assert found.onset == pytest.approx(tan(0.21) / tan(LOPSIDED.critical_angle))
    both = Motion(np.array([0.0, 2.0, -1.0]), 0.01)
    found = plan(LOPSIDED, model="nonlinear", motion=both, motion_frequency=3.0)
    assert found.onset == pytest.approx(min(tan(0.21), 2 * tan(0.15)) / tan(LOPSIDED.critical_angle))


def test_its_options_say_all_that_a_map_depends_on():
    found = plan(restitution=(0.9, 0.8), phase=7.0, cycles=5).options
    assert found["phase"] == pytest.approx(7.0 - 2 * np.pi)
    assert (found["restitution_negative"], found["restitution_positive"], found["cycles"]) == (0.9, 0.8, 5.0)
    assert "motion_frequency" not in found
    law = plan(restitution=RestitutionLaw.table([0.0, 9.0], [1.0, 0.7])).options
    assert law["restitution_values"] == [1.0, 0.7]
    motion = Motion(np.array([0.0, 1.0, 0.0]), 0.01)
    assert plan(motion=motion, motion_frequency=3.0).options["motion_samples"] == 3


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"frequency_ratio": [1e7]}, "1e-06 to 1e\\+06 was expected"),
        ({"amplitude_ratio": [1.0, 1e5], "width": 0.1}, "width is 0.1; a width in A, at least 0.4"),
        ({"edge": LEAST_EDGE / 2}, "edge is 5e-10"),
        ({"frequency_ratio": np.linspace(1, 2, 2000), "amplitude_ratio": np.linspace(1, 2, 501)}, "1002000 cells"),
    ],
)
def test_what_would_not_end_is_refused(given, message):
    assert MOST_STEPS == 1_000_000
    with pytest.raises(ValueError, match=message):
        plan(**given)
