"""Tests of one recording give a warning, by its name or by its bytes; files that cannot be the same are not hashed."""

from __future__ import annotations

import pytest

from colonnade.campaign import load
from colonnade.workflow import copies
from colonnade.workflow.copies import digests_of_equal_sizes, with_copies
from every import every


@pytest.fixture
def told(small):
    """Give the findings for some digests."""
    campaign = load(small.folder)
    return lambda digests: [found.text for found in with_copies(campaign, digests).warnings]


@every(
    "digests",
    [
        {"a": {"raw/a.csv": "1"}, "b": {"raw/b.csv": "2"}},
        {"a": {"raw/a.csv": "1"}, "b": {"raw/a.csv": "1"}},
        {"a": {"raw/a.csv": "1", "raw/b.csv": "1"}},
        {"a": {"raw/a.csv": None}, "b": {"raw/b.csv": None}},
    ],
)
def test_files_that_differ_or_are_shared_or_of_one_test_or_empty_are_no_copies(told, digests):
    assert told(digests) == []


@pytest.fixture
def shared(small):
    """Give the findings with free-02 naming the file of free-01, with lines added to both entries."""

    def give(first="", second=""):
        small.edit('file = "raw/free-01.csv"', f'file = "raw/free-01.csv"{first}')
        small.edit('file = "raw/free-02.csv"', f'file = "raw/free-01.csv"{second}')
        return [found.text for found in with_copies(load(small.folder), {}).warnings]

    return give


def test_two_tests_of_one_file_are_one_recording(shared):
    (text,) = shared()
    assert text.startswith("free-01, free-02 are one recording: all name raw/free-01.csv, and no `window` keeps them")


@pytest.mark.parametrize(
    ("first", "second", "is_told"),
    [
        (("0 s", "10 s"), ("10 s", "20 s"), False),
        (("0 s", "11 s"), ("9 s", "20 s"), False),
        (("0 s", "10 s"), ("4 s", "14 s"), True),
        (None, ("4 s", "14 s"), True),
    ],
    ids=["apart", "rest in both", "mostly the same", "one has no window"],
)
def test_windows_keep_two_tests_of_one_file_apart(first, second, is_told, shared):
    first, second = ("" if each is None else f'\nwindow = ["{each[0]}", "{each[1]}"]' for each in (first, second))
    assert bool(shared(first, second)) == is_told


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
