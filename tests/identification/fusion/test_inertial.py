"""What gyroscopes and accelerometers read of motions in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.kinematics import Pose
from colonnade.identification.fusion.inertial import Accelerometer, Gyroscope, angular_velocity, specific_force
from prism import PRISM

G = PRISM.gravity
EDGE = 0.043
INTERVAL = 1e-3
TIME = INTERVAL * np.arange(200)


def turned(angle, **others):
    return Pose(**{"angle": angle} | {name: np.zeros_like(angle) for name in OTHERS} | others)


OTHERS = ("slide", "pole_rise", "out_of_plane_angle", "transverse_slide", "yaw")


def test_a_steady_rotation_is_read_by_the_gyroscope_along_its_axis_alone():
    gyroscopes = [Gyroscope((0.0, 1.0, 0.0)), Gyroscope((1.0, 0.0, 0.0)), Gyroscope((0.0, 0.6, 0.8))]
    rates = angular_velocity(gyroscopes, turned(0.05 + 0.7 * TIME), INTERVAL)
    np.testing.assert_allclose(rates[:, 1:-1], np.array([[0.7], [0.0], [0.42]]) * np.ones(TIME.size - 2), atol=1e-6)
    assert np.isnan(rates[:, [0, -1]]).all()


def test_a_yaw_is_read_about_z():
    rates = angular_velocity([Gyroscope((0.0, 0.0, 1.0))], turned(np.zeros(200), yaw=0.3 * TIME), INTERVAL)
    np.testing.assert_allclose(rates[0, 1:-1], 0.3, atol=1e-6)


def test_a_block_held_tilted_shows_gravity_in_its_own_axes():
    tilted = np.full(TIME.size, 0.2)
    seen = specific_force(
        [Accelerometer((1.0, 0.0, 0.0), (0.0, 0.0, 0.4)), Accelerometer((0.0, 0.0, 1.0), (0.0, 0.0, 0.4))],
        turned(tilted), np.zeros((3, TIME.size)), INTERVAL, PRISM,
    )  # fmt: skip
    np.testing.assert_allclose(seen[0, 1:-1], -G * np.sin(0.2), rtol=1e-6)
    np.testing.assert_allclose(seen[1, 1:-1], G * (np.cos(0.2) - 1), rtol=1e-6)


def test_a_steady_rotation_pulls_towards_the_pole():
    angle = 0.01 + 0.7 * TIME
    above_the_pole = Accelerometer((0.0, 0.0, 1.0), (EDGE, 0.0, 0.4))
    seen = specific_force([above_the_pole], turned(angle), np.zeros((3, TIME.size)), INTERVAL, PRISM)[0]
    np.testing.assert_allclose(seen[1:-1], (G * (np.cos(angle) - 1) - 0.7**2 * 0.4)[1:-1], atol=1e-5)


def test_the_motion_of_the_table_is_read_by_an_upright_block():
    base = np.array([2.0, -1.0, 0.5])[:, None] * np.ones(TIME.size)
    accelerometers = [Accelerometer(tuple(axis), (0.01, 0.02, 0.3)) for axis in np.eye(3).tolist()]
    seen = specific_force(accelerometers, turned(np.zeros(TIME.size)), base, INTERVAL, PRISM)
    np.testing.assert_allclose(seen[:, 1:-1], base[:, 1:-1], atol=1e-9)


@pytest.mark.parametrize("of", [angular_velocity, None], ids=["gyroscopes", "accelerometers"])
def test_none_of_a_kind_gives_no_rows(of):
    pose = turned(np.zeros(20))
    found = of([], pose, INTERVAL) if of else specific_force([], pose, np.zeros((3, 20)), INTERVAL, PRISM)
    assert found.shape == (0, 20)
