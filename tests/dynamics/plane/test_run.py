"""A run in the plane, and the outcome that it ends in."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import LARGEST_ACCELERATION, LONGEST_SAMPLE, OUTCOMES, ends_of
from colonnade.dynamics.plane.sides import sides_of
from colonnade.dynamics.rock import rock
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
FREE = {"theta0": 0.5 * ALPHA, "duration": 2.0}


def test_each_side_has_its_own_e():
    history = rock(PRISM, **FREE, restitution=(0.95, 0.85))
    expected = np.where(history.impact_velocities > 0, 0.95, 0.85)
    np.testing.assert_allclose(history.rebound_velocities / history.impact_velocities, expected)
    assert {0.95, 0.85} == set(expected)


def test_without_e_it_is_that_of_a_rigid_body():
    history = rock(PRISM, **FREE)
    assert history.rebound_velocities[0] / history.impact_velocities[0] == pytest.approx(PRISM.restitution)


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        (
            Motion([0.0, 1.1 * LARGEST_ACCELERATION * 9.81], 0.01),
            r"at sample 1, .* at most 1e\+06 g .* Check their units",
        ),
        (Motion([0.0, 1.0], 1.01 * LONGEST_SAMPLE / P), "and 300/p .* were expected"),
        (Motion([0.0, 1.0], 0.01, transverse=[0.0, 1.0]), "a Motion without `transverse`"),
        (Motion([0.0, 1.0], 0.01, vertical=[0.0, -9.9]), "the base falls faster than the block"),
    ],
    ids=["acceleration", "interval", "transverse", "vertical"],
)
def test_what_the_plane_does_not_have_is_refused(motion, message):
    with pytest.raises(ValueError, match=message):
        rock(PRISM, motion)


LEANING = replace(PRISM, positive=replace(PRISM.positive, critical_angle=1.3 * PRISM.critical_angle))
TIME = np.arange(0.0, 4.0, 0.005)
SHAKEN = np.sin(2 * np.pi * 2.0 * TIME) * np.sin(np.pi * TIME / 4.0) * PRISM.gravity
LIFTED = 0.4 * np.cos(2 * np.pi * 5.0 * TIME) * PRISM.gravity


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("vertical", [None, LIFTED, 0.0 * LIFTED], ids=["level", "lifted", "lifted by nothing"])
def test_ends_are_those_of_the_histories(model, vertical):
    blocks = [(PRISM, (0.95, 0.95)), (LEANING, (0.9, 0.96)), (PRISM, (0.8, 0.8))]
    drawn, seen = [sides_of(*each) for each in blocks], set()
    for level in (0.1, 0.15, 0.22, 0.3, 0.6, 1.2):
        motion = Motion(level * SHAKEN, 0.005, vertical)
        codes, peaks = ends_of(motion, drawn, gravity=PRISM.gravity, model=model)
        for number, (block, e) in enumerate(blocks):
            history = rock(block, motion, restitution=e, model=model)
            assert OUTCOMES[codes[number]] == history.outcome
            expected = np.nan if history.peak_ratio is None else history.peak_ratio
            np.testing.assert_array_equal(peaks[number], expected)
            seen.add(history.outcome)
    assert seen == set(OUTCOMES)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("critical", [0.14917578366258932, 0.19, 0.25])
def test_a_motion_that_only_touches_the_threshold_makes_no_block_hop_without_end(model, critical):
    block = Block.measured(mass=100.0, pole_distance=0.3, critical_angle=critical, inertia=12.0)
    wave = np.sin(np.linspace(0.0, np.pi, 81))
    touching = block.gravity * (np.tan(critical) if model == "nonlinear" else critical)
    for steps in range(-6, 7):
        motion = Motion(touching * (1.0 + steps * np.finfo(float).eps) * wave, 0.005)
        history = rock(block, motion, restitution=0.97, model=model)
        assert (history.impacts <= 2, history.outcome) == (True, "no-rocking"), steps
