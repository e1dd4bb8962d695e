"""Decisions of a review about one test, gathered from entries written by hand."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.decision import Flagged, Review, decided

SIGNED = {"who": "V. D.", "when": "2013-04-26", "why": "the video"}

WINDOWS = st.tuples(st.floats(-100, 100), st.floats(0, 100)).map(lambda pair: (pair[0], pair[0] + pair[1]))


def entry(**fields):
    return SIGNED | fields


@pytest.mark.parametrize(
    ("trimmed", "window", "taken"),
    [
        (None, None, None),
        ((2.0, 9.0), None, (2.0, 9.0)),
        (None, (0.0, 5.0), (0.0, 5.0)),
        ((2.0, 9.0), (3.0, 4.0), (3.0, 4.0)),
        ((3.0, 4.0), (2.0, 9.0), (3.0, 4.0)),
        ((0.0, 5.0), (2.0, 9.0), (2.0, 5.0)),
    ],
    ids=["neither", "trimmed only", "window only", "window inside", "trim inside", "overlap"],
)
def test_what_is_taken_is_what_both_windows_share(trimmed, window, taken):
    assert Review(window=trimmed).within(window) == taken


@given(st.lists(WINDOWS, min_size=1, max_size=5))
def test_the_order_of_trims_does_not_matter(windows):
    trims = [("trim", entry(window=window)) for window in windows]
    shared = max(low for low, _ in windows), min(high for _, high in windows)
    assert decided(trims).window == decided(trims[::-1]).window == shared


def test_corrections_of_a_channel_multiply_and_leave_the_others():
    found = decided(
        [("correct", entry(channel=name, factor=factor)) for name, factor in (("a", -2), ("b", 3), ("a", 5))]
    )
    assert found.factors == {"a": -10.0, "b": 3.0}


def test_the_first_who_excludes_a_test_is_named():
    found = decided([("exclude", entry()), ("exclude", entry(who="A. N.", why="noise"))])
    assert found.excluded == "excluded by V. D. on 2013-04-26: the video"
    assert found.sentences == (
        "2013-04-26, V. D.: test excluded: the video",
        "2013-04-26, A. N.: test excluded: noise",
    )


def test_an_excluded_channel_fails_as_a_whole_and_leaves_the_test():
    found = decided([("exclude", entry(channel="top"))])
    reason = "review of 2013-04-26, V. D.: channel top excluded: the video"
    assert found.flags == (Flagged(channel="top", window=None, flag="fail", reason=reason),)
    assert found.excluded == ""


@pytest.mark.parametrize(
    ("action", "fields", "said"),
    [
        ("trim", {"window": (2.0, 60.5)}, "only 2 s to 60.5 s used"),
        ("correct", {"channel": "top", "factor": -1.0}, "gain of channel top multiplied by -1"),
        (
            "flag",
            {"channel": "top", "window": (3.2, 3.4), "flag": "suspect"},
            "channel top from 3.2 s to 3.4 s flagged as suspect",
        ),
    ],
)
def test_a_sentence_says_when_who_what_and_why(action, fields, said):
    assert decided([(action, entry(**fields))]).sentences == (f"2013-04-26, V. D.: {said}: the video",)


def test_no_entry_decides_nothing():
    assert decided([]) == Review()
