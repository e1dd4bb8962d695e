"""Each planted fault of a rocking specimen's transducers is named, and a sound set-up is not."""

import re
from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.plausibility.transducers import (
    ANGLES,
    Gauge,
    Rotation,
    suspicions,
)
from prism import PRISM

RATE = 500.0
STONE = Block.prism(width=0.25, depth=0.30, height=1.10, mass=180.0)
NOISE = 2e-5


def _rotation(block, angle, heights, base=None):
    points = [[block.positive.half_width, 0.0, height] for height in heights]
    noise = np.random.default_rng(0).normal(0, NOISE, (len(points), angle.size))
    readings, responses = (point_displacement(each, points, block)[..., 0] for each in (angle, ANGLES))
    gauges = (
        Gauge(name, reading, response, NOISE, NOISE)
        for name, reading, response in zip(("top", "bottom", "middle"), readings + noise, responses, strict=False)
    )
    return Rotation(tuple(gauges), block, 1 / RATE, base)


def _free(block, heights, *, restitution=0.95, start=0.6, seconds=14):
    """Held tilted for a second and a half, then let go."""
    time = np.arange(0, seconds, 1 / RATE)
    history = rock(
        block, restitution=restitution, theta0=start * block.critical_angle, duration=seconds, model="nonlinear"
    )
    return _rotation(block, np.interp(time - 1.5, history.time, history.angle), heights)


def _shaken(block, heights, *, frequency=5.0, amplitude=1.5):
    time = np.arange(0, 10, 1 / RATE)
    base = amplitude * block.uplift_acceleration * np.sin(2 * np.pi * frequency * time)
    base *= np.clip(np.minimum(time - 1, 7 - time), 0, 1)
    angle = rock(block, Motion(base, 1 / RATE), restitution=0.95, model="nonlinear").angle
    return _rotation(block, angle, heights, base)


@pytest.fixture(scope="module", params=["free", "shaken", "three on a stone"])
def sound(request):
    """A rotation that is sound."""
    if request.param == "free":
        return _free(PRISM, (0.44, 0.04))
    if request.param == "shaken":
        return _shaken(PRISM, (0.44, 0.04))
    return _free(STONE, (1.0, 0.05, 0.5), restitution=0.9, seconds=24)


def _changed(rotation, index, **changed):
    return rotation.with_gauges(replace(rotation.gauges[index], **changed))


def _times(rotation, index, factor):
    gauge = rotation.gauges[index]
    return _changed(rotation, index, reading=factor * gauge.reading, noise=abs(factor) * gauge.noise)


def _all_times(rotation, factor):
    for index in range(len(rotation.gauges)):
        rotation = _times(rotation, index, factor)
    return rotation


def _said(rotation):
    return list(map(str, suspicions(rotation)))


def test_a_sound_set_up_is_not_doubted(sound):
    assert _said(sound) == []


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (10.0, "a gain wrong by a factor of 10"),
        (1 / 25.4, "inches read as mm"),
        (1e-3, "factor of 1000"),
        (4.0, "its gain × "),
    ],
)
@pytest.mark.parametrize("index", [0, 1])
def test_a_wrong_gain_is_named_with_its_channel(sound, index, factor, said):
    (told,) = _said(_times(sound, index, factor))
    assert told.startswith(f"channel {sound.gauges[index].name} shows ")
    assert said in told


@pytest.mark.parametrize("index", [0, 1])
def test_a_wrong_sign_is_told_with_its_channel(sound, index):
    (told,) = _said(_times(sound, index, -1.0))
    assert told.startswith(f"channel {sound.gauges[index].name} turns opposite to ")
    assert "with its sign reversed" in told


def _swapped(rotation, gains):
    one, other = (replace(rotation.gauges[index], gain=gain) for index, gain in enumerate(gains))
    return rotation.exchanged(one, other)


def test_swapped_columns_are_named(sound):
    (told,) = _said(_swapped(sound, (1.0, 1.0)))
    assert "channels top and bottom look swapped" in told
    assert "falls from" in told


def test_swapped_columns_are_named_even_where_gains_make_up_for_heights():
    # What is left is that the points of a block do not move in straight lines.
    (told,) = _said(_swapped(_free(PRISM, (0.44, 0.04)), (11.0, 1.0)))
    assert "look swapped" in told


@pytest.mark.parametrize("index", [0, 1])
def test_a_dead_transducer_is_named(sound, index):
    still = np.random.default_rng(1).normal(0, NOISE, sound.gauges[index].reading.size)
    (told,) = _said(_changed(sound, index, reading=still))
    assert told.startswith(f"channel {sound.gauges[index].name} hardly moves")


def test_all_of_them_wrong_alike_is_told_as_such(sound):
    (told,) = _said(_all_times(sound, 10.0))
    assert "all show" in told
    assert "all gains × 0.1 (all angles change alike), as of a gain wrong by a factor of 10" in told


@pytest.mark.parametrize("factor", [1.0, 9.81, -1.0, 1 / 9.81])
def test_the_scale_of_the_tables_acceleration_is_no_fault_of_transducers(factor):
    rotation = _shaken(PRISM, (0.44, 0.04))
    assert _said(replace(rotation, acceleration=factor * rotation.acceleration)) == []


@pytest.mark.parametrize("share", [-0.5, 0.5])
def test_a_zero_taken_while_the_block_leans_is_no_gain(share):
    rotation = _shaken(PRISM, (0.44, 0.04))
    leaning = (
        replace(each, reading=each.reading - share * PRISM.critical_angle * each.lever) for each in rotation.gauges
    )
    assert _said(rotation.with_gauges(*leaning)) == []


