"""How results are written, and progress where there is no terminal."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

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


def test_a_line_comes_now_and_then_and_names_what_is_done(monkeypatch, capsys):
    with console.work_progress("Looking") as show:
        show(1, 20)
        monkeypatch.setattr(console, "EVERY", 0.0)
        show(4, 20, "free-01 rocking")
        show(5, 20)
    assert capsys.readouterr().err == "free-01 rocking: 4 of 20, after 0 s\nLooking: 5 of 20, after 0 s\n"
