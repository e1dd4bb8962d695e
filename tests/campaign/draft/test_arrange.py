"""Which files were recorded in the same way: set-ups, recorders of one test, and copies."""

from __future__ import annotations

import pytest

from colonnade.campaign.draft.arrange import arrange, names_of
from colonnade.campaign.draft.survey import Column, RawFile, Shape


def raw(relative: str, *names: str, spread: float = 1.0) -> RawFile:
    shape = Shape(spread)
    columns = tuple(Column(n, name, name, "mm", False, True, shape) for n, name in enumerate(names, start=1))
    return RawFile(relative, "delimited", columns, 100.0, 10.0, ())


def test_files_with_the_same_columns_are_of_one_setup():
    setups, copies = arrange([raw("a.csv", "top"), raw("b.csv", "bottom"), raw("c.csv", "top")])
    assert [[test.main.relative for test in setup.tests] for setup in setups] == [["a.csv", "c.csv"], ["b.csv"]]
    assert copies == []


@pytest.mark.parametrize(
    ("first", "second", "recorder"),
    [
        ("span-2.csv", "span-2-daq2.csv", "daq2"),
        ("x_box1.csv", "x_box2.csv", "box2"),
        ("daq1/x.csv", "daq2/x.csv", "daq2"),
        ("x.csv", "x-top.csv", "top"),
    ],
)
def test_files_of_two_recorders_are_one_test(first, second, recorder):
    (setup,), _ = arrange([raw(first, "LVDT 1"), raw(second, "ACC")])
    assert setup.recorders == ("main", recorder)
    assert [{name: file.relative for name, file in test.files.items()} for test in setup.tests] == [
        {"main": first, recorder: second}
    ]


def test_a_name_that_only_adds_a_word_is_another_test_if_the_columns_are_the_same():
    (setup,), _ = arrange([raw("x.csv", "top"), raw("x-again.csv", "top")])
    assert len(setup.tests) == 2


def test_a_copy_in_another_form_is_left_out():
    setups, copies = arrange([raw("a.csv", "top", "bottom"), raw("a.txt", "Top", "Bottom")])
    assert copies == [("a.txt", "a.csv")]
    assert [len(setup.tests) for setup in setups] == [1]


def test_a_column_is_shown_as_in_the_file_where_it_moves_most():
    (setup,), _ = arrange([raw("a.csv", "top", spread=0.1), raw("b.csv", "top", spread=3.0)])
    assert [column.shape.spread for column in setup.columns("main")] == [3.0]
    assert [channel.id for channel in setup.drafted.channels] == ["top"]


def test_tests_called_the_same_have_their_folder_in_the_name():
    setups, _ = arrange([raw("prism/free.csv", "top"), raw("cone/free.csv", "top"), raw("sine.csv", "top")])
    assert names_of(setups[0].tests) == ["prism-free", "cone-free", "sine"]
