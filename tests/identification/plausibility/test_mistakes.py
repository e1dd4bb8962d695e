"""Mistakes that can be undone, and transducers that stand still or jump where a block cannot; sound ones pass."""

import re
from dataclasses import replace

import numpy as np
import pytest
import scipy

from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.plausibility.mistakes import stuck, undone
from colonnade.identification.plausibility.rotation import Gauge, Rotation
from colonnade.identification.plausibility.transducers import base_scale, judge
from every import every
from prism import PRISM

INTERVAL = 1 / 500
TIME = np.arange(0, 12, INTERVAL)
POINTS = [[0.043, 0.0, 0.44], [0.043, 0.0, 0.04]]
ANGLES = np.linspace(-0.4, 0.4, 161)
NOISE = 2e-5
OMEGA = 2 * np.pi * 4.0


@pytest.fixture(scope="module")
def shaken():
    """Sound rotation, and displacement of the table."""
    envelope = np.clip(np.minimum(TIME - 1, 8 - TIME), 0, 1)
    base = 1.7 * PRISM.uplift_acceleration * envelope * np.sin(OMEGA * TIME)
    angle = rock(PRISM, Motion(base, INTERVAL), restitution=0.93, model="nonlinear").angle
    noise = np.random.default_rng(0).normal(0, NOISE, (2, TIME.size))
    readings = point_displacement(angle, POINTS, PRISM)[..., 0] + noise
    responses = point_displacement(ANGLES, POINTS, PRISM)[..., 0]
    moved = -base / OMEGA**2
    gauges = (
        Gauge(name, reading, ANGLES, response, NOISE, NOISE, refixed=moved)
        for name, reading, response in zip(("top", "bottom"), readings, responses, strict=True)
    )
    return Rotation(tuple(gauges), PRISM, INTERVAL, base), moved


def _read(rotation, change):
    """The same with the readings of each changed."""
    return rotation.with_gauges(*(replace(each, reading=change(each.reading)) for each in rotation.gauges))


def _changed(rotation, chosen, added):
    for index in chosen:
        rotation = rotation.added(rotation.gauges[index], added)
    return rotation


def _alone(rotation):
    return replace(rotation, gauges=rotation.gauges[:1])


def test_sound_transducers_have_nothing_to_undo(shaken):
    assert undone(shaken[0]) is None


@pytest.mark.parametrize(
    ("chosen", "names"), [([0], "channel top"), ([1], "channel bottom"), ([0, 1], "channels top and bottom")]
)
def test_transducers_on_the_wall_that_are_declared_to_the_table_are_named(chosen, names, shaken):
    rotation, moved = shaken
    wrong = _changed(rotation, chosen, moved)
    assert undone(wrong).text.startswith(f"{names}: `relative_to` is wrong")
    assert base_scale(judge(wrong)) is None  # what it would say is that of the mistake


def _moved(rotation, angle, noise):
    """What the same gauges read of another motion."""
    random = np.random.default_rng(2)
    return rotation.with_gauges(
        *(
            replace(each, reading=np.interp(angle, ANGLES, each.response) + random.normal(0, noise, angle.size))
            for each in rotation.gauges
        )
    )


def _coupled(rotation, corner):
    numerator, denominator = scipy.signal.butter(1, corner, "high", fs=1 / INTERVAL)
    top = rotation.gauges[0]
    return rotation.with_gauges(replace(top, reading=scipy.signal.lfilter(numerator, denominator, top.reading)))


@pytest.mark.parametrize(
    ("corner", "part"),
    [
        (0.3, slice(None)),
        (0.6, slice(None)),
        (2.0, slice(None)),
        (0.6, slice(None, 3000)),
        (0.6, slice(1500, None)),
    ],
    ids=["0.3 Hz", "0.6 Hz", "2 Hz", "cut while it rocks", "begun while it rocks"],
)
def test_a_transducer_behind_a_high_pass_is_named_with_its_corner(corner, part, shaken):
    rotation, _ = shaken
    coupled = _read(
        _coupled(rotation, corner), lambda reading: reading[part] - (reading[-100:].mean() if part.start else 0)
    )
    free = (replace(each, refixed=None) for each in coupled.gauges)
    found = undone(replace(coupled, gauges=tuple(free), acceleration=rotation.acceleration[part]))
    assert found.text.startswith("channel top does not hold a constant value")
    assert f"{corner:.1g}" in found.text


@pytest.mark.parametrize("corner", [0.2, 0.6, 2.0])
def test_one_alone_behind_a_high_pass_is_named_where_the_table_shakes(corner, shaken):
    found = undone(_alone(_coupled(shaken[0], corner)))
    assert f"a high-pass of {corner:.1g} Hz" in found.text


