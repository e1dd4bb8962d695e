"""What a file is by its first bytes, said where it is not what was expected."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from colonnade.readers.binary.magic import by_mark, head, look


@pytest.mark.parametrize(
    ("first", "what"),
    [
        (b"", "the file is empty"),
        (bytes(100), "its first bytes are all zero"),
        (b"\xef\xbb\xbf \n<!DOCTYPE HTML>", "it is a web page"),
        (b"version https://git-lfs.github.com/spec/v1", "fetch that with `git lfs pull`"),
        (b"TDSh" + bytes(9), "give the .tdms"),
        (b"\x1f\x8b\x08", "unpack it first"),
        (pickle.dumps([1]), "it is a Python pickle, a program that runs when it is opened: never read"),
        (b"time;top", ""),
    ],
    ids=["empty", "zeros", "web page", "git-lfs", "index", "gzip", "pickle", "text"],
)
def test_a_file_that_is_something_else_is_called_by_its_name(first: bytes, what: str) -> None:
    found = look(first)
    assert what in found
    assert bool(found) == bool(what)


def test_a_file_is_recognised_by_any_of_its_marks(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"MARK2" + bytes(10_000))
    assert len(head(path)) < 1000
    assert by_mark(path, (b"MARK1", b"MARK2"), "a mark").yes
    refused = by_mark(path, (b"MARK1",), "a mark")
    assert (refused.yes, refused.reason) == (False, "it does not start with a mark")
    path.write_bytes(b"%PDF-1.4")
    assert by_mark(path, (b"MARK1",), "a mark").reason == "it does not start with a mark; it is a PDF"
