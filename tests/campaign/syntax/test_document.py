"""TOML files of a campaign: what is read, and what is said of a file that is not one."""

from __future__ import annotations

import pytest

from colonnade.campaign.review import ReviewFile
from colonnade.campaign.syntax.document import parse, read_text, refusal, validated
from colonnade.errors import CampaignError


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path):
    path = tmp_path / "campaign.toml"
    path.write_bytes(b"\xef\xbb\xbfschema = 1\r\n")
    assert parse(read_text(path), path.name) == {"schema": 1}


@pytest.mark.parametrize(
    ("content", "told"),
    [(b"title = \xe9\n", "byte 9 is not UTF-8"), (b" " * 20_000_001, "too large for a campaign's own file")],
    ids=["Latin-1", "a raw file"],
)
def test_what_is_no_text_of_a_person_is_refused(tmp_path, content, told):
    path = tmp_path / "campaign.toml"
    path.write_bytes(content)
    with pytest.raises(CampaignError, match=told):
        read_text(path)


def test_a_folder_is_no_text_file(tmp_path):
    with pytest.raises(CampaignError, match="a text file was expected"):
        read_text(tmp_path)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a = 1\nb = x", "at line 2, column 5"),
        ("a = " + "[" * 5000, "nested too deeply"),
        ("a = 1\na = 2", "overwrite"),
    ],
    ids=["a word without quotes", "brackets without end", "a key given twice"],
)
def test_what_is_not_toml_is_refused_with_its_place(text, told):
    with pytest.raises(CampaignError, match=rf"campaign\.toml: this is not valid TOML: .*{told}"):
        parse(text, "campaign.toml")


def test_a_model_that_does_not_fit_gives_every_problem_with_its_place(tmp_path):
    model, problems = validated(ReviewFile, {"schema": 1, "trim": [{"test": "a", "who": "V. D."}]}, tmp_path)
    assert model is None
    assert {place for place, _ in problems} == {("trim", 0, "window"), ("trim", 0, "when"), ("trim", 0, "why")}


def test_a_model_that_fits_has_no_problem(tmp_path):
    model, problems = validated(ReviewFile, {"schema": 1}, tmp_path)
    assert (model, problems) == (ReviewFile.model_validate({"schema": 1}), [])


def test_each_problem_is_one_line_and_told_once():
    assert str(refusal(["one", "two\x00", "one"])) == "one\ntwo\\x00"
