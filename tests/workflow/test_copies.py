"""Raw files of two tests with the same bytes give a warning; files that cannot be the same are not hashed."""

from __future__ import annotations

import pytest

from colonnade.campaign import load
from colonnade.workflow import copies
from colonnade.workflow.copies import digests_of_equal_sizes, with_copies


@pytest.fixture
def told(small):
    """Give the findings for some digests."""
    campaign = load(small.folder)
    return lambda digests: [found.text for found in with_copies(campaign, digests).warnings]


def test_files_that_differ_say_nothing(told):
    assert told({"a": {"raw/a.csv": "1"}, "b": {"raw/b.csv": "2"}}) == []


def test_a_file_that_two_tests_share_is_no_copy(told):
    assert told({"a": {"raw/a.csv": "1"}, "b": {"raw/a.csv": "1"}}) == []


def test_two_recorders_of_one_test_may_write_the_same(told):
    assert told({"a": {"raw/a.csv": "1", "raw/b.csv": "1"}}) == []


def test_files_that_are_empty_or_unknown_are_no_copies(told):
    assert told({"a": {"raw/a.csv": None}, "b": {"raw/b.csv": None}}) == []


def test_a_copy_names_both_files_and_the_test_to_look_at(told):
    (text,) = told({"a": {"raw/a.csv": "1"}, "b": {"raw/b.csv": "1"}})
    assert text.startswith("A raw file holds the same bytes as that of another test: raw/b.csv is a copy of raw/a.csv")
    assert text.endswith("or delete the entries of b.")


def test_of_many_copies_three_are_named(told):
    (text,) = told({f"test-{number}": {f"raw/{number}.csv": "1"} for number in range(6)})
    assert text.startswith("5 raw files hold")
    assert text.count("is a copy of") == 3
    assert "; and 2 more. " in text
    assert "test-1, test-2, test-3 and 2 more tests" in text


def test_only_files_of_the_same_size_are_hashed(small, monkeypatch):
    hashed = []
    monkeypatch.setattr(copies, "sha256_of", lambda path: hashed.append(path.name) or "1")
    sizes = {path.name: path.stat().st_size for path in (small.folder / "raw").iterdir()}
    digests_of_equal_sizes(load(small.folder))
    assert sorted(hashed) == sorted(name for name in sizes if list(sizes.values()).count(sizes[name]) > 1)
    small.raw("free-02").write_bytes(small.raw("free-01").read_bytes())
    hashed.clear()
    found = digests_of_equal_sizes(load(small.folder))
    assert {"free-01.csv", "free-02.csv"} <= set(hashed)
    assert found["free-02"] == {"raw/free-02.csv": "1"}
