"""Which vectors are clocks: by their names, by rising values, and by the struct that they are in."""

from __future__ import annotations

from datetime import datetime

import numpy as np
import pytest

from colonnade.readers.binary.vector_clocks import find_clocks
from colonnade.readers.binary.vectors import Column

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
