"""Segments of a LabVIEW file: headers, rows, and what lies between them."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.text.lines.numbered import NumberedLines
from colonnade.readers.text.lvm_segments import Segment, read_preamble, read_segments

PREAMBLE = "LabVIEW Measurement\nSeparator\tTab\nDecimal_Separator\t,\nX_Columns\tMulti\n***End_of_Header***\n\n"
HEAD = "Channels\t1\nSamples\t2\nY_Unit_Label\tmm\n***End_of_Header***\nX_Value\ttop\tComment\n"


def segments(path: Path, text: str) -> tuple[list[Segment], list[str]]:
    path.write_text(text, encoding="utf-8")
    with NumberedLines(path) as lines:
        return read_segments(path, lines, read_preamble(path, lines))


def test_the_preamble_says_how_numbers_are_written(tmp_path: Path) -> None:
    path = tmp_path / "a.lvm"
    path.write_text(PREAMBLE.replace("Tab", "Semicolon").replace("\t", ";"), encoding="utf-8")
    with NumberedLines(path) as lines:
        preamble = read_preamble(path, lines)
    assert (preamble.dialect.delimiter, preamble.dialect.decimal, preamble.clocks) == (";", ",", "multi")


def test_each_header_begins_a_segment_and_rows_below_a_blank_line_another_of_the_same(tmp_path: Path) -> None:
    rows = "0\t1,5\n1\t2,5\n"
    found, warnings = segments(tmp_path / "a.lvm", PREAMBLE + HEAD + rows + "\n" + rows + "\n" + HEAD + rows)
    assert warnings == []
    assert [segment.names for segment in found] == [("X_Value", "top")] * 3
    assert [segment.columns[1].tolist() for segment in found] == [[1.5, 2.5]] * 3
    assert found[0].entries is found[1].entries
    assert (found[0].entry("Y_Unit_Label", 1), found[0].entry("Y_Unit_Label", 9), found[0].entry("x", 0)) == (
        "mm",
        "",
        "",
    )


def test_a_special_block_is_passed_over(tmp_path: Path) -> None:
    block = "***Start_Special***\nPacket\tx\n***End_Special***\n"
    (found,), warnings = segments(tmp_path / "a.lvm", PREAMBLE + HEAD + "0\t1\n" + block + "1\t2\n")
    assert found.columns[1].tolist() == [1, 2]
    assert warnings == []


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("LabVIEW Measurement\n", 'the line ".*End_of_Header.*" is missing'),
        (PREAMBLE.replace("\t,", "\t;"), 'Decimal_Separator is ";"'),
        (PREAMBLE + "0\t1\n", '"Channels" was expected, the start of a segment'),
        (PREAMBLE + "Channels\t1\n", "ends within its header"),
        (PREAMBLE + HEAD.partition("X_Value")[0], "the names of the columns were expected"),
    ],
    ids=["preamble", "decimal sign", "no header", "header", "names"],
)
def test_a_file_that_ends_too_early_says_where(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(ReadError, match=told):
        segments(tmp_path / "a.lvm", text)


def test_a_later_header_that_is_not_whole_is_a_warning(tmp_path: Path) -> None:
    found, warnings = segments(tmp_path / "a.lvm", PREAMBLE + HEAD + "0\t1\n\nChannels\t1\n")
    assert len(found) == 1
    assert warnings == ["the segment that starts on line 14 ends within its header: the file was cut off"]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=50, deadline=None)
@given(some.text("0123456789,\t\n*abC", max_size=60))
def test_any_text_below_a_sound_segment_leaves_that_as_it_is(tmp_path: Path, below: str) -> None:
    found, _ = segments(tmp_path / "a.lvm", PREAMBLE + HEAD + "0\t1\n1\t2\n\n" + below)
    assert found[0].columns[1].tolist() == [1, 2]
