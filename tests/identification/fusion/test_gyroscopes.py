"""Gyroscopes and the smoother: angles within their standard errors between rests."""

import numpy as np
import pytest

from colonnade.dynamics.kinematics import Pose
from colonnade.dynamics.rock import rock
from colonnade.identification.fusion.motion import (
    LARGEST_BIAS,
    REST_ERROR,
    angle_from_rate,
    disagreement,
    mean_rate,
    smooth,
    upright,
)
from colonnade.identification.fusion.sensors import Gyroscope, angular_velocity
from prism import PRISM

INTERVAL, NOISE, BIAS = 0.002, 3e-3, 4e-4
TIME = np.arange(0.0, 14.0, INTERVAL)


@pytest.fixture(params=[0.02, 0.3], ids=["at 0.02 rad", "at 0.3 rad"])
def swings(request):
    """An angle that swings out at 1 Hz between two rests, and its rate, in closed form."""
    inside = (TIME >= 3) & (TIME < 11)
    angle = np.where(inside, request.param * (1 - np.cos(2 * np.pi * TIME)) / 2, 0.0)
    return angle, np.where(inside, np.pi * request.param * np.sin(2 * np.pi * TIME), 0.0)


@pytest.fixture
def released():
    """Held tilted for two seconds, released, at rest in the end: angle and rate."""
    decay = rock(PRISM, restitution=0.93, theta0=0.5 * PRISM.critical_angle, duration=9.0, model="nonlinear")
    angle = np.interp(TIME - 2.0, decay.time, decay.angle)
    return angle, np.gradient(angle, INTERVAL)


def _measured(rate, seed=0):
    return rate + BIAS + NOISE * np.random.default_rng(seed).standard_normal(rate.size)


