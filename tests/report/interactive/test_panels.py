"""Clocks, curves and tables of a page's data."""

import json

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from matplotlib.figure import Figure
from scipy.signal import butter, sosfiltfilt

from colonnade.figures.files.output import Picture
from colonnade.report.interactive import panels
from colonnade.report.interactive.panels import LONG, Samples, packed, script, tables_of


def test_uneven_times_are_kept_as_they_are():
    samples, time = Samples(), np.array([0.0, 1.0, 2.5, 3.0, 4.0])
    samples.clock(time)
    (clock,) = samples.clocks
    again = clock["start"] + clock["interval"] * np.arange(5) + samples.series[clock["uneven"]]
    np.testing.assert_allclose(again, time)


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


def picture(count):
    figure = Figure()
    axes = figure.subplots()
    time = 0.01 * np.arange(count)
    axes.plot(time, np.sin(time), label="measured")
    axes.set(xlabel="time (s)", ylabel="slide (mm)")
    return Picture(figure, f"p-{count}", "", "")


def test_a_short_table_is_text():
    tables = tables_of([picture(2)], Samples())
    assert tables == {"p-2": 'time (s),"slide (mm), measured"\n0,0\n0.01,0.00999983333\n'}


def test_a_long_table_names_series_that_the_page_has_already():
    samples = Samples()
    time = 0.01 * np.arange(LONG)
    curve = samples.curve("measured", time, np.sin(time))
    table = tables_of([picture(LONG)], samples)[f"p-{LONG}"]
    assert table["heads"] == ["time (s)", "slide (mm), measured"]
    assert table["columns"] == [{"clock": curve["clock"]}, {"series": curve["values"]}]
    assert len(samples.series) == 1


def test_a_table_that_is_too_long_for_a_page_is_left_out(monkeypatch):
    monkeypatch.setattr(panels, "MOST", LONG - 1)
    samples = Samples()
    assert list(tables_of([picture(LONG), picture(2)], samples)) == ["p-2"]
    assert (samples.series, samples.clocks) == ([], [])


numbers = st.floats(-1e12, 1e12) | st.just(float("nan")) | st.floats(1e-20, 1e-9)


@given(st.lists(arrays(np.float64, st.integers(0, 60), elements=numbers), max_size=4))
def test_what_is_unpacked_is_what_was_packed_to_a_millionth_of_the_largest(unpacked, series):
    found = unpacked(*packed(series))
    assert len(found) == len(series)
    for before, after in zip(series, found, strict=True):
        assert np.array_equal(np.isnan(before), np.isnan(after))
        largest = np.nanmax(np.abs(before), initial=0.0) if np.isfinite(before).any() else 0.0
        np.testing.assert_allclose(after, before, rtol=0, atol=1e-6 * largest + 1e-37, equal_nan=True)


def test_a_test_of_half_a_minute_with_eight_channels_and_two_models_takes_two_megabytes_at_most():
    random, time = np.random.default_rng(1), np.arange(30_000) / 1000
    smooth = butter(4, 35, fs=1000, output="sos")
    series = []
    for channel in range(8):
        reading = np.sin(2 * np.pi * (3 + channel) * time) + random.normal(scale=1e-3, size=time.size)
        series += [np.round(reading * 2**15) / 2**15, sosfiltfilt(smooth, reading)]
    # Angles, their misfits, two bands of each model, motions and base motion.
    series += [sosfiltfilt(smooth, random.normal(size=time.size)) for _ in range(17)]
    assert len(packed(series)[1]) < 2_000_000
