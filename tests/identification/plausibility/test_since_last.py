"""Changes of a channel between two tests: found where they are, and silent where nothing changed."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from colonnade.findings import Severity
from colonnade.identification.plausibility.since_last import ChannelState, changes

GOOD = ChannelState(zero=1e-3, noise=1e-5, motion=1e-2)


def kinds(now: dict[str, ChannelState], before: dict[str, ChannelState]) -> list[tuple[str, Severity]]:
    return [(each.kind, each.severity) for each in changes(now, before, "span-2.0")]


def test_a_channel_that_died_is_serious_while_others_move() -> None:
    dead = ChannelState(zero=1e-3, noise=1e-5, motion=2e-5)
    assert kinds({"top": dead, "bottom": GOOD}, {"top": GOOD, "bottom": GOOD}) == [("dead channel", Severity.SERIOUS)]
    assert not kinds({"top": dead, "bottom": dead}, {"top": GOOD, "bottom": GOOD})  # the specimen did not rock


def test_another_gain_shows_in_the_noise() -> None:
    louder = ChannelState(zero=1e-2, noise=1e-4, motion=1e-1)
    assert kinds({"top": louder}, {"top": GOOD}) == [("gain", Severity.WARNING)]


def test_a_zero_that_wandered() -> None:
    moved = ChannelState(zero=6e-3, noise=1e-5, motion=1e-2)
    assert kinds({"top": moved}, {"top": GOOD}) == [("zero", Severity.WARNING)]


@given(st.floats(0.5, 2.0), st.floats(-0.1, 0.1), st.floats(0.6, 1.6))
def test_tests_of_the_same_instruments_are_silent(motion: float, shift: float, noise: float) -> None:
    now = ChannelState(GOOD.zero + shift * GOOD.motion, noise * GOOD.noise, motion * GOOD.motion)
    assert not kinds({"top": now, "new": GOOD}, {"top": GOOD, "old": GOOD})
