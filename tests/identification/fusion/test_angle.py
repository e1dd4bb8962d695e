import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.identification.fusion.angle import fit_rocking, rocking_angle
from prism import PRISM

TOP, BOTTOM, ALONG_X, UPWARDS = [0.043, 0.0, 0.440], [0.043, 0.0, 0.020], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]
ANGLES = np.concatenate((np.linspace(-0.6, 0.6, 241), [0.0, 1e-9, -1e-9]))


def _readings(at, direction, slide=0.0):
    displacement = point_displacement(ANGLES, at, PRISM, slide)
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


def test_slide_is_separated_by_two_heights():
    at, direction = [TOP, BOTTOM], [ALONG_X, ALONG_X]
    slide = 0.004 * np.sin(np.arange(ANGLES.size))
    fit = fit_rocking(_readings(at, direction, slide), at, direction, PRISM)
    np.testing.assert_allclose(fit.angle, ANGLES, rtol=0, atol=1e-12)
    np.testing.assert_allclose(fit.values["slide"], slide, rtol=0, atol=1e-12)
    assert "angle and slide" in fit.separation


def test_the_standard_error_is_the_scatter_of_the_angle():
    at, direction = [TOP, BOTTOM], [ALONG_X, ALONG_X]
    rng = np.random.default_rng(0)
    noise = np.array([5e-5, 2e-5])
    readings = _readings(at, direction) + rng.normal(size=(2, ANGLES.size)) * noise[:, None]
    fit = fit_rocking(readings, at, direction, PRISM, noise=noise)
    stated = fit.standard_error["rocking_angle"]
    assert np.std((fit.angle - ANGLES) / stated) == pytest.approx(1.0, rel=0.15)
    assert stated[np.argmin(np.abs(ANGLES))] == pytest.approx(np.hypot(*noise) / 0.420, rel=1e-6)


def test_disagreeing_transducers_raise_the_standard_error():
    at, direction = [TOP, BOTTOM, [0.0, 0.0, 0.3]], [ALONG_X] * 3
    readings = _readings(at, direction)
    readings[2] *= 1.1
    fit = fit_rocking(readings, at, direction, PRISM, noise=[1e-5] * 3)
    agreeing = fit_rocking(_readings(at, direction), at, direction, PRISM, noise=[1e-5] * 3)
    assert np.median(fit.standard_error["rocking_angle"] / agreeing.standard_error["rocking_angle"]) > 20


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
