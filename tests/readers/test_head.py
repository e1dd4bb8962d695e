"""What a file is by its first bytes, said where it is not what was expected."""

from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.head import BYTES, Head, by_mark, head_of
from every import every


@every(
    ("first", "what"),
    [
        (b"", "the file is empty"),
        (bytes(100), "its first bytes are all zero"),
        (b"\xef\xbb\xbf \n<!DOCTYPE HTML>", "it is a web page"),
        (
            b"version https://git-lfs.github.com/spec/v1",
            "a pointer of git-lfs, not the file itself: fetch that with `git lfs pull`",
        ),
        (b"TDSh" + bytes(9), "give the .tdms"),
        (b"\x1f\x8b\x08", "unpack it first"),
        (b"time;top", ""),
    ],
)
def test_a_file_that_is_something_else_is_called_by_its_name(first, what):
    found = Head(Path("a"), first).look()
    assert what in found
    assert bool(found) == bool(what)


def test_a_file_is_recognised_by_any_of_its_marks(path):
    path.write_bytes(b"MARK2" + bytes(2 * BYTES))
    head = head_of(path)
    assert len(head.content) == BYTES
    assert by_mark((b"MARK1", b"MARK2"), "a mark").looks(head).yes
    recognise = by_mark((b"MARK1",), "a mark")
    assert recognise(path).reason == "it does not start with a mark"
    path.write_bytes(b"TDSm")
    with pytest.raises(ReadError, match=r"record.raw: it does not start with a mark; it is LabVIEW TDMS"):
        recognise.expected(path)


def test_the_first_lines_are_text_of_whatever_encoding(tmp_path):
    lines = [f"Prüfung {number}" for number in range(100)]
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "cp1252"):
        head = Head(Path("a"), "\r\n".join(lines).encode(encoding))
        assert head.lines == lines[:64]
    assert Head(Path("a"), b"1" * BYTES).lines == []
