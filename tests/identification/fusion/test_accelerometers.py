import numpy as np
import pytest

from colonnade.dynamics.kinematics import Pose
from colonnade.identification.fusion.accelerometers import angle_from_accelerations
from colonnade.identification.fusion.inertial import Accelerometer, Gyroscope, angular_velocity, specific_force
from prism import PRISM

INTERVAL, NOISE = 0.002, 0.02
TIME = np.arange(0.0, 12.0, INTERVAL)
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
HIGH, LOW = Accelerometer(X, (0.043, 0.0, 0.43)), Accelerometer(X, (0.01, 0.02, 0.05))
UPWARDS = Accelerometer(Z, (-0.02, 0.0, 0.456))
BASE = 1.5 * np.sin(2 * np.pi * 1.3 * TIME)


@pytest.fixture(params=[0.02, 0.3], ids=["at 0.02 rad", "at 0.3 rad"])
def swinging(request):
    """A smooth motion about the right pole: angle, its first and its second derivative, in closed form."""
    inside = (TIME > 2) & (TIME < 10)
    phase, slow, fast = TIME - 2, np.pi / 8, 2 * np.pi
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


@pytest.mark.parametrize("used", [[HIGH, LOW], [HIGH, LOW, UPWARDS]], ids=["a pair", "a pair and a vertical one"])
def test_accelerometers_alone_give_the_angle_within_its_standard_error(used, swinging):
    rng = np.random.default_rng(3)
    readings = np.array([_sensed(each, *swinging) + NOISE * rng.standard_normal(TIME.size) for each in used])
    base = np.array([BASE, 0 * BASE, 0 * BASE])
    found = angle_from_accelerations(used, readings, np.full(len(used), NOISE), base, INTERVAL, PRISM)
    assert found is not None
    angle, error = found
    assert np.mean(np.abs(angle - swinging[0]) < 3 * error) > 0.99
    assert error.max() < 1e-3


def test_taking_gravity_for_motion_fails_that_check(swinging):
    integrated = np.cumsum(np.cumsum(_sensed(HIGH, *swinging) / 0.43)) * INTERVAL**2
    assert np.abs(integrated - swinging[0]).max() > 0.1


@pytest.mark.parametrize(
    "used",
    [[HIGH], [HIGH, Accelerometer(X, (0.0, 0.04, 0.43))], [UPWARDS, Accelerometer(Z, (0.04, 0.0, 0.456))]],
    ids=["one", "two at one height", "two vertical ones"],
)
def test_accelerometers_that_do_not_separate_rotation_from_translation_give_none(used):
    readings = np.zeros((len(used), TIME.size))
    base = np.zeros((3, TIME.size))
    assert angle_from_accelerations(used, readings, np.full(len(used), NOISE), base, INTERVAL, PRISM) is None


def test_the_specific_force_of_a_motion_is_that_of_the_closed_form(swinging):
    angle = swinging[0]
    pose = Pose(angle, *np.zeros((5, TIME.size)))
    predicted = specific_force([HIGH, LOW, UPWARDS], pose, np.array([BASE, 0 * BASE, 0 * BASE]), INTERVAL, PRISM)
    expected = np.array([_sensed(each, *swinging) for each in (HIGH, LOW, UPWARDS)])
    largest = np.abs(expected).max()
    np.testing.assert_allclose(predicted[:, 1:-1], expected[:, 1:-1], atol=1e-4 * largest)


def test_the_angular_velocity_of_a_motion_is_in_the_specimens_own_axes(swinging):
    angle, rate, _ = swinging
    nought = np.zeros_like(angle)
    pose = Pose(angle, nought, nought, nought + 0.2, nought, nought + 0.4)
    axes = [Gyroscope(each) for each in (X, (0.0, 1.0, 0.0), Z)]
    found = angular_velocity(axes, pose, INTERVAL)
    np.testing.assert_allclose(found[1, 1:-1], rate[1:-1], atol=1e-3 * np.abs(rate).max())
    np.testing.assert_allclose(found[[0, 2], 1:-1], 0.0, atol=1e-9)
