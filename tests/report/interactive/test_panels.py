"""Clocks and curves of a page's data."""

from __future__ import annotations

import json

import numpy as np
import pytest

from colonnade.report.interactive.panels import Samples, script


def test_even_times_are_a_start_and_an_interval():
    samples = Samples()
    samples.clock(0.5 + 0.002 * np.arange(100))
    assert samples.clocks[0] == {"start": 0.5, "interval": pytest.approx(0.002), "count": 100}
    assert samples.series == []


def test_one_clock_is_kept_once():
    samples, time = Samples(), np.arange(5.0)
    assert [samples.clock(time), samples.clock(time + 1), samples.clock(time.copy())] == [0, 1, 0]


def test_uneven_times_are_kept_as_they_are():
    samples, time = Samples(), np.array([0.0, 1.0, 2.5, 3.0, 4.0])
    samples.clock(time)
    (clock,) = samples.clocks
    again = clock["start"] + clock["interval"] * np.arange(5) + samples.series[clock["uneven"]]
    np.testing.assert_allclose(again, time)


def test_equal_series_are_kept_once():
    samples, values = Samples(), np.array([1.0, np.nan, 3.0])
    assert [samples.add(values), samples.add(values + 1), samples.add(values.copy())] == [0, 1, 0]
    assert len(samples.series) == 2


@pytest.mark.parametrize("time", [np.array([2.0]), np.array([2.0, 3.0])], ids=["one sample", "two samples"])
def test_short_clocks(time):
    samples = Samples()
    samples.clock(time)
    assert samples.clocks[0]["start"] == 2.0


def test_the_data_is_one_call_with_what_was_given_and_no_text_ends_it():
    samples = Samples()
    curve = samples.curve("a</script>\u2028b", np.arange(3.0), np.ones(3), colour="ink")
    text = script("t", samples, groups=[{"title": "Ω", "panels": [{"curves": [curve]}]}], more=1)
    assert text.startswith("colonnade.show({")
    assert text.isascii()
    given = json.loads(text.removeprefix("colonnade.show(").removesuffix(");\n"))
    assert given["groups"][0]["panels"][0]["curves"] == [
        {"name": "a</script>\u2028b", "clock": 0, "values": 0, "colour": "ink"}
    ]
    assert (given["page"], given["more"], given["clocks"][0]["count"]) == ("t", 1, 3)
