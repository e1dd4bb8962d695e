"""What gyroscopes and accelerometers read of motions in closed form, and the angle from accelerometers alone."""

import numpy as np
import pytest

from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion.inertial import angle_from_accelerations
from colonnade.identification.fusion.motion import Circumstances, specimen_motion
from colonnade.identification.fusion.sensors import (
    Accelerometer,
    Gyroscope,
    Readings,
    Transducer,
    UnseenRotationError,
    angular_velocity,
    specific_force,
)
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


STEP, NOISE = 0.002, 0.02
SWINGING = np.arange(0.0, 12.0, STEP)
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
HIGH, LOW = Accelerometer(X, (0.043, 0.0, 0.43)), Accelerometer(X, (0.01, 0.02, 0.05))
UPWARDS = Accelerometer(Z, (-0.02, 0.0, 0.456))
BASE = 1.5 * np.sin(2 * np.pi * 1.3 * SWINGING)


@pytest.fixture(params=[0.02, 0.3], ids=["at 0.02 rad", "at 0.3 rad"])
def swinging(request):
    """A smooth motion about the right pole: angle, its first and its second derivative, in closed form."""
    inside = (SWINGING > 2) & (SWINGING < 10)
    phase, slow, fast = SWINGING - 2, np.pi / 8, 2 * np.pi
    hull = np.sin(slow * phase) ** 4
    hull_1 = 4 * slow * np.sin(slow * phase) ** 3 * np.cos(slow * phase)
    hull_2 = 4 * slow**2 * np.sin(slow * phase) ** 2 * (3 * np.cos(slow * phase) ** 2 - np.sin(slow * phase) ** 2)
    wave, wave_1 = (1 - np.cos(fast * phase)) / 2, fast * np.sin(fast * phase) / 2
    wave_2 = fast**2 * np.cos(fast * phase) / 2
    histories = (hull * wave, hull_1 * wave + hull * wave_1, hull_2 * wave + 2 * hull_1 * wave_1 + hull * wave_2)
    return [np.where(inside, request.param * each, 0.0) for each in histories]


def _sensed(accelerometer, angle, rate, angular):
    """Specific force less that at rest: base and gravity turned into the specimen, tangential and centripetal parts."""
    along, up = accelerometer.at[0] - 0.043, accelerometer.at[2]
    x = BASE * np.cos(angle) - 9.81 * np.sin(angle) + angular * up - rate**2 * along
    z = BASE * np.sin(angle) + 9.81 * np.cos(angle) - angular * along - rate**2 * up - 9.81
    return accelerometer.direction[0] * x + accelerometer.direction[2] * z


def _white(used, readings):
    return Readings(used, readings, np.full(len(used), NOISE), np.full(len(used), np.inf))


@pytest.mark.parametrize("used", [[HIGH, LOW], [HIGH, LOW, UPWARDS]], ids=["a pair", "a pair and a vertical one"])
def test_accelerometers_alone_give_the_angle_within_its_standard_error(used, swinging):
    rng = np.random.default_rng(3)
    readings = np.array([_sensed(each, *swinging) + NOISE * rng.standard_normal(SWINGING.size) for each in used])
    base = np.array([BASE, 0 * BASE, 0 * BASE])
    found = angle_from_accelerations(_white(used, readings), base, STEP, PRISM)
    assert found is not None
    angle, error = found
    assert np.mean(np.abs(angle - swinging[0]) < 3 * error) > 0.99
    assert error.max() < 1e-3


def test_taking_gravity_for_motion_fails_that_check(swinging):
    integrated = np.cumsum(np.cumsum(_sensed(HIGH, *swinging) / 0.43)) * STEP**2
    assert np.abs(integrated - swinging[0]).max() > 0.1


@pytest.mark.parametrize(
    "used",
    [[HIGH], [HIGH, Accelerometer(X, (0.0, 0.04, 0.43))], [UPWARDS, Accelerometer(Z, (0.04, 0.0, 0.456))]],
    ids=["one", "two at one height", "two vertical ones"],
)
def test_accelerometers_that_do_not_separate_rotation_from_translation_give_none(used):
    readings = np.zeros((len(used), SWINGING.size))
    base = np.zeros((3, SWINGING.size))
    assert angle_from_accelerations(_white(used, readings), base, STEP, PRISM) is None


OUTLINE = Outline(0.043, 0.043)

TIME_OF_ALL = STEP * np.arange(1500)
ANGLE = np.where((TIME_OF_ALL > 1) & (TIME_OF_ALL < 2), 0.03 * np.sin(2 * np.pi * 2 * (TIME_OF_ALL - 1)) ** 3, 0.0)
AT_REST = np.zeros((3, TIME_OF_ALL.size))
TOP = (0.043, 0.0, 0.44)
POINTS = [Transducer("point", (1.0, 0.0, 0.0), TOP), Transducer("point", (1.0, 0.0, 0.0), (0.043, 0.0, 0.04))]


def held(sensors, value=0.0):
    count = len(sensors)
    return Readings(sensors, np.full((count, TIME_OF_ALL.size), value), np.ones(count), np.ones(count))


NOTHING = held([])


def moved(where=NOTHING, turning=NOTHING, sensing=NOTHING, acceleration=AT_REST):
    test = Circumstances(STEP, 0.3, ends_at_rest=True, displacement=AT_REST, acceleration=acceleration)
    return specimen_motion(where, turning, sensing, PRISM, OUTLINE, test)


def test_residuals_of_what_does_not_enter_are_against_the_motion():
    found = moved(held(POINTS), sensing=held([Accelerometer((1.0, 0.0, 0.0), (0.0, 0.0, 0.4))], 0.5))
    assert found.entered.tolist() == [True, True, False]
    assert found.residual_size[2] == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize(
    ("acceleration", "said"),
    [(None, "acceleration is not known"), (AT_REST, "do not separate its rotation")],
    ids=["table not recorded", "one accelerometer"],
)
def test_accelerometers_alone_need_the_table_and_two_heights(acceleration, said):
    one = [Accelerometer((1.0, 0.0, 0.0), (0.0, 0.0, 0.4))]
    with pytest.raises(UnseenRotationError, match=said):
        moved(sensing=held(one), acceleration=acceleration)
