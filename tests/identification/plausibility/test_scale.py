"""A transducer's scale by the equation of motion: what it is multiplied by is found again."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.plausibility.scale import scale_of
from colonnade.signals.filters import lowpass
from prism import PRISM

INTERVAL = 1 / 500
TIME = np.arange(0, 12, INTERVAL)


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
    found = scale_of(INTERVAL, factor * angle, 1e-6, None, PRISM)
    assert found.is_known
    assert found.value == pytest.approx(factor, rel=0.1)
    assert np.isnan(found.base)
    assert not found.base_is_known


@pytest.mark.parametrize(("factor", "gain"), [(1.0, 1.0), (1.0, -1.0), (2.0, 1.0), (1.0, 5.0)])
def test_the_tables_acceleration_has_a_scale_of_its_own(shaken, factor, gain):
    angle, base = shaken
    found = scale_of(INTERVAL, factor * angle, 1e-6, gain * base, PRISM)
    assert found.value == pytest.approx(factor, rel=0.1)
    assert found.base_is_known
    assert found.base == pytest.approx(factor / gain, rel=0.1)


RANDOM = lowpass(np.random.default_rng(1).normal(size=TIME.size), INTERVAL, 2.0)


@pytest.mark.parametrize(
    "angle",
    [np.zeros(TIME.size), np.full(TIME.size, 0.1), 0.05 * RANDOM / np.abs(RANDOM).max()],
    ids=["standing", "held tilted", "moved by hand"],
)
def test_a_specimen_that_does_not_rock_gives_no_scale(angle):
    assert not scale_of(INTERVAL, angle + 1e-9 * np.sin(TIME), 1e-6, None, PRISM).is_known


def test_missing_samples_do_not_matter(shaken):
    angle, base = shaken
    broken = angle.copy()
    broken[2000:2050] = np.nan
    whole, found = (scale_of(INTERVAL, each, 1e-6, base, PRISM) for each in (angle, broken))
    assert found.value == pytest.approx(whole.value, rel=0.02)
