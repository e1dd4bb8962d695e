"""How results are written: numbers, tables, JSON, and a reader that goes away."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from colonnade.cli.common import console


@dataclass
class Made:
    name: str
    path: Path


@pytest.mark.parametrize(
    ("value", "text"),
    [(None, ""), (0.41234, "0.4123"), (3, "3"), (["a", None, 0.5], "a; ; 0.5"), ("[bold]θ[/bold] :smile:", None)],
)
def test_a_value_is_written_for_people(value, text):
    assert console.shown(value) == (value if text is None else text)


def test_text_is_written_as_it_is(capsys):
    console.say("[bold]θ[/bold] :smile: " + "x" * 300)
    assert capsys.readouterr().out == "[bold]θ[/bold] :smile: " + "x" * 300 + "\n"


def test_a_record_is_written_by_the_names_of_its_fields(capsys):
    console.show_json([Made("θ", Path("a/b"))])
    assert capsys.readouterr().out == '[\n  {\n    "name": "θ",\n    "path": "a/b"\n  }\n]\n'


def test_what_json_has_no_word_for_is_no_result():
    with pytest.raises(ValueError, match="JSON"):
        console.show_json(float("nan"))


def test_a_row_is_one_line_whatever_its_length(capsys):
    console.show_table(("test", "reason"), [("a", "word " * 60), ("b", "")])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert lines[1] == "a     " + ("word " * 60).rstrip()


def test_a_table_without_rows_is_nothing(capsys):
    console.show_table(("test", "reason"), [])
    assert capsys.readouterr().out == ""


def test_fields_are_under_each_other(capsys):
    console.show_fields([("id", "a"), ("outcome", "rocking")])
    assert capsys.readouterr().out == "id       a\noutcome  rocking\n"


def test_what_went_wrong_is_no_result(capsys):
    console.complain("No.")
    assert (capsys.readouterr()) == ("", "No.\n")