def test_a_gain_is_told_of_a_block_that_falls_onto_its_frame_and_of_a_record_that_is_cut_while_it_rocks():
    time = np.arange(0, 14, 1 / RATE)
    decay = rock(PRISM, restitution=0.95, theta0=0.6 * PRISM.critical_angle, duration=14, model="nonlinear")
    fallen = np.where(time < 8, np.interp(time - 1.5, decay.time, decay.angle), 0.0)
    fallen += np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(time - 8.0, 0, None)), 0.28)
    rocking = _shaken(PRISM, (0.44, 0.04), frequency=4.0, amplitude=2.0)
    cut = replace(rocking, acceleration=rocking.acceleration[:1670])
    cut = cut.with_gauges(*(replace(each, reading=each.reading[:1670]) for each in cut.gauges))
    for rotation in (_rotation(PRISM, fallen, (0.44, 0.04)), cut):
        (told,) = _said(_times(rotation, 0, 10.0))
        assert "a gain wrong by a factor of 10" in told


def test_of_a_specimen_that_stands_nothing_is_told():
    angle = np.zeros(5000)
    base = 0.5 * PRISM.uplift_acceleration * np.sin(2 * np.pi * 5 * np.arange(5000) / RATE)
    assert suspicions(_rotation(PRISM, angle, (0.44, 0.04), base)) == []


CORRECT = [1.05, 1.1, 1.4, 0.7]
"""Factors: where a wrong one begins to matter, twice that, and gross."""


@pytest.mark.parametrize("factor", CORRECT)
def test_gains_that_are_all_wrong_alike_are_named_with_the_factor_that_would_agree(sound, factor):
    (told,) = _said(_all_times(sound, factor))
    assert float(re.search(r"all gains × ([\d.]+)", told)[1]) == pytest.approx(1 / factor, rel=0.02)
    assert "a base of" in told


@pytest.mark.parametrize("width", [0.0903, 0.0946, 0.120])
def test_a_wrong_width_is_named_first_where_the_table_shows_that_the_gains_are_right(width):
    believed = Block.prism(width=width, depth=0.086, height=0.456, mass=26.10)
    (told,) = suspicions(replace(_shaken(PRISM, (0.44, 0.04)), block=believed))
    assert told.kind == "specimen"
    found = re.search(r"a base of ([\d.]+) mm for ([\d.]+) mm", told.text)
    assert float(found[1]) == pytest.approx(86.0, rel=0.02)
    assert float(found[2]) == pytest.approx(1e3 * width, rel=2e-3)


@pytest.mark.parametrize("rate", [0.95, 1.1, 2.0])
def test_a_wrong_clock_is_named_with_the_sampling_rate_that_would_agree(rate):
    (told,) = suspicions(replace(_free(PRISM, (0.44, 0.04)), interval=rate / RATE))
    assert told.kind == "clock"
    assert float(re.search(r"a sampling rate × ([\d.]+)", told.text)[1]) == pytest.approx(rate, rel=0.02)


@pytest.mark.parametrize("height", [0.418, 0.396, 0.300])
def test_a_wrong_height_is_named_with_the_lever_that_would_agree(sound, height):
    if sound.block is not PRISM:
        pytest.skip("its transducers are elsewhere")
    response = point_displacement(ANGLES, [[0.043, 0.0, height]], PRISM)[0, :, 0]
    (told,) = suspicions(_changed(sound, 0, response=response))
    assert told.text.startswith("channel top shows")
    assert "and that bottom shows" in told.text
    assert float(re.search(r"whose lever is ([\d.]+) mm", told.text)[1]) == pytest.approx(440, rel=0.01)


def test_degrees_read_as_radians_are_named_as_such():
    angle = np.rad2deg(_free(PRISM, (0.44,)).gauges[0].reading / 0.44)
    inclinometer = Gauge("tilt", angle, ANGLES, 1e-3, 1e-3, "angle")
    (told,) = _said(Rotation((inclinometer,), PRISM, 1 / RATE))
    assert "degrees read as radians" in told
    assert "volts" not in told


TIME = np.arange(0, 10, 1 / RATE)


@pytest.fixture(scope="module")
def shaken():
    return _shaken(PRISM, (0.44, 0.04), frequency=4.0, amplitude=1.7)


def test_sound_transducers_have_nothing_to_undo(shaken):
    assert shaken.mistake is None


def _moved(rotation, angle, noise):
    """What the same gauges read of another motion."""
    random = np.random.default_rng(2)
    return rotation.with_gauges(
        *(
            replace(each, reading=np.interp(angle, ANGLES, each.response) + random.normal(0, noise, angle.size))
            for each in rotation.gauges
        )
    )


@pytest.mark.parametrize("walked", [0.0016, 0.005])
def test_a_block_that_walks_is_no_mistake(walked, shaken):
    walk = walked * np.clip((TIME - 2) / 5, 0, 1)
    walked = (replace(each, reading=each.reading + walk) for each in shaken.gauges)
    assert shaken.with_gauges(*walked).mistake is None


@pytest.mark.parametrize("scale", [None, 2.0], ids=["moved by hand", "twice as far as a block"])
def test_agreement_on_a_motion_that_is_not_this_blocks_proves_no_exchange(scale, shaken):
    angle = 0.05 * np.sin(1.9 * TIME) ** 3 if scale is None else scale * shaken.gauges[0].angle()
    noisy = _moved(shaken, angle, NOISE)
    assert noisy.exchanged(*noisy.gauges).mistake is None
