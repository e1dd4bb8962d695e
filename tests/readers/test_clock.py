"""Clocks of text files that are called otherwise, or not at all; and those of vectors in structs."""

from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.clock import equal_step, may_be_clock, rising_share, with_clocks
from colonnade.readers.recording import RecordedChannel, Recording
from delimited_text import recorded
from every import every


def rows(times, form="{:.4f}"):
    return "".join(f"{form.format(time)}\t{np.sin(7 * time):.5f}\t{np.cos(5 * time):.5f}\n" for time in times)


def test_the_time_of_a_graph_that_labview_exported_is_the_clock(tmp_path):
    head = "Time [ms] - Plot 0\tAmplitude [mm] - Plot 0\tAmplitude [g] - Plot 1\n"
    recording = recorded(tmp_path, head + rows(5.0 * np.arange(50)))
    clock, first, second = recording.channels
    assert clock.is_clock
    np.testing.assert_allclose(first.time, 0.005 * np.arange(50))
    assert (first.name, first.unit, second.name, second.unit) == ("Amplitude - Plot 0", "mm", "Amplitude - Plot 1", "g")
    assert recording.channel("Amplitude [g] - Plot 1") is second


@every("head", ["", "\ttop\tbottom\n"])
@every(("rate", "form"), [(200.0, "{:.4f}"), (600.0, "{:.3f}")])
def test_a_first_column_without_a_name_that_rises_in_equal_steps_is_the_clock(tmp_path, head, rate, form):
    times = 3.0 + np.arange(100) / rate
    recording = recorded(tmp_path, head + rows(times, form))
    assert recording.channels[0].is_clock
    np.testing.assert_allclose(recording.channels[1].time, times, atol=6e-4)
    assert any("rising in equal steps, without a name" in note for note in recording.notes)


@every(
    ("times", "head"),
    [
        (np.arange(60.0), ""),  # numbers of samples
        (5.0 * np.arange(60), ""),  # perhaps milliseconds
        (0.01 * np.arange(60) ** 1.5, ""),  # unequal steps
        (-0.01 * np.arange(60), ""),  # falling
        (0.005 * np.arange(60), "ramp\ttop\tx\n"),  # its name says something else
    ],
)
def test_what_may_be_something_else_is_not_taken_for_a_clock(tmp_path, times, head):
    assert not any(channel.is_clock for channel in recorded(tmp_path, head + rows(times)).channels)


def clocked(channels, **known):
    return with_clocks(Recording(Path("a.mat"), "matlab", tuple(channels)), **known)


VECTORS = (
    RecordedChannel("t", None, np.arange(4.0) * 5),
    RecordedChannel("top", None, np.arange(4.0)),
    RecordedChannel("other", None, np.arange(3.0)),
    RecordedChannel("off", None, np.full(3, np.nan)),
)


def test_the_clock_that_was_named_is_that_of_all_as_long_as_it():
    recording = clocked(VECTORS, time="t", unit="ms")
    clock, top, other, _ = recording.channels
    assert clock.is_clock
    assert not top.is_clock
    np.testing.assert_allclose(top.time, [0, 0.005, 0.01, 0.015])
    assert other.time is None
    assert any('no clock for "other" and 1 more' in note for note in recording.notes)


def test_a_clock_without_a_number_is_refused():
    with pytest.raises(ReadError, match=r'a.mat: column "off" holds no number, so it cannot be the clock. Name a col'):
        clocked(VECTORS, time="off")


@given(
    begin=some.floats(-1e3, 1e3), step=some.floats(1e-4, 10), count=some.integers(2, 200), off=some.floats(-0.4, 0.4)
)
def test_times_in_equal_steps_have_a_step_within_their_rounding(begin, step, count, off):
    times = begin + step * np.arange(count)
    assert equal_step(times, 1e-3) == pytest.approx(step, rel=1e-3)
    assert rising_share(times) == 1
    late = times.copy()
    late[-1] += off * step
    if count > 2 and abs(off) > 0.01:
        assert equal_step(late, 1e-3) is None


