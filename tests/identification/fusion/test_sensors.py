"""Sensors: derivatives of their readings, what a set-up separates, and their noise."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion.sensors import (
    UNKNOWNS,
    Readings,
    Transducer,
    UnseenRotationError,
    predict,
    separate,
)
from colonnade.signals.filters import lowpass
from every import every
from prism import PRISM

HALF_WIDTH = 0.0485
BLOCK = Block.cylinder(diameter=2 * HALF_WIDTH, height=0.455, mass=26.3)
CONE = Outline(HALF_WIDTH, HALF_WIDTH, is_round=True, taper=-0.02)
RADIUS = HALF_WIDTH - 0.02 * 0.4
ON_SIDE = (0.8 * RADIUS, 0.6 * RADIUS, 0.4)
TRANSDUCERS = {
    "point": Transducer("point", (0.6, 0.0, 0.8), (HALF_WIDTH, 0.0, 0.4)),
    "face": Transducer("surface", (1.0, 0.0, 0.0), (HALF_WIDTH, 0.02, 0.4), normal=(1.0, 0.0, 0.0)),
    "round side": Transducer("surface", (1.0, 0.0, 0.0), ON_SIDE),
    "wire": Transducer("wire", (1.0, 0.0, 0.0), (HALF_WIDTH, 0.0, 0.4), anchor=(-0.5, 0.1, 0.45)),
    "angle": Transducer("angle", (0.36, 0.48, 0.8)),
    "on the ground": Transducer("wire", (0.0, 1.0, 0.0), (0.0, 0.0, 0.4), anchor=(0.0, 0.5, 0.4), on_ground=True),
}
POSES = {
    "at rest": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "nearly at rest": (1e-6, 0.0, 1e-7, 0.0, 0.0, 0.0),
    "far from it": (0.3, 0.005, 0.02, 0.001, 0.03, 0.002),
    "beyond the critical angle": (0.5, -0.01, -0.02, 0.002, 0.05, 0.01),
}


def _predicted(transducer, unknowns, side):
    angle, slide, lean, across, yaw, rise = (np.array([each]) for each in unknowns)
    pose = Pose(angle, slide, rise, lean, across, yaw)
    readings, columns = predict([transducer], pose, side, BLOCK, CONE, np.array([[0.01], [0.02], [0.0]]))
    return readings[0, 0], columns[0, :, 0]


@pytest.mark.parametrize("side", [1.0, -1.0], ids=["about the right pole", "about the left pole"])
@pytest.mark.parametrize("pose", POSES.values(), ids=POSES)
@pytest.mark.parametrize("transducer", TRANSDUCERS.values(), ids=TRANSDUCERS)
def test_the_derivatives_are_those_of_the_readings(transducer, pose, side):
    unknowns = np.array(pose) * [side, 1, 1, 1, 1, 1]
    _, columns = _predicted(transducer, unknowns, side)
    step = 1e-5
    for index in range(len(UNKNOWNS)):
        change = np.eye(len(UNKNOWNS))[index] * step
        ahead, behind = (_predicted(transducer, unknowns + sign * change, side)[0] for sign in (1, -1))
        assert columns[index] == pytest.approx((ahead - behind) / (2 * step), rel=1e-6, abs=2e-8), UNKNOWNS[index]


def test_an_inclinometer_reads_the_rotation_about_its_axis():
    assert _predicted(Transducer("angle", (0.0, 1.0, 0.0)), (0.4, 0, 0, 0, 0, 0), 1.0)[0] == pytest.approx(0.4)
    assert _predicted(Transducer("angle", (0.0, -1.0, 0.0)), (1e-7, 0, 0, 0, 0, 0), 1.0)[0] == pytest.approx(-1e-7)
    assert _predicted(Transducer("angle", (1.0, 0.0, 0.0)), (0.0, 0, 0.05, 0, 0, 0), 1.0)[0] == pytest.approx(0.05)


@pytest.mark.parametrize(("across", "seen"), [(0.0, True), (0.03, False)])
def test_a_line_of_sight_that_passes_beside_a_round_specimen_reads_nothing(across, seen):
    reading, _ = _predicted(TRANSDUCERS["round side"], (0.0, 0, 0, -across, 0, 0), 1.0)
    assert np.isfinite(reading) == seen


OUTLINE = Outline(0.043, 0.043)
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TOP = Transducer("point", X, (0.043, 0.0, 0.44))
BOTTOM = Transducer("surface", X, (0.043, 0.0, 0.02), normal=X)
LEFT_EDGE, RIGHT_EDGE = Transducer("point", Z, (-0.043, 0.0, 0.0)), Transducer("point", Z, (0.043, 0.0, 0.0))
ACROSS_TOP, ACROSS_BOTTOM = Transducer("point", Y, (0.0, 0.043, 0.44)), Transducer("point", Y, (0.0, 0.043, 0.02))
ACROSS_SIDE = Transducer("point", Y, (0.04, 0.043, 0.44))
BESIDE = Transducer("point", X, (0.043, 0.04, 0.44))
INCLINOMETER = Transducer("angle", Y)


@every(
    ("transducers", "unknowns", "words"),
    [
        (
            [TOP],
            ["rocking_angle"],
            "angle only, from 1 displacement transducer; slide cannot be separated",
        ),
        ([TOP, BOTTOM], ["rocking_angle", "slide"], "angle and slide, from 2 displacement transducers"),
        ([TOP, INCLINOMETER], ["rocking_angle", "slide"], "angle and slide, from 2 transducers"),
        ([TOP, LEFT_EDGE], ["rocking_angle"], "slide and uplift cannot be separated: taken as zero"),
        ([LEFT_EDGE, RIGHT_EDGE], ["rocking_angle", "uplift"], "no transducer measures slide, out-of-plane angle"),
        ([TOP, LEFT_EDGE, RIGHT_EDGE], ["rocking_angle", "slide", "uplift"], "angle, slide and uplift, from 3"),
        ([TOP, ACROSS_TOP], ["rocking_angle", "out_of_plane_angle"], "slide and transverse slide cannot be separated"),
        (
            [TOP, ACROSS_TOP, ACROSS_BOTTOM],
            ["rocking_angle", "out_of_plane_angle", "transverse_slide"],
            "slide cannot be separated",
        ),
        ([TOP, ACROSS_TOP, ACROSS_SIDE], ["rocking_angle", "out_of_plane_angle", "yaw"], "transverse slide cannot"),
        ([TOP, BESIDE, BOTTOM], ["rocking_angle", "slide", "yaw"], "angle, slide and yaw"),
    ],
)
def test_what_a_set_up_separates_is_fitted_and_the_rest_is_said(transducers, unknowns, words):
    fitted, _, text = separate(transducers, np.full(len(transducers), 1e-5), PRISM, OUTLINE)
    assert [UNKNOWNS[index] for index in fitted] == unknowns
    assert words in text


def test_two_heights_that_are_too_close_do_not_separate_slide():
    near = Transducer("point", X, (0.043, 0.0, 0.42))
    fitted, *_ = separate([TOP, near], np.full(2, 1e-5), PRISM, OUTLINE)
    assert [UNKNOWNS[index] for index in fitted] == ["rocking_angle"]


@pytest.mark.parametrize(
    ("transducers", "words"),
    [
        ([ACROSS_TOP], "No transducer measures the rotation: each is at the height of the base"),
        ([Transducer("point", X, (0.043, 0.0, 0.0))], "each is at the height of the base"),
        ([LEFT_EDGE], "No transducer measures the rotation at θ < 0"),
        ([RIGHT_EDGE], "No transducer measures the rotation at θ > 0"),
    ],
    ids=["across the plane", "at the base", "left edge alone", "right edge alone"],
)
def test_a_set_up_that_does_not_see_the_rotation_is_refused(transducers, words):
    with pytest.raises(UnseenRotationError, match=words):
        separate(transducers, np.ones(len(transducers)), PRISM, OUTLINE)


@pytest.mark.parametrize(("cutoff", "factor"), [(250.0, 1.0), (np.inf, 1.0), (62.5, 2.0), (10.0, 5.0)])
def test_white_noise_is_larger_by_the_root_of_the_band_that_is_left(cutoff, factor):
    readings = Readings([BOTTOM], np.zeros((1, 4)), np.array([0.3]), np.array([cutoff]))
    assert readings.white(1 / 500)[0] == pytest.approx(0.3 * factor)


def test_it_is_the_noise_before_a_real_low_pass():
    noise = np.random.default_rng(4).standard_normal(100_000)
    left = lowpass(noise, 1 / 500, 25.0)
    readings = Readings([BOTTOM], left[None], np.array([left.std()]), np.array([25.0]))
    assert readings.white(1 / 500)[0] == pytest.approx(1.0, rel=0.1)
