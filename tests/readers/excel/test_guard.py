"""A workbook's archive is read to its end before anything of it is taken."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.excel.guard import check

SHEET = "xl/worksheets/sheet1.xml"


def archive(path: Path, content: bytes) -> Path:
    with zipfile.ZipFile(path, "w") as file:
        file.writestr(SHEET, content)
    return path


def test_a_sheet_whose_cells_are_close_together_passes(tmp_path: Path) -> None:
    check(archive(tmp_path / "a.xlsx", b'<c r="A1"/><c r="B2"/>'))


def test_a_changed_byte_is_found_by_the_check_sum(tmp_path: Path) -> None:
    path = archive(tmp_path / "a.xlsx", b'<c r="A1"><v>1.25</v></c>')
    path.write_bytes(path.read_bytes().replace(b"1.25", b"1.35"))
    with pytest.raises(ReadError, match=r"it is incomplete .*CRC"):
        check(path)


def test_a_stray_cell_is_named_with_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match=r"has 2 filled cells within 17179869184.*Delete the stray cells"):
        check(archive(tmp_path / "a.xlsx", b'<c r="A1"/><c r="XFD1048576"/>'))
