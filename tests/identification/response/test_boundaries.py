"""Both boundaries of a measured map, from tests whose outcomes are in order, out of order or missing."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.response.boundaries import Bracket, MapPoint, Misfit, bracket_boundaries, limit_misfit

LETTERS = {"n": "no-rocking", "r": "rocking", "o": "overturned"}


def points(outcomes, frequency=3.35, amplitudes=(0.9, 1.1, 1.3, 1.5, 1.7)):
    return [
        MapPoint(f"test-{amplitude}", frequency, amplitude, LETTERS[letter])
        for amplitude, letter in zip(amplitudes, outcomes, strict=False)
    ]


@pytest.mark.parametrize(
    ("outcomes", "rocking", "overturning"),
    [
        ("nrroo", Bracket(0.9, 1.1), Bracket(1.3, 1.5)),
        ("nnooo", Bracket(1.1, 1.3), Bracket(1.1, 1.3)),
        ("nnrrr", Bracket(1.1, 1.3), Bracket(1.7, None)),
        ("rrroo", Bracket(None, 0.9), Bracket(1.3, 1.5)),
        ("nnnnn", Bracket(1.7, None), Bracket(1.7, None)),
        ("nroro", Bracket(0.9, 1.1), Bracket(1.1, 1.3, (1.5,))),
        ("nrnro", Bracket(0.9, 1.1, (1.3,)), Bracket(1.5, 1.7)),
    ],
    ids=[
        "in order",
        "nothing between rest and overturning",
        "none overturned",
        "all rocked",
        "none rocked",
        "one stood above one that fell",
        "one stayed still above one that rocked",
    ],
)
def test_brackets(outcomes, rocking, overturning):
    (found,) = bracket_boundaries(points(outcomes))
    assert (found.rocking, found.overturning) == (rocking, overturning)


def test_what_is_out_of_order_or_missing_is_said():
    (found,) = bracket_boundaries(points("nroro"))
    assert found.notes == ("overturning at A = 1.3, but not at 1.5",)
    (found,) = bracket_boundaries(points("rrrrr"))
    assert found.notes == ("no test without rocking", "no test that overturned")


def test_recorded_frequencies_that_differ_a_little_are_one_group():
    found = bracket_boundaries([*points("nr", 3.35), *points("ro", 3.37, (1.3, 1.5)), *points("nr", 4.46)])
    assert [round(each.frequency_ratio, 2) for each in found] == [3.36, 4.46]
    assert found[0].overturning == Bracket(1.3, 1.5)


def test_the_middle_is_known_only_where_both_sides_are():
    assert Bracket(1.0, 1.2).middle == pytest.approx(1.1)
    assert Bracket(1.0, None).middle is None


def test_a_limit_is_compared_with_the_middles_of_the_brackets():
    boundaries = bracket_boundaries([*points("nrroo", 2.0), *points("nrrro", 4.0), *points("nrrrr", 5.0)])
    misfit = limit_misfit(boundaries, [1.0, 3.0, 5.0], [1.3, 1.7, 2.1])
    # Middles 1.4 and 1.6; the limit there is 1.5 and 1.9; at the third frequency nothing overturned.
    assert misfit == Misfit(pytest.approx(0.2), pytest.approx(np.sqrt((0.1**2 + 0.3**2) / 2)), 2)


def test_without_a_limit_at_a_measured_frequency_there_is_no_misfit():
    boundaries = bracket_boundaries(points("nrroo", 2.0))
    assert limit_misfit(boundaries, [1.0, 3.0], [np.nan, np.nan]) is None
    assert limit_misfit(boundaries, [3.0, 4.0], [1.0, 1.0]) is None