@pytest.mark.parametrize("corner", [0.1, 0.3, 1.0])
def test_one_alone_behind_a_high_pass_is_named_in_a_free_vibration(corner, shaken):
    rotation, _ = shaken
    history = rock(PRISM, restitution=0.93, theta0=0.09, duration=11.0, model="nonlinear")
    held = np.interp(TIME - 1.0, history.time, history.angle)
    top = rotation.gauges[0]
    reading = np.interp(held, ANGLES, top.response) + np.random.default_rng(1).normal(0, NOISE, TIME.size)
    released = Rotation((replace(top, reading=reading, refixed=None),), PRISM, INTERVAL)
    assert undone(released) is None
    coupled = _coupled(_read(released, lambda reading: reading - reading[0]), corner)
    found = undone(_read(coupled, lambda reading: reading - reading[-100:].mean()))
    assert f"a high-pass of {corner:.1g} Hz" in found.text


def test_one_alone_that_is_sound_or_under_which_the_block_walks_is_not_behind_a_high_pass(shaken):
    for walked in (0.0, 0.0016, 0.005):
        moved = _changed(shaken[0], [0], walked * np.clip((TIME - 2) / 5, 0, 1))
        assert undone(_alone(moved)) is None


def test_what_hardly_shows_is_not_told(shaken):
    rotation, _ = shaken
    angle = rotation.gauges[0].angle()
    same = _moved(rotation, angle, 0.0)
    coupled = _coupled(same, 2e-4)
    assert coupled.residual() > 4 * same.residual()
    assert undone(coupled) is None


@pytest.mark.parametrize(("with_gains", "what"), [(False, "columns"), (True, "places")])
def test_columns_and_places_that_are_exchanged_are_told_apart(with_gains, what, shaken):
    rotation, _ = shaken
    top, bottom = (replace(each, gain=gain) for each, gain in zip(rotation.gauges, (5.0, 1.0), strict=True))
    found = undone(rotation.exchanged(top, bottom, with_gains=with_gains))
    assert found.text.startswith(f"channels top and bottom look swapped: with their {what} exchanged")


@pytest.mark.parametrize("walked", [0.0016, 0.005])
def test_a_block_that_walks_is_no_mistake(walked, shaken):
    walk = walked * np.clip((TIME - 2) / 5, 0, 1)
    assert undone(_changed(shaken[0], [0, 1], walk)) is None


@pytest.mark.parametrize("scale", [None, 2.0], ids=["moved by hand", "twice as far as a block"])
def test_agreement_on_a_motion_that_is_not_this_blocks_proves_no_exchange(scale, shaken):
    rotation, _ = shaken
    angle = 0.05 * np.sin(1.9 * TIME) ** 3 if scale is None else scale * rotation.gauges[0].angle()
    noisy = _moved(rotation, angle, NOISE)
    assert undone(noisy.exchanged(*noisy.gauges, with_gains=False)) is None


LONGER = np.arange(0, 14, INTERVAL)
HELD = slice(0, 750)


def _stuck(*angles, noise=1e-4, flagged=None):
    """Of inclinometers with noise after whatever happened to their signals; some of it may be flagged before."""
    noisy = np.array(angles) + np.random.default_rng(0).normal(0, noise, np.shape(angles))
    gauges = (
        Gauge(name, angle, ANGLES, ANGLES, noise, 1.0, "angle", flagged=flagged)
        for name, angle in zip(("tilt", "other"), noisy, strict=False)
    )
    return list(stuck(Rotation(tuple(gauges), PRISM, INTERVAL)))


@pytest.fixture(scope="module")
def angle():
    """Held tilted for a second and a half, then let go."""
    history = rock(PRISM, restitution=0.95, theta0=0.5 * PRISM.critical_angle, duration=12.0, model="nonlinear")
    return np.interp(LONGER - 1.5, history.time, history.angle)


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
    assert _stuck(np.clip(angle, -limit, limit), flagged=np.abs(angle) > limit) == []


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_a_cable_that_tears_is_named_with_its_jump(share, angle):
    torn = np.where(np.arange(LONGER.size) > np.argmax(angle < -share * np.abs(angle[1000:]).max()), 0.0, angle)
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
    fall = np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(LONGER - 4.0, 0, None)), onto)
    return np.where(LONGER > 4.0, fall, 0.02 * np.sin(9 * LONGER))


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


def test_what_jumps_with_a_specimen_that_fell_did_not_tear(angle):
    fallen = np.where(LONGER > 5.0, 1.2 * PRISM.critical_angle, angle)
    assert [found.kind for found in _stuck(fallen, angle)] == ["dead channel"]
    assert _stuck(fallen, fallen) == []
