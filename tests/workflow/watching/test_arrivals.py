"""A file is finished when its size and time have stayed the same for long enough, once for each time it is written."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from colonnade.workflow.watching.arrivals import Arrivals, last_change, marks_of

FILE = Path("raw/free-01.csv")


def mark(size: int) -> tuple[int, int, int]:
    return size, size, 1


def test_a_file_that_grows_is_not_finished() -> None:
    arrivals = Arrivals(settle=1.0)
    for step in range(10):
        assert not arrivals.look({FILE: mark(step)}, now=0.9 * step)
    assert arrivals.is_waiting
    assert arrivals.look({FILE: mark(9)}, now=9.2) == {FILE}
    assert not arrivals.is_waiting


def test_a_file_written_again_is_finished_again() -> None:
    arrivals = Arrivals(settle=1.0)
    arrivals.know({FILE: mark(1)})
    assert not arrivals.look({FILE: mark(1)}, now=5.0)
    assert not arrivals.look({FILE: mark(2)}, now=6.0)
    assert arrivals.look({FILE: mark(2)}, now=7.0) == {FILE}


def test_a_file_that_went_away_is_new_when_it_comes_back() -> None:
    arrivals = Arrivals(settle=1.0)
    arrivals.know({FILE: mark(1)})
    assert arrivals.look({}, now=0.0) == set()
    assert arrivals.is_waiting
    assert arrivals.look({}, now=1.0) == {FILE}
    assert arrivals.look({FILE: mark(1)}, now=2.0) == set()
    assert arrivals.look({FILE: mark(1)}, now=3.0) == {FILE}


def test_a_file_that_is_away_for_a_moment_is_as_it_was() -> None:
    arrivals = Arrivals(settle=1.0)
    arrivals.know({FILE: mark(1)})
    looks = [arrivals.look(marks, now) for now, marks in enumerate([{}, {FILE: mark(1)}, {FILE: mark(1)}])]
    assert looks == [set()] * 3


@given(st.lists(st.tuples(st.floats(0.01, 3.0), st.integers(0, 3)), max_size=40))
def test_each_content_is_given_once_and_only_after_it_settled(steps: list[tuple[float, int]]) -> None:
    arrivals, now, changed, last, given_out, written = Arrivals(settle=1.0), 0.0, 0.0, None, False, 0
    for pause, size in steps:
        now += pause
        if size != last:
            last, changed, given_out, written = size, now, False, written + 1
        finished = arrivals.look({FILE: (size, written, 1)}, now)
        if finished:
            assert now - changed >= 1.0
            assert not given_out
            given_out = True
        assert given_out or now - changed < 1.0


def test_the_last_change_is_that_of_the_newest_file(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("a")
    (tmp_path / "b").write_text("b")
    paths = [tmp_path / name for name in "abc"]
    assert last_change(paths) == max(mark[1] for mark in marks_of(paths).values())
    assert last_change([tmp_path / "c"]) == 0
