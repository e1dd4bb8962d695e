"""How results are written, and progress where there is no terminal."""

import json
import time
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


def test_a_record_is_written_by_the_names_of_its_fields_what_is_not_known_as_null_and_arrays_as_lists(capsys):
    console.show_json([Made("θ", Path("a/b"))])
    assert capsys.readouterr().out == '[\n  {\n    "name": "θ",\n    "path": "a/b"\n  }\n]\n'
    console.show_json({"a": np.array([1.5, np.nan]), "b": np.inf})
    assert json.loads(capsys.readouterr().out) == {"a": [1.5, None], "b": None}


def test_a_row_is_one_line_whatever_its_length_and_a_table_without_rows_is_nothing(capsys):
    console.show_table(("test", "reason"), [])
    assert capsys.readouterr().out == ""
    console.show_table(("test", "reason"), [("a", "word " * 60), ("b", "")])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert lines[1] == "a     " + ("word " * 60).rstrip()


def test_a_line_comes_now_and_then_also_while_nothing_ends_and_not_after_the_end(monkeypatch, capsys):
    monkeypatch.setattr(console, "EVERY", 0.05)
    with console.work_progress("Looking") as show:
        written, end = "", time.monotonic() + 20.0
        while time.monotonic() < end and "free-01 rocking: 4 of 20, after 0 s" not in written:
            time.sleep(0.01)
            written += capsys.readouterr().err
            if "Looking, after 0 s" in written:
                show(4, 20, "free-01 rocking")
    time.sleep(0.1)
    capsys.readouterr()
    time.sleep(0.1)
    assert "Looking, after 0 s\nfree-01 rocking: 4 of 20, after 0 s\n" in written
    assert capsys.readouterr() == ("", "")
