import re

import numpy as np
import pytest
import scipy

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.findings import Severity
from colonnade.identification.plausibility.table_motion import (
    Comparison,
    TableChannel,
    _disagreement,
    compare,
    derived,
    table_doubts,
)
from colonnade.identification.plausibility.transducers import ANGLES, Gauge, Rotation

INTERVAL = 1 / 500
TIME = np.arange(0, 12, INTERVAL)
PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)


def _pair(*, acceleration=1.0, displacement=1.0, noise=(0.01, 2e-5), change=lambda shaken: shaken):
    """Channels of a table that shakes at 3 Hz and a little at 1 and 5 Hz, each times a factor."""
    shape = np.clip(np.minimum(TIME - 1, 9 - TIME), 0, 1)
    moved = 0.01 * shape * (np.sin(6 * np.pi * TIME) + np.sin(2 * np.pi * TIME) + 0.2 * np.sin(10 * np.pi * TIME))
    shaken = change(np.gradient(np.gradient(moved, INTERVAL), INTERVAL))
    rng = np.random.default_rng(0)
    return (
        TableChannel("ACC", acceleration * shaken + rng.normal(0, noise[0], TIME.size), noise[0]),
        TableChannel("ACT", displacement * moved + rng.normal(0, noise[1], TIME.size), noise[1]),
    )


def _compared(channel, displacement):
    return compare(INTERVAL, channel.values, derived(INTERVAL, displacement.values))


def _told(channel, displacement):
    return table_doubts([channel], [displacement], None, INTERVAL)


def _late(seconds):
    return lambda shaken: np.interp(TIME - seconds, TIME, shaken)


@pytest.mark.parametrize("factor", [1.0, 9.81, -1.0, 0.1, 0.93, 1.4])
def test_the_ratio_of_acceleration_and_displacement_is_found_with_its_error(factor):
    found = _compared(*_pair(acceleration=factor))
    assert abs(found.factor - factor) < max(4 * found.factor_error, 0.002 * abs(factor))
    assert found.factor_error < 0.01 * abs(factor)
    assert not found.delay
    assert found.differs == (factor != 1.0)
    assert bool(_told(*_pair(acceleration=factor))) == found.differs


def test_the_error_of_the_ratio_is_its_scatter():
    found = [
        _compared(channel, TableChannel("ACT", values, 1e-3))
        for channel, displacement in [_pair()]
        for seed in range(30)
        for values in [displacement.values + np.random.default_rng(seed).normal(0, 1e-3, TIME.size)]
    ]
    scatter = np.std([each.factor for each in found], ddof=1)
    # The noise of a second derivative is above the motion's frequencies: the error is on the safe side.
    assert 0.3 < scatter / np.mean([each.factor_error for each in found]) < 1.2


@pytest.mark.parametrize("late", [0.015, -0.05, 0.3])
def test_a_late_acceleration_is_late_and_not_of_another_scale(late):
    pair = _pair(change=_late(late))
    found = _compared(*pair)
    assert found.delay == pytest.approx(late, abs=1e-3)
    assert found.factor == pytest.approx(1.0, abs=0.01)
    (told,) = _told(*pair)
    assert (told.kind, told.severity) == ("late recorder", Severity.SERIOUS if abs(late) > 0.03 else Severity.WARNING)
    assert re.search(rf"is {1e3 * abs(late):.0f}\.\d+ ± .* ms ", told.text) or late == -0.05
    assert ("late against" in told.text) == (late > 0)


@pytest.mark.parametrize(
    ("factor", "severity", "words"),
    [
        (9.8, Severity.SERIOUS, r"ACC is 9\.\d* ± .* times .*: one of the two is wrong, ACC or ACT; g read as m/s²"),
        (
            0.7,
            Severity.SERIOUS,
            r"0\.(70|69)\d* ± .*range and AC coupling, or whether one of them .* is 1\.43 times",
        ),
        (1.08, Severity.WARNING, r"1\.0[78]\d* ± "),
        (-1.0, Severity.SERIOUS, "opposite signs: one of the two is wrong, ACC or ACT"),
    ],
)
def test_a_disagreement_names_channels_factor_and_causes(factor, severity, words):
    (told,) = _told(*_pair(acceleration=factor))
    assert re.search(words, told.text), told.text
    assert told.severity == severity


@pytest.mark.parametrize(("by_specimen", "asked"), [(9.8, "0.102 × ACC"), (1.02, "0.98 × ACC"), (-1.0, "-1 × ACC")])
def test_a_disagreement_says_what_the_rocking_asks_for(by_specimen, asked):
    told = _disagreement(*_pair(), Comparison(9.8, 0.01, 1.0), by_specimen)
    assert f"(the specimen's rocking asks for {asked})" in told.text


@pytest.fixture(scope="module")
def rocked():
    """The prism's angle on a table that shakes it at random, and the table's acceleration."""
    rng = np.random.default_rng(5)
    shaken = scipy.signal.sosfiltfilt(
        scipy.signal.butter(2, [0.7, 5.0], "bandpass", fs=1 / INTERVAL, output="sos"), rng.normal(size=TIME.size)
    ) * np.clip(np.minimum(TIME - 1, 10 - TIME), 0, 1)
    shaken *= 2.0 * PRISM.uplift_acceleration / np.abs(shaken).max()
    history = rock(PRISM, Motion(shaken, INTERVAL), restitution=0.93)
    assert history.outcome == "rocking"
    angle = np.interp(TIME, history.time, history.angle) + rng.normal(0, 1e-4, TIME.size)
    return angle, shaken


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda shaken: shaken, ""),
        (lambda shaken: 0.8 * shaken, ""),
        (lambda shaken: -shaken, r"ACC is -(1|0\.9\d*|1\.\d+) times what .* requires: its sign"),
        (
            lambda shaken: 9.81 * shaken,
            r"ACC is (9\.[5-9]|10)\.?\d* times what the specimen's rocking requires: g read as",
        ),
    ],
    ids=["sound", "scale", "sign", "unit"],
)
def test_the_rocking_alone_shows_a_wrong_acceleration(change, said, rocked):
    angle, shaken = rocked
    channel = TableChannel("ACC", change(shaken), 1e-4)
    rotation = Rotation((Gauge("tilt", angle, ANGLES, 1e-4, quantity="angle"),), PRISM, INTERVAL, channel.values)
    found = table_doubts([channel], [], rotation, INTERVAL)
    assert bool(found) == bool(said)
    assert re.search(said, " ".join(map(str, found))), found


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"acceleration": 0.0}, r"ACC shows 0\.\d+ m/s² RMS"),
        ({"displacement": 0.0}, r"ACT 0\.\d+ m/s²"),
        ({"acceleration": 0.0, "displacement": 0.0}, ""),
    ],
    ids=["acceleration", "displacement", "the table stands"],
)
def test_a_dead_channel_is_told_from_a_table_that_stands(changed, said):
    found = _told(*_pair(**changed))
    assert re.search(said, "".join(map(str, found)))
    assert bool(found) == bool(said)


def test_two_motions_are_not_one():
    acceleration, _ = _pair()
    other = TableChannel("ACT", 0.01 * np.sin(4 * np.pi * TIME), 2e-5)
    message = str(*_told(acceleration, other))
    assert "do not move like one table" in message
    assert "did not start with the other (`clock`)" in message
