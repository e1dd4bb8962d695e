"""A file goes to the format that recognises it; where none does, each says why."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import formats, read


def test_delimited_text_is_always_known_and_asked_last() -> None:
    assert list(formats())[-1] == "delimited"
    assert formats()["delimited"].summary


def test_the_format_that_took_a_file_is_noted(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text("a;b\n1;2\n3;4\n")
    recording = read(path)
    assert recording.format == "delimited"
    assert recording.notes[0].startswith('format "delimited" (text with rows of 2 numbers from line 2 on)')


def test_a_file_that_nobody_takes_gives_each_formats_reason(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text("nothing but words\n")
    with pytest.raises(ReadError) as refusal:
        read(path)
    for name in formats():
        assert f"\n  {name}: " in str(refusal.value)


def test_a_missing_file_is_told_with_the_nearest_name(tmp_path: Path) -> None:
    (tmp_path / "free-01.csv").write_text("1\n")
    with pytest.raises(ReadError, match=r'free-10.csv: there is no such file in .* Did you mean "free-01.csv"'):
        read(tmp_path / "free-10.csv")
    with pytest.raises(ReadError, match="there is no folder"):
        read(tmp_path / "raw" / "free-10.csv")


def test_a_folder_is_no_raw_file(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="this is a folder"):
        read(tmp_path)


def test_an_unknown_format_is_told_with_the_nearest_name(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match=r'There is no format "delimitted". Did you mean "delimited"'):
        read(tmp_path / "record.csv", "delimitted")
