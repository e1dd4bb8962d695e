"""What the end of a record says: upright at rest, leaning, in motion, or impossible."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.rock import rock
from colonnade.identification.response.ending import ending
from colonnade.identification.response.outcome import judge

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
ALPHA = PRISM.critical_angle
TIME = np.arange(0, 9, 0.002)
NOISE = 1e-4


@pytest.fixture(scope="module")
def decay():
    history = rock(PRISM, restitution=0.92, theta0=0.5 * ALPHA, duration=9.0)
    return np.interp(TIME, history.time, history.angle)


def _ending(angle, *, base=None, lever=None):
    noisy = angle + np.random.default_rng(0).normal(0, NOISE, angle.size)
    time = TIME[: angle.size]
    verdict = judge(time, noisy, PRISM, threshold=6 * NOISE, catch=0.28)
    return ending(time, noisy, base, verdict, PRISM, error=NOISE, duration=0.5, lever=lever)


def test_a_block_that_comes_to_rest_upright_has_nothing_to_say(decay):
    assert _ending(decay) is None


@pytest.mark.parametrize(("share", "severity"), [(0.03, "warning"), (0.06, "serious"), (0.3, "serious")])
def test_one_that_rocks_about_a_leaning_zero_says_so_and_that_it_may_have_walked(share, severity, decay):
    found = _ending(decay + share * ALPHA, lever=0.44)
    assert found.severity == severity
    assert "its zero was taken while it leaned" in found.text
    assert "walked by" in found.text
    assert "walked" not in _ending(decay + share * ALPHA).text


@pytest.mark.parametrize("share", [0.3, 0.66, 0.8])
def test_one_at_rest_where_no_block_rests_may_have_overturned(share):
    found = _ending(np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(TIME - 2, 0, None)), share * ALPHA))
    assert found.severity == "serious"
    assert "saturates" in found.text
    assert "may have overturned" in found.text


def test_one_that_lies_on_its_frame_has_nothing_to_say():
    assert _ending(np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(TIME - 2, 0, None)), 0.28)) is None


def test_a_record_that_ends_while_the_table_shakes_is_told_and_free_decay_is_not(decay):
    cut = decay[:1000]
    found = _ending(cut, base=np.sin(20 * TIME[:1000]))
    assert found.kind == "record ends in motion"
    assert _ending(cut, base=np.sin(20 * TIME[:1000]) * (TIME[:1000] < 1)) is None


@pytest.mark.parametrize("factor", [57.3, 4.0])
def test_an_angle_that_no_block_comes_back_from_is_refused_as_such(factor, decay):
    found = _ending(factor * decay)
    assert found.kind == "impossible angle"
    assert "degrees read as radians" in found.text
