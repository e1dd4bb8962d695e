"""Encodings are found, what is not text is refused, and lines keep their numbers in pieces."""

import pytest

from colonnade.readers.text import encoding as pieces
from colonnade.readers.text.cells import Dialect
from colonnade.readers.text.encoding import (
    detect_encoding,
    ends_within_line,
    head_lines,
    looks_binary,
    pieces_of_lines,
    pieces_of_text,
    text_of,
)
from every import every

TEXT = "Weg [µm];Kraft\r\n1;2\r\n3;4\r\n"


@every(
    ("written_as", "found"),
    [
        ("utf-8", "utf-8"),
        ("utf-8-sig", "utf-8-sig"),
        ("utf-16", "utf-16"),
        ("utf-16-le", "utf-16-le"),
        ("utf-16-be", "utf-16-be"),
        ("utf-32", "utf-32"),
        ("latin-1", "cp1252"),
        ("ascii", "utf-8"),
    ],
)
def test_an_encoding_is_found_from_the_bytes(tmp_path, written_as, found):
    path = tmp_path / "record.txt"
    path.write_bytes(TEXT.replace("µ" if written_as == "ascii" else "\0", "u").encode(written_as))
    encoding = detect_encoding(path)
    assert encoding.name == found
    lines, whole = head_lines(text_of(path))
    assert lines[0].startswith("Weg [")
    assert lines[1:] == ["1;2", "3;4"]
    assert whole
    assert looks_binary(lines) == ""
    assert not ends_within_line(path)


def test_a_character_cut_by_the_end_of_the_head_is_no_fault(tmp_path, monkeypatch):
    monkeypatch.setattr("colonnade.readers.text.encoding.HEAD_BYTES", 6)
    path = tmp_path / "record.txt"
    path.write_text("Weg [µm]", encoding="utf-8")
    assert detect_encoding(path).name == "utf-8"


def test_as_many_lines_are_read_as_are_wanted(tmp_path, monkeypatch):
    monkeypatch.setattr("colonnade.readers.text.encoding.HEAD_BYTES", 100)
    path = tmp_path / "record.txt"
    path.write_text("".join(f"line {number}\n" for number in range(1000)))
    few, whole = head_lines(text_of(path, "utf-8"))
    assert (few[0], len(few), whole) == ("line 0", 13, False)
    many, _ = head_lines(text_of(path, "utf-8"), wanted=300)
    assert len(many) >= 300


def test_unprintable_characters_make_a_file_binary():
    assert "not printable" in looks_binary(["\x01\x02\x03", "abc"])


def test_a_last_line_without_end_is_seen_in_utf_16_too(tmp_path):
    path = tmp_path / "record.txt"
    path.write_bytes("1;2\n3;4".encode("utf-16-le"))
    assert ends_within_line(path)
    path.write_bytes("1;2\n3;4\n".encode("utf-16-le"))
    assert not ends_within_line(path)


SEMICOLON = Dialect("utf-8", ";", ".")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["Unix", "Windows", "old Macintosh"])
@pytest.mark.parametrize("size", [1, 3, 7, 1000])
def test_lines_keep_their_numbers_whatever_the_size_of_the_pieces(tmp_path, monkeypatch, end, size):
    monkeypatch.setattr(pieces, "PIECE", size)
    path = tmp_path / "a.csv"
    path.write_bytes(end.join(["a;b", "1;2", "", "3;4", "   ", "5;6"]).encode())
    rows = [row for piece in pieces_of_text(text_of(path, "utf-8"), 1) for row in piece.rows(SEMICOLON)]
    assert rows == [(2, "1;2"), (4, "3;4"), (6, "5;6")]


def test_a_power_failures_zeros_are_unreadable_characters(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"1;2\n\0\0\0")
    texts = "".join(piece.text for piece in pieces_of_text(text_of(path, "utf-8"), 0))
    assert texts == "1;2\n\ufffd\ufffd\ufffd"


def test_a_gap_between_lines_begins_another_piece():
    found = list(pieces_of_lines([(3, "a"), (4, "b"), (9, "c")]))
    assert [(piece.line, piece.text) for piece in found] == [(3, "a\nb"), (9, "c")]
