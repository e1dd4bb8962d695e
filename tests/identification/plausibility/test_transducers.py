"""Each planted fault of a rocking specimen's transducers is named, and a sound set-up is not."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.plausibility.scale import scale_of
from colonnade.identification.plausibility.transducers import Rotation, base_scale, suspicions
from prism import PRISM

RATE = 500.0
STONE = Block.prism(width=0.25, depth=0.30, height=1.10, mass=180.0)
ANGLES = np.linspace(-0.4, 0.4, 161)
NOISE = 2e-5


def _rotation(block, angle, heights):
    points = [[block.positive.half_width, 0.0, height] for height in heights]
    rng = np.random.default_rng(0)
    readings = point_displacement(angle, points, block)[..., 0] + rng.normal(0, NOISE, (len(points), angle.size))
    responses = point_displacement(ANGLES, points, block)[..., 0]
    return Rotation(
        ("top", "bottom", "middle")[: len(points)], readings, responses, ANGLES, *np.full((2, len(points)), NOISE)
    )


def _free(block, heights, *, restitution=0.95, start=0.6, seconds=14):
    """Held tilted for a second and a half, then let go."""
    time = np.arange(0, seconds, 1 / RATE)
    history = rock(
        block, restitution=restitution, theta0=start * block.critical_angle, duration=seconds, model="nonlinear"
    )
    return _rotation(block, np.interp(time - 1.5, history.time, history.angle), heights), None


def _shaken(block, heights, *, frequency=5.0, amplitude=1.5):
    time = np.arange(0, 10, 1 / RATE)
    base = amplitude * block.uplift_acceleration * np.sin(2 * np.pi * frequency * time)
    base *= np.clip(np.minimum(time - 1, 7 - time), 0, 1)
    return _rotation(
        block, rock(block, Motion(base, 1 / RATE), restitution=0.95, model="nonlinear").angle, heights
    ), base


@pytest.fixture(scope="module", params=["free", "shaken", "three on a stone"])
def sound(request):
    """Rotation, table acceleration or None, block."""
    if request.param == "free":
        return *_free(PRISM, (0.44, 0.04)), PRISM
    if request.param == "shaken":
        return *_shaken(PRISM, (0.44, 0.04)), PRISM
    return *_free(STONE, (1.0, 0.05, 0.5), restitution=0.9, seconds=24), STONE


def _times(rotation, index, factor):
    readings, noise = rotation.readings.copy(), rotation.noise.copy()
    readings[index] *= factor
    noise[index] *= abs(factor)
    return replace(rotation, readings=readings, noise=noise)


def _said(sound, change=lambda rotation: rotation):
    rotation, base, block = sound
    return list(map(str, suspicions(1 / RATE, change(rotation), base, block)))


def test_a_sound_set_up_is_not_doubted(sound):
    assert _said(sound) == []


def test_each_transducer_tells_the_scale_of_its_angle_by_itself(sound):
    rotation, base, block = sound
    for factor in (0.1, 1.0, 25.4):
        angle = factor * rotation.readings[0] / rotation.levers[0]
        found = scale_of(1 / RATE, angle, factor * NOISE, base, block)
        assert found.value == pytest.approx(factor, rel=0.05)


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (10.0, "a gain wrong by a factor of 10"),
        (1 / 25.4, "inches read as mm"),
        (1e-3, "factor of 1000"),
        (4.0, "look at its gain"),
    ],
)
@pytest.mark.parametrize("index", [0, 1])
def test_a_wrong_gain_is_named_with_its_channel(sound, index, factor, said):
    (told,) = _said(sound, lambda rotation: _times(rotation, index, factor))
    assert told.startswith(f"channel {sound[0].names[index]} shows ")
    assert said in told


@pytest.mark.parametrize("index", [0, 1])
def test_a_wrong_sign_is_told_and_where_something_else_turns_its_channel(sound, index):
    rotation, base, _ = sound
    (told,) = _said(sound, lambda rotation: _times(rotation, index, -1.0))
    assert "turns opposite to" in told
    if base is not None or len(rotation.names) > 2:
        assert f"the sign of {rotation.names[index]} is wrong" in told
    else:
        assert "the sign of one of the two is wrong" in told


def _swapped(rotation, gains):
    return replace(rotation, gains=np.array(gains)).exchanged(0, 1, with_gains=False)


def test_swapped_columns_are_named(sound):
    (told,) = _said(sound, lambda rotation: _swapped(rotation, np.ones(len(rotation.names))))
    assert "channels top and bottom look swapped" in told
    assert "falls from" in told


def test_swapped_columns_are_named_even_where_gains_make_up_for_heights():
    rotation, base = _free(PRISM, (0.44, 0.04))
    # What is left is that the points of a block do not move in straight lines.
    (told,) = map(str, suspicions(1 / RATE, _swapped(rotation, (11.0, 1.0)), base, PRISM))
    assert "look swapped" in told


@pytest.mark.parametrize("index", [0, 1])
def test_a_dead_transducer_is_named(sound, index):
    def kill(rotation):
        readings = rotation.readings.copy()
        readings[index] = np.random.default_rng(1).normal(0, NOISE, readings.shape[1])
        return replace(rotation, readings=readings)

    (told,) = _said(sound, kill)
    assert told.startswith(f"channel {sound[0].names[index]} hardly moves")


def test_all_of_them_wrong_alike_is_told_as_such(sound):
    (told,) = _said(
        sound, lambda rotation: replace(rotation, readings=10 * rotation.readings, noise=10 * rotation.noise)
    )
    assert "all show" in told
    assert "the specimen's dimensions, or the sampling rate" in told


@pytest.mark.parametrize(("factor", "found"), [(1.0, 1.0), (9.81, 9.81), (-1.0, -1.0), (1 / 9.81, 1 / 9.81)])
def test_rocking_tells_how_wrong_the_tables_acceleration_is(factor, found):
    rotation, base = _shaken(PRISM, (0.44, 0.04))
    assert base_scale(1 / RATE, rotation, factor * base, PRISM) == pytest.approx(found, rel=0.08)
    told = list(map(str, suspicions(1 / RATE, rotation, factor * base, PRISM)))
    assert ["opposite to the table's acceleration" in each for each in told] == ([True] if factor < 0 else [])


def test_of_a_specimen_that_stands_nothing_is_told():
    angle = np.zeros(5000)
    rotation = _rotation(PRISM, angle, (0.44, 0.04))
    base = 0.5 * PRISM.uplift_acceleration * np.sin(2 * np.pi * 5 * np.arange(5000) / RATE)
    assert suspicions(1 / RATE, rotation, base, PRISM) == []
    assert base_scale(1 / RATE, rotation, base, PRISM) is None
