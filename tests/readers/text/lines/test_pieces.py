"""Pieces hold whole lines and know the number of their first."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.readers.text.lines import pieces
from colonnade.readers.text.lines.cells import Dialect
from colonnade.readers.text.lines.encoding import text_of
from colonnade.readers.text.lines.pieces import pieces_of_lines, pieces_of_text

SEMICOLON = Dialect("utf-8", ";", ".")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["Unix", "Windows", "old Macintosh"])
@pytest.mark.parametrize("size", [1, 3, 7, 1000])
def test_lines_keep_their_numbers_whatever_the_size_of_the_pieces(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, end: str, size: int
) -> None:
    monkeypatch.setattr(pieces, "PIECE", size)
    path = tmp_path / "a.csv"
    path.write_bytes(end.join(["a;b", "1;2", "", "3;4", "   ", "5;6"]).encode())
    rows = [row for piece in pieces_of_text(text_of(path, "utf-8"), 1) for row in piece.rows(SEMICOLON)]
    assert rows == [(2, "1;2"), (4, "3;4"), (6, "5;6")]


def test_a_power_failures_zeros_are_unreadable_characters(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes(b"1;2\n\0\0\0")
    texts = "".join(piece.text for piece in pieces_of_text(text_of(path, "utf-8"), 0))
    assert texts == "1;2\n\ufffd\ufffd\ufffd"


def test_a_gap_between_lines_begins_another_piece() -> None:
    found = list(pieces_of_lines([(3, "a"), (4, "b"), (9, "c")]))
    assert [(piece.line, piece.text) for piece in found] == [(3, "a\nb"), (9, "c")]
