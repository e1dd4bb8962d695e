"""Factors with their causes, scales that rocking tells, and what changed since the last test."""

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.plausibility.scale import UNKNOWN, as_expected, cause, scale_of
from colonnade.signals.filters import lowpass
from every import every
from prism import PRISM


@pytest.mark.parametrize("scale", [1.0, -1.0, 1.4, 1 / 1.4, -0.7])
def test_a_scale_near_one_of_either_sign_is_as_expected(scale):
    assert as_expected(scale)


@pytest.mark.parametrize("scale", [1.6, 0.6, 10.0, 0.0, np.nan, np.inf])
def test_any_other_is_not(scale):
    assert not as_expected(scale)


@every(
    ("scale", "quantity", "said"),
    [
        (9.81, "acceleration", "g read as"),
        (1 / 9.81, "acceleration", "g read as"),
        (-25.4, "displacement", "inches read as mm"),
        (2.5, "displacement", "inches read as cm"),
        (57.3, "angle", "degrees read as radians"),
        (1000.0, "displacement", "mm read as m"),
        (0.01, "acceleration", "by a factor of 100"),
        (10.3, "angle", "by a factor of 10"),
    ],
)
def test_a_known_factor_and_its_inverse_have_a_cause(scale, quantity, said):
    assert said in cause(scale, quantity)


def test_an_odd_factor_has_none():
    assert cause(3.3, "displacement") == UNKNOWN


INTERVAL = 1 / 500
TIME = np.arange(0, 12, INTERVAL)


def _scale(angle, base=None):
    return scale_of(INTERVAL, lambda scale: angle / scale, 1e-6, base, PRISM)


@pytest.fixture(scope="module")
def shaken():
    """Angle and base acceleration of a block that rocks at 5 Hz."""
    base = 1.5 * PRISM.uplift_acceleration * np.sin(2 * np.pi * 5 * TIME)
    base *= np.clip(np.minimum(TIME - 1, 8 - TIME), 0, 1)
    return rock(PRISM, Motion(base, INTERVAL), restitution=0.95).angle, base


@pytest.mark.parametrize("factor", [1.0, 0.1, 10.0])
def test_the_factor_of_a_free_vibration_is_found(factor):
    history = rock(PRISM, restitution=0.95, theta0=0.5 * PRISM.critical_angle, duration=12.0)
    angle = np.interp(TIME, history.time, history.angle)
    found = _scale(factor * angle)
    assert found.is_known
    assert found.value == pytest.approx(factor, rel=0.1)
    assert np.isnan(found.base)


@pytest.mark.parametrize(("factor", "gain"), [(1.0, 1.0), (1.0, -1.0), (2.0, 1.0), (1.0, 5.0)])
def test_the_tables_acceleration_has_a_scale_of_its_own(shaken, factor, gain):
    angle, base = shaken
    found = _scale(factor * angle, gain * base)
    assert found.value == pytest.approx(factor, rel=0.1)
    assert found.base == pytest.approx(factor / gain, rel=0.1)


RANDOM = lowpass(np.random.default_rng(1).normal(size=TIME.size), INTERVAL, 2.0)


@pytest.mark.parametrize(
    "angle",
    [np.zeros(TIME.size), np.full(TIME.size, 0.1), 0.05 * RANDOM / np.abs(RANDOM).max()],
    ids=["standing", "held tilted", "moved by hand"],
)
def test_a_specimen_that_does_not_rock_gives_no_scale(angle):
    assert not _scale(angle + 1e-9 * np.sin(TIME)).is_known


def test_missing_samples_do_not_matter(shaken):
    angle, base = shaken
    broken = angle.copy()
    broken[2000:2050] = np.nan
    whole, found = (_scale(each, base) for each in (angle, broken))
    assert found.value == pytest.approx(whole.value, rel=0.02)
