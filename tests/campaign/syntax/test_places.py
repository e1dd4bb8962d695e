"""Where a problem is: line of the file, row and column of the test log, and the key's whole path."""

from __future__ import annotations

import pytest

from colonnade.campaign.syntax.places import Source, key_lines, written

TEXT = """\
schema = 1

[specimens]
prism = {shape = "prism"}

[setups.frame.channels.top]
column = 1
"a key" = 2

[[tests]]
id = "free-01"
[[tests]]  # the second
id = "free-02"
[tests.file]
main = "a.csv"
"""
DOCUMENT = {"tests": [{"id": "free-01"}, {"id": "free-02"}, {"kind": "sine"}]}


@pytest.mark.parametrize(
    ("place", "line"),
    [
        (("schema",), 1),
        (("specimens", "prism"), 4),
        (("setups", "frame", "channels", "top", "column"), 7),
        (("setups", "frame", "channels", "top", "a key"), 8),
        (("tests", 0, "id"), 11),
        (("tests", 1, "id"), 13),
        (("tests", 1, "file", "main"), 15),
    ],
    ids=lambda value: ".".join(map(str, value)) if isinstance(value, tuple) else str(value),
)
def test_a_key_has_its_line(place, line):
    assert key_lines(TEXT)[place] == line


@pytest.mark.parametrize(
    ("place", "path"),
    [
        (("tests", 1, "kind"), "tests[free-02].kind"),
        (("tests", 2, "id"), "tests[3].id"),
        (("specimens", "prism", "width"), "specimens.prism.width"),
        (("trim", 0, "window"), "trim[1].window"),
    ],
)
def test_a_path_names_a_test_by_its_id(place, path):
    assert written(place, DOCUMENT) == path


def test_a_key_inside_a_table_in_one_line_has_the_line_of_the_table():
    source = Source("campaign.toml", key_lines(TEXT))
    told = source.paragraph(("specimens", "prism", "width"), "It is missing.", DOCUMENT)
    assert told == "campaign.toml, line 4: specimens.prism.width: It is missing."


def test_a_problem_of_the_log_has_its_row_and_column():
    source = Source("campaign.toml", key_lines(TEXT), log="tests.csv", rows=(2, 4, 5))
    assert source.paragraph(("tests", 1, "file", "daq2"), "No.", DOCUMENT) == (
        'tests.csv, row 4, column "file.daq2": tests[free-02].file.daq2: No.'
    )


def test_problems_are_told_in_the_order_of_the_files():
    source = Source("campaign.toml", key_lines(TEXT), log="tests.csv", rows=(2, 4, 5))
    problems = [(("tests", 1, "kind"), "c"), (("specimens", "prism"), "b"), (("schema",), "a")]
    assert [line[-1] for line in source.paragraphs(problems, DOCUMENT)] == ["a", "b", "c"]