@every("values", [[], [1.0], [0, 1, np.nan], [0, 1, 1], [0, 2, 1], [0, 1, np.inf]])
def test_what_does_not_rise_in_equal_steps_has_no_step(values):
    assert equal_step(np.array(values), 0.1) is None


def test_a_column_that_may_be_a_clock_is_hinted_at():
    assert 'set time = "x" if that is one: it rises in equal steps of 2' in may_be_clock("x", np.arange(9) * 2.0)
    assert may_be_clock("x", np.arange(9.0) ** 2) == ""


RISING = np.arange(20) / 10
SIGNAL = np.sin(np.arange(20.0))


def vectors(**values):
    """Vectors by their paths, with double lines for points; each is in the structs that its path names."""
    paths = {name.replace("__", "."): each for name, each in values.items()}
    return [
        RecordedChannel(path.rpartition(".")[2], None, each, heading=path, scope=tuple(path.split(".")[:-1]))
        for path, each in paths.items()
    ]


@every("name", ["t", "Time", "tMeas", "time_vec", "t_s", "simtime", "xTime"])
def test_a_rising_vector_with_a_name_of_times_is_the_clock(name):
    clock, top = clocked(vectors(**{name: RISING, "top": SIGNAL})).channels
    assert clock.is_clock
    np.testing.assert_allclose(top.time, RISING)


@every(("name", "unit", "factor"), [("t_ms", None, 1e-3), ("t", "ms", 1e-3), ("t", None, 1.0)])
def test_its_unit_is_given_or_at_the_end_of_its_name(name, unit, factor):
    _, top = clocked(vectors(**{name: RISING, "top": SIGNAL}), unit=unit).channels
    np.testing.assert_allclose(top.time, factor * RISING)


def test_each_struct_goes_by_its_own_clock_else_by_that_around_it():
    structs = vectors(t=RISING, a__top=SIGNAL, b__t=2 * RISING, b__top=SIGNAL, b__c__top=SIGNAL)
    last = [float(channel.time[-1]) for channel in clocked(structs).channels]
    assert last == [1.9, 1.9, 3.8, 3.8, 3.8]


def test_the_clock_of_another_struct_is_not_used():
    assert clocked(vectors(a__t=RISING, b__top=SIGNAL)).channels[1].time is None


def test_a_clock_that_goes_back_is_not_used_and_that_is_said():
    recording = clocked(vectors(t=SIGNAL, top=SIGNAL))
    assert [channel.is_clock for channel in recording.channels] == [False, False]
    assert recording.warnings[0].startswith('"t" looks like a clock, but too few of its steps')
    assert [channel.time for channel in recording.channels] == [None, None]


@every("scalars", [{"dt": 0.1}, {"run.Fs": 10.0}, {"sample_rate": 10.0}, {"dt": 0.1, "fs": 10.0}])
def test_without_a_vector_a_constant_step_is_taken_by_its_name(scalars):
    (top,) = clocked(vectors(top=SIGNAL), scalars=scalars).channels
    np.testing.assert_allclose(top.time, RISING, atol=1e-12)


def test_steps_that_contradict_each_other_are_not_used():
    recording = clocked(vectors(top=SIGNAL), scalars={"dt": 0.1, "fs": 200.0})
    assert recording.channels[0].time is None
    assert recording.notes == ("no clock: the step is not clear (dt says 0.1 s, fs says 0.005 s); give sampling_rate",)


def test_channels_with_starts_of_their_own_count_from_the_earliest():
    begin = datetime(2013, 4, 26, 10, 15)
    shared = np.arange(3) / 10
    late = begin + timedelta(milliseconds=250)
    channels = [
        RecordedChannel(name, "mm", np.zeros(3), shared, start=start)
        for name, start in zip("abc", (begin, late, late), strict=True)
    ]
    recording = clocked(channels)
    first, second, third = (channel.time for channel in recording.channels)
    np.testing.assert_allclose(first, [0, 0.1, 0.2])
    np.testing.assert_allclose(second, [0.25, 0.35, 0.45])
    assert third is second
    assert recording.start == begin
