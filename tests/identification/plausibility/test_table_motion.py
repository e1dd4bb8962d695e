import numpy as np
import pytest

from colonnade.identification.plausibility.factors import as_expected, cause
from colonnade.identification.plausibility.table_motion import TableChannel, dead, disagreement, guilty, ratio
from every import every

INTERVAL = 1 / 500
TIME = np.arange(0, 12, INTERVAL)


def _pair(*, acceleration=1.0, displacement=1.0, noise=(0.01, 2e-5)):
    """Channels of a table that shakes at 3 Hz, each times a factor."""
    shape = np.clip(np.minimum(TIME - 1, 9 - TIME), 0, 1)
    moved = 0.01 * shape * np.sin(6 * np.pi * TIME)
    shaken = np.gradient(np.gradient(moved, INTERVAL), INTERVAL)
    rng = np.random.default_rng(0)
    return (
        TableChannel("ACC", acceleration * shaken + rng.normal(0, noise[0], TIME.size), noise[0]),
        TableChannel("ACT", displacement * moved + rng.normal(0, noise[1], TIME.size), noise[1]),
    )


@pytest.mark.parametrize("factor", [1.0, 9.81, -1.0, 0.1])
def test_the_ratio_of_acceleration_and_displacement_is_found(factor):
    assert ratio(INTERVAL, *_pair(acceleration=factor)) == pytest.approx(factor, rel=0.02)
    assert dead(INTERVAL, *_pair(acceleration=factor)) is None


@every(
    ("found", "by_specimen", "wrong"),
    [
        (1.1, None, ""),
        (1.1, -1.0, ""),
        (9.8, None, "either"),
        (9.8, 1.02, "displacement"),
        (9.8, 9.7, "acceleration"),
        (-1.0, -0.98, "acceleration"),
        (-1.0, 1.0, "displacement"),
        (0.1, 5.0, "either"),
    ],
)
def test_the_specimen_tells_which_of_the_two_is_wrong(found, by_specimen, wrong):
    assert guilty(found, by_specimen) == wrong


def test_a_disagreement_names_channels_and_cause():
    assert "the specimen's rocking shows that ACC is wrong; g read as m/s²" in str(
        disagreement("ACC", "ACT", 9.8, "acceleration")
    )
    assert "opposite signs: one of the two is wrong, ACC or ACT" in str(disagreement("ACC", "ACT", -1.0, "either"))


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"acceleration": 0.0}, "channel ACC hardly moves"),
        ({"displacement": 0.0}, "channel ACT hardly moves"),
        ({"acceleration": 0.0, "displacement": 0.0}, ""),
    ],
    ids=["acceleration", "displacement", "the table stands"],
)
def test_a_dead_channel_is_told_from_a_table_that_stands(changed, said):
    pair = _pair(**changed)
    assert ratio(INTERVAL, *pair) is None
    found = dead(INTERVAL, *pair)
    assert ("" if found is None else found.text).startswith(said)
    assert (found is not None) == bool(said)


def test_two_motions_are_not_one():
    acceleration, _ = _pair()
    other = TableChannel("ACT", 0.01 * np.sin(4 * np.pi * TIME), 2e-5)
    message = str(dead(INTERVAL, acceleration, other))
    assert "not like one table" in message
    assert "did not start with the other (`clock`)" in message


@pytest.mark.parametrize(
    ("scale", "words"), [(9.81, "g read as"), (1 / 9.81, "g read as"), (100.0, "Gal"), (2.0, "look at")]
)
def test_a_scale_of_an_acceleration_has_its_cause(scale, words):
    assert words in cause(scale, "acceleration")
    assert not as_expected(scale)


def test_a_scale_near_one_is_as_expected_whatever_its_sign():
    assert as_expected(1.2)
    assert as_expected(-0.9)
    assert not as_expected(float("nan"))
    assert not as_expected(0.0)
