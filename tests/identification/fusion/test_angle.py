import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.identification.fusion.pose import fit_pose, rocking_angle
from colonnade.identification.fusion.sensors import Transducer
from prism import PRISM

TOP, BOTTOM, ALONG_X, UPWARDS = [0.043, 0.0, 0.440], [0.043, 0.0, 0.020], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]
ANGLES = np.concatenate((np.linspace(-0.6, 0.6, 241), [0.0, 1e-9, -1e-9]))


def _readings(at, direction):
    displacement = point_displacement(ANGLES, at, PRISM)
    return np.einsum("mnk,mk->mn", displacement, np.asarray(direction))


@pytest.mark.parametrize(
    ("at", "direction"),
    [
        ([TOP], [ALONG_X]),
        ([TOP, BOTTOM], [ALONG_X, ALONG_X]),
        ([TOP, [-0.043, 0.0, 0.0]], [ALONG_X, UPWARDS]),
        ([TOP, BOTTOM, [0.0, 0.0, 0.3]], [ALONG_X, ALONG_X, [0.8, 0.0, 0.6]]),
    ],
    ids=["one at the top", "top and bottom", "top and a lifting edge", "three, one inclined"],
)
def test_the_exact_finite_rotation_is_recovered(at, direction):
    angle = rocking_angle(_readings(at, direction), at, direction, PRISM)
    np.testing.assert_allclose(angle, ANGLES, rtol=0, atol=1e-12)


def test_a_small_angle_reading_would_miss_it():
    at, direction = [TOP, BOTTOM], [ALONG_X, ALONG_X]
    top, bottom = _readings(at, direction)
    assert np.abs((top - bottom) / 0.420 - ANGLES).max() > 1e-2


def test_disagreeing_transducers_raise_the_standard_error():
    at, direction = [TOP, BOTTOM, [0.0, 0.0, 0.3]], [ALONG_X] * 3
    transducers = [Transducer("point", tuple(ALONG_X), tuple(point)) for point in at]
    agreeing, readings = _readings(at, direction), _readings(at, direction)
    readings[2] *= 1.1
    error, least = (
        fit_pose(each, transducers, PRISM, noise=[1e-5] * 3).standard_error["rocking_angle"]
        for each in (readings, agreeing)
    )
    assert np.median(error / least) > 20


@given(scale=st.floats(0.1, 10))
def test_the_angle_does_not_depend_on_the_size_of_the_specimen(scale):
    block = Block.prism(width=0.086 * scale, depth=0.086 * scale, height=0.456 * scale, mass=1.0)
    at = scale * np.array([TOP, BOTTOM])
    readings = scale * _readings([TOP, BOTTOM], [ALONG_X, ALONG_X])
    np.testing.assert_allclose(rocking_angle(readings, at, [ALONG_X] * 2, block), ANGLES, atol=1e-10)


def test_positions_that_do_not_match_the_records_are_refused():
    with pytest.raises(ValueError, match="2 records, 1 positions"):
        rocking_angle(np.zeros((2, 3)), TOP, ALONG_X, PRISM)


def test_displacements_in_millimetres_are_refused():
    at, direction = [TOP, BOTTOM], [ALONG_X, ALONG_X]
    with pytest.raises(ValueError, match="metres, relative to the table, were expected"):
        rocking_angle(1e3 * _readings(at, direction), at, direction, PRISM)
