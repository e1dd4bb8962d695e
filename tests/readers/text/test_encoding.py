"""Encodings are found, what is not text is refused, and lines keep their numbers in pieces."""

import pytest

from colonnade.readers.text import encoding
from colonnade.readers.text.encoding import Text, looks_binary, pieces_of
from every import every

TEXT = "Weg [µm];Kraft\r\n1;2\r\n3;4\r\n"


@every(
    ("written_as", "found"),
    [
        ("utf-8", "utf-8"),
        ("utf-8-sig", "utf-8"),
        ("utf-16", "utf-16"),
        ("latin-1", "cp1252"),
        ("ascii", "utf-8"),
    ],
)
def test_an_encoding_is_found_from_the_bytes(path, written_as, found):
    path.write_bytes(TEXT.replace("µ" if written_as == "ascii" else "\0", "u").encode(written_as))
    text = Text.of(path)
    assert text.encoding == found
    lines = text.head()
    assert lines[0].startswith("Weg [")
    assert lines[1:] == ["1;2", "3;4"]
    assert looks_binary(lines) == ""
    assert text.lines()[1:] == ["1;2", "3;4", ""]


def test_a_character_cut_by_the_end_of_the_head_is_no_fault(path, monkeypatch):
    monkeypatch.setattr(encoding, "HEAD_BYTES", 6)
    path.write_text("Weg [µm]", encoding="utf-8")
    assert Text.of(path).encoding == "utf-8"


def test_the_head_has_whole_lines(path, monkeypatch):
    monkeypatch.setattr(encoding, "HEAD_BYTES", 100)
    path.write_text("".join(f"line {number}\n" for number in range(1000)))
    few = Text.of(path).head()
    assert (few[0], len(few)) == ("line 0", 13)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["Unix", "Windows", "old Macintosh"])
@pytest.mark.parametrize("size", [1, 3, 7, 1000])
def test_lines_keep_their_numbers_whatever_the_size_of_the_pieces(path, monkeypatch, end, size):
    monkeypatch.setattr(encoding, "PIECE", size)
    path.write_bytes(end.join(["a;b", "1;2", "", "3;4", "   ", "5;6"]).encode())
    found = list(Text.of(path).pieces(1))
    assert "".join(piece.text for piece in found) == "1;2\n\n3;4\n   \n5;6"
    before = ["".join(piece.text for piece in found[:number]) for number in range(len(found))]
    assert [piece.line for piece in found] == [2 + text.count("\n") for text in before]


def test_lines_come_in_pieces_with_their_numbers(monkeypatch):
    monkeypatch.setattr(encoding, "ROWS_AT_ONCE", 2)
    assert list(pieces_of(["a", "b", "c", "d"], 1, 4)) == [(2, "b\nc\n"), (4, "d\n")]


def test_a_line_that_an_instrument_did_not_end_is_left_out_and_told(path):
    path.write_text("a\nb")
    assert Text.of(path).whole_lines() == (["a"], ["the file ends within line 2, which is left out"])
    path.write_text("a\nb\n")
    assert Text.of(path).whole_lines() == (["a", "b"], [])
