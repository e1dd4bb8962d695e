"""TOML files of a campaign: what is read, and what is said of a file that is not one."""

import pytest

from colonnade.campaign.review import ReviewFile
from colonnade.campaign.syntax.document import key_lines, read, refusal, validated
from colonnade.errors import CampaignError


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"title = \xe9\n", r"byte 9 is not UTF-8 text\. Save the file as UTF-8"),
        (b" " * 20_000_001, "too large for a campaign's own file"),
        (b"a = 1\nb = x", "this is not valid TOML: .*at line 2, column 5"),
        (b"a = " + b"[" * 5000, "this is not valid TOML: .*nested too deeply"),
        (b"a = 1\na = 2", "this is not valid TOML: .*overwrite"),
    ],
    ids=["Latin-1", "a raw file", "a word without quotes", "brackets without end", "a key given twice"],
)
def test_what_is_no_toml_of_a_person_is_refused_with_its_place(tmp_path, content, told):
    path = tmp_path / "campaign.toml"
    path.write_bytes(content)
    with pytest.raises(CampaignError, match=rf"^campaign\.toml.*{told}"):
        read(path)


def test_a_folder_is_no_text_file(tmp_path):
    with pytest.raises(CampaignError, match="a text file was expected"):
        read(tmp_path)


def test_a_model_that_does_not_fit_gives_every_problem_with_its_place(tmp_path):
    model, problems = validated(ReviewFile, {"schema": 1, "trim": [{"test": "a", "who": "V. D."}]}, tmp_path)
    assert model is None
    assert {place for place, _ in problems} == {("trim", 0, "window"), ("trim", 0, "when"), ("trim", 0, "why")}
    assert validated(ReviewFile, {"schema": 1}, tmp_path) == (ReviewFile.model_validate({"schema": 1}), [])


def test_each_problem_is_one_line_and_told_once():
    assert str(refusal(["one", "two\x00", "one"])) == "one\ntwo\\x00"


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
