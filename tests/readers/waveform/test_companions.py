"""Seismic kinds in several files: the others are in the folder of the header, or the file is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.waveform.companions import PLACES, companions_of


def header(path: Path, kind: str, *files: tuple[str, str]) -> Path:
    lines = []
    for folder, name in files:
        line = bytearray(b" " * 284)
        for place, text in zip(PLACES[kind], (folder, name), strict=True):
            line[place.start : place.start + len(text)] = text.encode()
        lines.append(bytes(line) + b"\n")
    path.write_bytes(b"".join(lines))
    return path


@pytest.mark.parametrize("kind", PLACES)
@pytest.mark.parametrize("here", ["", ".", "./", "-"])
def test_the_files_of_a_header_are_named_once_each(tmp_path: Path, kind: str, here: str) -> None:
    path = header(tmp_path / "a", kind, (here, "one.w"), (here, "two.w"), (here, "one.w"))
    assert companions_of(path, kind) == ("one.w", "two.w")


@pytest.mark.parametrize(("folder", "name"), [("..", "a"), ("/etc", "a"), (".", "../a"), (".", "..\\a"), (".", "..")])
def test_a_file_elsewhere_is_refused_with_its_line(tmp_path: Path, folder: str, name: str) -> None:
    path = header(tmp_path / "a", "CSS", (".", "one.w"), (folder, name))
    with pytest.raises(ReadError, match=r"a, line 2: its samples are in .* Only a file in the folder of the header"):
        companions_of(path, "CSS")


def test_css_may_be_packed(tmp_path: Path) -> None:
    path = header(tmp_path / "a", "CSS", (".", "one.w"))
    (tmp_path / "one.w.gz").touch()
    assert companions_of(path, "CSS") == ("one.w.gz",)
    (tmp_path / "one.w").touch()
    assert companions_of(path, "CSS") == ("one.w",)


def test_q_has_its_samples_by_its_own_name_and_others_have_none(tmp_path: Path) -> None:
    assert companions_of(tmp_path / "shot.QHD", "Q") == ("shot.QBN",)
    assert companions_of(tmp_path / "shot.mseed", "MSEED") == ()
