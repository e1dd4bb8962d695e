"""Vectors in structs and groups, and their clocks."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some
from hypothesis.extra.numpy import arrays

from colonnade.readers.binary.vectors import Column, as_values, find_clocks, named, recorded

COLUMNS = named(
    [
        Column("run.t", ("run",), np.arange(4) * 5),
        Column("run.top", ("run",), np.array([0.0, np.inf, 2.0, 3.0])),
        Column("other.top", ("other",), np.arange(3.0)),
    ]
)


def test_columns_are_called_by_the_last_part_of_their_path_if_that_is_clear() -> None:
    assert [column.name for column in COLUMNS] == ["t", "run.top", "other.top"]


def test_a_channel_has_the_path_for_its_heading_and_infinite_values_are_missing() -> None:
    recording, warnings = recorded(Path("a.mat"), "matlab", COLUMNS)
    assert [channel.heading for channel in recording.channels] == ["run.t", "run.top", "other.top"]
    assert warnings == ["run.top: 1 value is infinite, the first at sample 2: taken as missing"]
    np.testing.assert_array_equal(recording.channels[1].values, [0, np.nan, 2, 3])


@given(arrays(np.float64, some.integers(0, 50), elements=some.floats(allow_nan=True, allow_infinity=True)))
def test_only_infinities_are_changed_and_they_are_counted(numbers: np.ndarray) -> None:
    values, warning = as_values(numbers)
    infinite = np.isinf(numbers)
    np.testing.assert_array_equal(values[~infinite], numbers[~infinite])
    assert np.isnan(values[infinite]).all()
    assert bool(warning) == bool(infinite.any())
    if warning:
        assert warning.startswith(f"{infinite.sum()} value")
        assert f"at sample {int(np.argmax(infinite)) + 1}:" in warning


@given(arrays(some.sampled_from([np.bool_, np.int8, np.uint64, np.float32]), some.integers(0, 20)))
def test_numbers_of_any_type_become_values(numbers: np.ndarray) -> None:
    values, _ = as_values(numbers)
    assert values.dtype == np.float64
    assert values.shape == numbers.shape


RISING = np.arange(20) / 10
SIGNAL = np.sin(np.arange(20.0))


def columns(**values: np.ndarray) -> list[Column]:
    """Columns by their paths, with double lines for points; each is in the structs that its path names."""
    paths = {name.replace("__", "."): each for name, each in values.items()}
    return [Column(path, tuple(path.split(".")[:-1]), each) for path, each in paths.items()]


@pytest.mark.parametrize("name", ["t", "Time", "tMeas", "time_vec", "t_s", "simtime", "xTime"])
def test_a_rising_vector_with_a_name_of_times_is_the_clock(name: str) -> None:
    clocks = find_clocks(columns(**{name: RISING, "top": SIGNAL}), {})
    assert clocks.columns == {0}
    np.testing.assert_allclose(clocks.times[1], RISING)


@pytest.mark.parametrize(("name", "unit", "factor"), [("t_ms", None, 1e-3), ("t", "ms", 1e-3), ("t", None, 1.0)])
def test_its_unit_is_given_or_at_the_end_of_its_name(name: str, unit: str | None, factor: float) -> None:
    clocks = find_clocks(columns(**{name: RISING, "top": SIGNAL}), {}, unit)
    np.testing.assert_allclose(clocks.times[1], factor * RISING)


def test_each_struct_goes_by_its_own_clock_else_by_that_around_it() -> None:
    found = find_clocks(columns(t=RISING, a__top=SIGNAL, b__t=2 * RISING, b__top=SIGNAL, b__c__top=SIGNAL), {})
    last = [None if time is None else float(time[-1]) for time in found.times]
    assert last == [1.9, 1.9, 3.8, 3.8, 3.8]


def test_a_clock_that_goes_back_is_not_used_and_that_is_said() -> None:
    clocks = find_clocks(columns(t=SIGNAL, top=SIGNAL), {})
    assert clocks.columns == frozenset()
    assert clocks.warnings[0].startswith("t looks like a clock, but only")
    assert clocks.times == (None, None)


def test_days_of_matlabs_calendar_are_a_date() -> None:
    noon = 735_350.5  # 2013-04-26 12:00
    clocks = find_clocks(columns(t=noon + RISING / 86400, top=SIGNAL), {})
    assert clocks.start == datetime(2013, 4, 26, 12)
    np.testing.assert_allclose(clocks.times[1], RISING, atol=1e-4)


@pytest.mark.parametrize("scalars", [{"dt": 0.1}, {"run.Fs": 10.0}, {"sample_rate": 10.0}, {"dt": 0.1, "fs": 10.0}])
def test_without_a_vector_a_constant_step_is_taken_by_its_name(scalars: dict[str, float]) -> None:
    (time,) = find_clocks(columns(top=SIGNAL), scalars).times
    np.testing.assert_allclose(time, RISING, atol=1e-12)


def test_steps_that_contradict_each_other_are_not_used() -> None:
    clocks = find_clocks(columns(top=SIGNAL), {"dt": 0.1, "fs": 200.0})
    assert clocks.times == (None,)
    assert clocks.notes == ("no clock: the step is not clear (dt says 0.1 s, fs says 0.005 s); give sampling_rate",)


def test_a_vector_that_rises_evenly_by_another_name_is_hinted_at() -> None:
    assert 'set time = "x" if that is one' in find_clocks(columns(top=SIGNAL, x=RISING), {}).notes[0]