def test_a_gyroscope_alone_gives_the_angle_within_its_standard_error_between_the_rests(swings):
    angle, rate = swings
    measured = _measured(rate)
    known, rests = upright(measured, NOISE, NOISE, INTERVAL, PRISM, duration=0.5, from_end=False)
    found, error = angle_from_rate(measured, NOISE, INTERVAL, known, np.full(TIME.size, REST_ERROR))
    assert len(rests) >= 2
    assert np.mean(np.abs(found - angle) < 3 * error) > 0.99
    assert error[TIME.size // 2] > 3 * error[0]
    assert np.abs(np.cumsum(measured) * INTERVAL - angle)[-1] > 3 * error.max()


def test_before_a_release_the_specimen_is_still_and_not_upright(released):
    angle, rate = released
    measured = _measured(rate)
    known, rests = upright(measured, NOISE, NOISE, INTERVAL, PRISM, duration=0.5, from_end=True)
    assert np.isnan(known[TIME < 2]).all()
    assert rests[-1][1] == TIME.size
    found, error = angle_from_rate(measured, NOISE, INTERVAL, known, np.full(TIME.size, REST_ERROR))
    assert np.mean(np.abs(found - angle) < 3 * error) > 0.99
    assert error[0] > 2 * error[-1]


def test_the_stated_error_is_the_scatter_over_many_records(swings):
    angle, rate = swings
    known = np.where(TIME < 2, 0.0, np.nan)
    scores = []
    for seed in range(40):
        found, error = angle_from_rate(_measured(rate, seed), NOISE, INTERVAL, known, np.full(TIME.size, REST_ERROR))
        scores.append((found - angle)[-1] / error[-1])
    assert np.std(scores) == pytest.approx(1.0, abs=0.3)


def test_a_tracked_angle_and_a_rate_together_are_better_than_either(swings):
    angle, rate = swings
    tracked = angle + 2e-4 * np.random.default_rng(1).standard_normal(angle.size)
    tracked[2000:2500] = np.nan
    found, error = angle_from_rate(_measured(rate), NOISE, INTERVAL, tracked, np.full(TIME.size, 2e-4))
    assert np.std(found - angle) < 0.3 * 2e-4
    assert np.sqrt(np.mean(((found - angle) / error) ** 2)) == pytest.approx(1.0, abs=0.35)
    assert np.abs((found - angle) / error)[2000:2500].max() < 4


@pytest.mark.parametrize(
    ("factor", "agrees"), [(1.0, True), (-1.0, False), (1.3, False)], ids=["right", "sign", "gain too large by a third"]
)
def test_a_rate_that_contradicts_the_angle_is_noticed(factor, agrees, released):
    angle, rate = released
    tracked = angle + 2e-4 * np.random.default_rng(1).standard_normal(angle.size)
    found = disagreement(factor * _measured(rate), NOISE, INTERVAL, tracked, np.full(TIME.size, 2e-4))
    assert (found < 1.5) == agrees
    assert (found > 3) != agrees


def test_a_missing_stretch_of_the_rate_widens_the_error(swings):
    angle, rate = swings
    measured = _measured(rate)
    measured[3000:3100] = np.nan
    known = np.where((TIME < 2) | (TIME > 12), 0.0, np.nan)
    found, error = angle_from_rate(measured, NOISE, INTERVAL, known, np.full(TIME.size, REST_ERROR))
    assert np.mean(np.abs(found - angle) < 3 * error) > 0.99
    assert np.isfinite(found).all()


def test_gyroscopes_that_are_turned_or_inclined_count_by_their_part_about_y():
    rate = np.sin(TIME)
    inclined = [Gyroscope((0.0, -1.0, 0.0)), Gyroscope((0.6, 0.8, 0.0))]
    mean, noise = mean_rate(inclined, np.array([-rate, 0.8 * rate]), np.array([NOISE, NOISE]))
    np.testing.assert_allclose(mean, rate, atol=1e-12)
    assert noise == pytest.approx(NOISE / np.sqrt(1.64))


def test_the_smoother_is_the_least_squares_solution_of_the_whole_record():
    rng = np.random.default_rng(0)
    count, interval = 40, 0.1
    rate, deviation = rng.normal(size=count), rng.uniform(0.3, 1.0, count)
    tracked = np.where(rng.random(count) < 0.3, rng.normal(size=count), np.nan)
    errors = rng.uniform(0.3, 1.0, count)

    # Unknown are the first angle, minus the bias, and the noise of each step; every angle is a linear function of them.
    of_bias, steps = interval * np.arange(count)[:, None], interval * np.tri(count, count - 1, -1)
    design = np.hstack((np.ones((count, 1)), of_bias, steps))
    given = np.append(0.0, np.cumsum(interval * (rate[1:] + rate[:-1]) / 2))
    known, prior = np.isfinite(tracked), 1 / np.concatenate(([np.pi, LARGEST_BIAS], deviation[:-1]))
    matrix = np.concatenate((np.diag(prior), design[known] / errors[known, None]))
    right = np.concatenate((np.zeros(count + 1), (tracked - given)[known] / errors[known]))
    covariance = np.linalg.inv(matrix.T @ matrix)

    found, error = smooth(rate, deviation, interval, tracked, errors)
    np.testing.assert_allclose(found, design @ (covariance @ matrix.T @ right) + given, atol=1e-10)
    np.testing.assert_allclose(error, np.sqrt(np.diagonal(design @ covariance @ design.T)), rtol=1e-9)


def _rates(gyroscopes, **moving):
    names = ("angle", "slide", "pole_rise", "out_of_plane_angle", "transverse_slide", "yaw")
    pose = Pose(**{name: moving.get(name, np.zeros_like(TIME)) for name in names})
    return angular_velocity([Gyroscope(each) for each in gyroscopes], pose, INTERVAL)


def test_a_steady_rotation_is_read_by_the_gyroscope_along_its_axis_alone():
    rates = _rates([(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.6, 0.8)], angle=0.05 + 0.07 * TIME)
    expected = np.array([[0.07], [0.0], [0.042]]) * np.ones(TIME.size - 2)
    np.testing.assert_allclose(rates[:, 1:-1], expected, atol=1e-6)
    assert np.isnan(rates[:, [0, -1]]).all()
    assert _rates([]).shape == (0, TIME.size)


def test_a_yaw_is_read_about_z():
    np.testing.assert_allclose(_rates([(0.0, 0.0, 1.0)], yaw=0.03 * TIME)[0, 1:-1], 0.03, atol=1e-6)
