"""How results are written, and progress where there is no terminal."""

import json
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from colonnade.cli.common import console


@dataclass
class Made:
    name: str
    path: Path


def test_text_is_written_as_it_is(capsys):
    console.say("[bold]θ[/bold] :smile: " + "x" * 300)
    assert capsys.readouterr().out == "[bold]θ[/bold] :smile: " + "x" * 300 + "\n"


def test_a_record_is_written_by_the_names_of_its_fields(capsys):
    console.show_json([Made("θ", Path("a/b"))])
    assert capsys.readouterr().out == '[\n  {\n    "name": "θ",\n    "path": "a/b"\n  }\n]\n'


def test_what_is_not_known_is_null_and_arrays_are_lists(capsys):
    console.show_json({"a": np.array([1.5, np.nan]), "b": np.inf})
    assert json.loads(capsys.readouterr().out) == {"a": [1.5, None], "b": None}


def test_a_row_is_one_line_whatever_its_length_and_a_table_without_rows_is_nothing(capsys):
    console.show_table(("test", "reason"), [])
    assert capsys.readouterr().out == ""
    console.show_table(("test", "reason"), [("a", "word " * 60), ("b", "")])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert lines[1] == "a     " + ("word " * 60).rstrip()


@pytest.fixture
def lines(monkeypatch, capsys):
    """Wait until some lines of progress were written; return them."""
    monkeypatch.setattr(console, "EVERY", 0.05)

    def wait_for(count):
        written, end = "", time.monotonic() + 20.0
        while written.count("\n") < count and time.monotonic() < end:
            time.sleep(0.01)
            written += capsys.readouterr().err
        return written.splitlines()

    return wait_for


def test_a_line_comes_every_few_seconds_also_while_nothing_ends(lines):
    with console.work_progress("Reading raw files") as advance:
        assert lines(2)[:2] == ["Reading raw files, after 0 s"] * 2
        advance(2, 3)
        assert "Reading raw files: 2 of 3, after 0 s" in lines(3)
        advance(3, 3)
        assert "3 of 3 done, finishing, after 0 s" in lines(3)


def test_progress_names_what_is_done(lines):
    with console.work_progress("Looking") as show:
        show(4, 20, "free-01 rocking")
        assert any(line.startswith("free-01 rocking: 4 of 20, after ") for line in lines(3))


def test_quick_work_writes_nothing_and_nothing_is_written_after_the_end(monkeypatch, capsys):
    with console.work_progress("Reading raw files") as advance:
        advance(1, 3)
    monkeypatch.setattr(console, "EVERY", 0.01)
    with console.work_progress("Reading raw files"):
        pass
    capsys.readouterr()
    time.sleep(0.1)
    assert capsys.readouterr() == ("", "")
