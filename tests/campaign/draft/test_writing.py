"""The text of a drafted campaign file: each question once in full, and everything that was left out with its reason."""

from __future__ import annotations

import tomllib

import numpy as np

from colonnade.campaign.draft.layout import arrange
from colonnade.campaign.draft.signal import Shape
from colonnade.campaign.draft.survey import Column, RawFile
from colonnade.campaign.draft.writing import write


def raw(relative: str, *names: str) -> RawFile:
    shape = Shape(1.0, False, None, False)
    columns = tuple(Column(n, name, name, "mm", False, True, shape) for n, name in enumerate(names, start=1))
    return RawFile(relative, "delimited", columns, 100.0, 10.0, ())


def text_of(*files: RawFile, refused: tuple[tuple[str, str], ...] = ()) -> str:
    setups, copies = arrange(files)
    return write("first", setups, copies, refused).text


def test_a_question_is_asked_in_full_once_in_a_setup():
    text = text_of(raw("a.csv", "LVDT 1", "LVDT 2"))
    asked = [line for line in text.splitlines() if line.startswith("relative_to = ")]
    assert [line.partition("# ")[2] for line in asked] == [
        '? where it is fixed: "table" if it moves with the table, else "ground"',
        "? as above",
    ]


def test_a_channel_that_an_earlier_setup_has_refers_to_it():
    text = text_of(raw("a.csv", "LVDT 1"), raw("b.csv", "LVDT 1", "LVDT 2"))
    second = text[text.index("[setups.setup-2.channels.lvdt_1]") :]
    assert "? perhaps as in setup-1" in second[: second.index("lvdt_2")]


def test_the_specimens_are_those_in_the_names_of_the_files():
    written = tomllib.loads(text_of(raw("prism-1.csv", "LVDT 1"), raw("kegel-1.csv", "LVDT 1")))
    assert {name: each["shape"] for name, each in written["specimens"].items()} == {"prism": "prism", "cone": "cone"}
    assert [test["specimen"] for test in written["tests"]] == ["prism", "cone"]


def test_copies_and_refused_files_are_listed_with_the_reason():
    text = text_of(raw("a.csv", "LVDT 1"), raw("a.txt", "LVDT 1"), refused=(("b.bin", "it is empty"),))
    assert "# a.txt: the same columns as a.csv, so it is treated as a copy" in text
    assert "# b.bin: it is empty" in text


def test_a_file_without_a_clock_asks_for_the_sampling_rate():
    shape = Shape(1.0, False, None, False)
    file = RawFile("a.csv", "delimited", (Column(1, "LVDT 1", "LVDT 1", "mm", False, False, shape),), None, None, ())
    assert 'sampling_rate = "? Hz"    # ? no time column found: give the samples per second' in text_of(file)


def test_columns_that_are_left_out_are_named_with_the_reason():
    dead = Column(2, "bottom", "bottom", "mm", False, True, Shape(np.nan, False, None, False))
    file = RawFile("a.csv", "delimited", (*raw("a.csv", "LVDT 1").columns, dead), 100.0, 10.0, ())
    assert '#   "bottom": it holds no number in any of these files' in text_of(file)
