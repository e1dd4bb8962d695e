"""The report after a change: only what changed is read and drawn again, and all pages are as if all were new."""

import shutil

import pytest

from colonnade.report import build

pytestmark = pytest.mark.whole


@pytest.fixture
def read_again(monkeypatch):
    """Ids of the tests whose results the report reads."""
    tests = []
    read = build.read_test
    monkeypatch.setattr(build, "read_test", lambda *given, **more: tests.append(given[2].id) or read(*given, **more))
    return tests


def pages(small):
    folder = small.layout.report.parent
    return {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*.html")}


def test_of_one_changed_test_alone_the_results_are_read(small, read_again):
    small.change_a_sample("pulse-01")
    small.run(until="report")
    assert read_again == ["pulse-01"]
    by_parts = pages(small)
    shutil.rmtree(small.layout.report.parent)
    small.layout.catalogue.unlink()
    small.run(until="report")
    assert set(read_again[1:]) == {"free-01", "free-02", "pulse-01", "pulse-02"}
    assert pages(small) == by_parts


def test_a_state_that_is_gone_comes_back_and_that_of_a_watch_stays(small, read_again):
    state = small.layout.state
    text = state.read_text(encoding="utf-8")
    assert '"watched": false' in text
    state.unlink()
    small.run(until="report")
    assert state.read_text(encoding="utf-8") == text
    assert read_again == []
    state.write_text(watched := text.replace("false", "true"), encoding="utf-8")
    small.change_a_sample("pulse-01")
    small.run(until="report")
    assert state.read_text(encoding="utf-8") == watched


def test_what_is_kept_outlasts_a_run_that_stops_before_the_report(small, read_again):
    small.change_a_sample("pulse-02")
    small.run(until="compare")
    small.run(until="report")
    assert read_again == ["pulse-02"]
