"""Transducers that stand still or jump where a block cannot are named; held, fallen and sound blocks are not."""

import re

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.rock import rock
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.identification.plausibility.stuck import stuck
from every import every

INTERVAL = 1 / 500
TIME = np.arange(0, 14, INTERVAL)
PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
ANGLES = np.linspace(-0.4, 0.4, 161)
NOISE = 1e-4
HELD = slice(0, 750)


def _stuck(angle, noise=NOISE, flagged=None):
    """Of an inclinometer with noise after whatever happened to its signal; some of it may be flagged before."""
    noisy = angle + np.random.default_rng(0).normal(0, noise, angle.size)
    rotation = Rotation(
        ("tilt",), noisy[None], ANGLES[None], ANGLES, np.array([noise]), np.ones(1), ("angle",), flagged=flagged
    )
    return stuck(INTERVAL, rotation, rotation.scales(INTERVAL, None, PRISM), None, PRISM)


@pytest.fixture(scope="module")
def angle():
    """Held tilted for a second and a half, then let go."""
    history = rock(PRISM, restitution=0.95, theta0=0.5 * PRISM.critical_angle, duration=12.0, model="nonlinear")
    return np.interp(TIME - 1.5, history.time, history.angle)


def test_a_block_that_is_held_and_rocks_is_not_doubted(angle):
    assert _stuck(angle) == []


@pytest.mark.parametrize("share", [0.97, 0.9, 0.8, 0.6])
def test_a_transducer_that_saturates_at_the_peaks_says_that_they_are_lower_bounds(share, angle):
    limit = share * np.abs(angle[1000:]).max()
    (found,) = _stuck(np.clip(angle, -limit, limit))
    assert found.kind == "end of the range"
    assert "saturates" in found.text
    assert "The peak is a lower bound" in found.text
    assert float(re.search(r"at -?([\d.]+) mrad", found.text)[1]) == pytest.approx(1e3 * limit, rel=0.01)
    assert _stuck(np.clip(angle, -limit, limit), flagged=(np.abs(angle) > limit)[None]) == []


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_a_cable_that_tears_is_named_with_its_jump(share, angle):
    torn = np.where(np.arange(TIME.size) > np.argmax(angle < -share * np.abs(angle[1000:]).max()), 0.0, angle)
    (found,) = _stuck(torn)
    assert found.kind == "dead channel"
    assert "its cable tore" in found.text
    jump = 1e3 * share * np.abs(angle[1000:]).max()
    assert float(re.search(r"jumps by ([\d.]+) mrad", found.text)[1]) == pytest.approx(jump, rel=0.05)


def test_a_longer_window_finds_a_stop_under_more_noise(angle):
    limit = 0.7 * np.abs(angle[1000:]).max()
    (found,) = _stuck(np.clip(angle, -limit, limit), noise=3e-4)
    assert found.kind == "end of the range"


def _falls(onto):
    """After four seconds of little rocking, onto a frame."""
    fall = np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(TIME - 4.0, 0, None)), onto)
    return np.where(TIME > 4.0, fall, 0.02 * np.sin(9 * TIME))


@every(
    "motion",
    [
        "falls onto its frame",
        "falls onto the floor",
        "leans to the end",
        "is lifted and let go",
        "is held and let go again",
    ],
)
def test_a_block_is_not_doubted_that(motion, angle):
    lifted = 0.5 * PRISM.critical_angle * np.linspace(0, 1, 150) ** 2
    motions = {
        "falls onto its frame": _falls(0.28),
        "falls onto the floor": _falls(1.4),
        "leans to the end": _falls(0.15)[:2700],
        "is lifted and let go": np.concatenate((np.zeros(500), lifted, angle[HELD.stop - 250 :])),
        "is held and let go again": np.concatenate((angle[HELD.stop : 4000], lifted, angle)),
    }
    assert _stuck(motions[motion]) == []
