import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion.sensors import UNKNOWNS, Transducer, predict

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


def test_a_wire_without_its_anchor_is_refused():
    with pytest.raises(ValueError, match="needs its anchor"):
        Transducer("wire", (1.0, 0.0, 0.0), (0.0, 0.0, 0.4))
