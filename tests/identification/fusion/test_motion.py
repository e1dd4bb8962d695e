"""Motion of the specimen from all its transducers together: what each kind adds, and what refuses it."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.kinematics import Outline, point_displacement
from colonnade.identification.fusion.inertial import Accelerometer, Gyroscope
from colonnade.identification.fusion.motion import UNSEEN, specimen_motion
from colonnade.identification.fusion.readings import Circumstances, Readings, TableReadings
from colonnade.identification.fusion.sensors import Transducer
from colonnade.identification.fusion.separation import UnseenRotationError
from prism import PRISM

OUTLINE = Outline(0.043, 0.043)
INTERVAL = 2e-3
TIME = INTERVAL * np.arange(1500)
ANGLE = np.where((TIME > 1) & (TIME < 2), 0.03 * np.sin(2 * np.pi * 2 * (TIME - 1)) ** 3, 0.0)
RATE = np.gradient(ANGLE, TIME)
NOTHING = Readings(np.empty((0, TIME.size)), np.empty(0), np.empty(0))
TABLE = TableReadings(np.zeros((3, TIME.size)), np.zeros((3, TIME.size)))
TOP = (0.043, 0.0, 0.44)
POINTS = [Transducer("point", (1.0, 0.0, 0.0), TOP), Transducer("point", (1.0, 0.0, 0.0), (0.043, 0.0, 0.04))]


def positions():
    values = point_displacement(ANGLE, [each.at for each in POINTS], PRISM)[..., 0]
    return POINTS, Readings(values, np.full(2, 1e-6), np.full(2, 100.0))


def gyroscope(factor=1.0, noise=1e-4):
    values = factor * RATE + noise * np.random.default_rng(1).standard_normal(TIME.size)
    return [Gyroscope((0.0, 1.0, 0.0))], Readings(values[None], np.array([noise]), np.array([np.inf]))


def moved(where=([], NOTHING), turning=([], NOTHING), sensing=([], NOTHING), table=TABLE):
    circumstances = Circumstances(INTERVAL, 0.3, ends_at_rest=True)
    return specimen_motion(where, turning, sensing, table, PRISM, OUTLINE, circumstances)


def test_positions_alone_give_the_angle_of_each_sample():
    found = moved(positions())
    np.testing.assert_allclose(found.angle, ANGLE, atol=1e-9)
    assert found.entered.tolist() == [True, True]
    assert not found.is_integrated


def test_a_gyroscope_alone_is_integrated_from_rest_to_rest():
    found = moved(turning=gyroscope())
    np.testing.assert_allclose(found.angle, ANGLE, atol=2e-4)
    assert found.is_integrated
    assert UNSEEN in found.separation


def test_positions_hold_the_drift_of_a_gyroscope():
    found = moved(positions(), gyroscope())
    assert found.entered.tolist() == [True, True, True]
    np.testing.assert_allclose(found.angle, ANGLE, atol=3e-5)


def test_a_gyroscope_that_contradicts_the_positions_is_left_out():
    found = moved(positions(), gyroscope(factor=1.5))
    assert found.entered.tolist() == [True, True, False]
    assert "not used" in found.separation
    np.testing.assert_allclose(found.angle, ANGLE, atol=1e-9)


def test_residuals_of_what_does_not_enter_are_against_the_motion():
    def held(value, count=1):
        return Readings(np.full((count, TIME.size), value), np.ones(count), np.ones(count))

    found = moved((POINTS, held(0.0, 2)), sensing=([Accelerometer((1.0, 0.0, 0.0), (0.0, 0.0, 0.4))], held(0.5)))
    assert found.entered.tolist() == [True, True, False]
    assert found.residual[2] == pytest.approx(0.5, rel=1e-6)


def test_nothing_that_sees_the_rotation_is_refused():
    across = Transducer("point", (0.0, 1.0, 0.0), TOP), Readings(np.zeros((1, TIME.size)), np.ones(1), np.ones(1))
    with pytest.raises(UnseenRotationError, match="No transducer measures the rotation"):
        moved(([across[0]], across[1]))


@pytest.mark.parametrize(
    ("table", "said"),
    [(TableReadings(TABLE.displacement, None), "acceleration is not known"), (TABLE, "do not separate its rotation")],
    ids=["table not recorded", "one accelerometer"],
)
def test_accelerometers_alone_need_the_table_and_two_heights(table, said):
    one = [Accelerometer((1.0, 0.0, 0.0), (0.0, 0.0, 0.4))]
    with pytest.raises(UnseenRotationError, match=said):
        moved(sensing=(one, Readings(np.zeros((1, TIME.size)), np.ones(1), np.ones(1))), table=table)
