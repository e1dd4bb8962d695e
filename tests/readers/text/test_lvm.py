"""LabVIEW measurement files: segments, clocks, and what is wrong in them."""

from datetime import datetime

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every

FILE_HEADER = """LabVIEW Measurement
Writer_Version\t2
Separator\tTab
Decimal_Separator\t{decimal}
X_Columns\t{clocks}
Date\t2013/04/26
Time\t10:15:00.5
***End_of_Header***
"""
SEGMENT = """
Channels\t2
Samples\t{samples}\t{samples}
Date\t2013/04/26\t2013/04/26
Time\t{time}\t{time}
Y_Unit_Label\tVolts\tg
X_Dimension\tTime\tTime
X0\t{x0}\t{x0}
Delta_X\t0.005\t0.005
***End_of_Header***
X_Value\ttop\ttable\tComment
"""


def segment(rows, time="10:15:01.5", x0="0.0", samples=None):
    return SEGMENT.format(samples=samples or len(rows), time=time, x0=x0) + "\n".join(rows) + "\n"


ONE, TWO = ([f"\t{row + first}\t0" for row in range(3)] for first in (0, 10))


def recorded(folder, *segments, clocks="No", decimal="."):
    path = folder / "record.lvm"
    path.write_bytes((FILE_HEADER.format(clocks=clocks, decimal=decimal) + "".join(segments)).encode("latin-1"))
    return read(path)


WHOLE = FILE_HEADER.format(clocks="No", decimal=".")


@every(
    ("text", "told"),
    [
        ("LabVIEW Measurement\n", 'the line ".*End_of_Header.*" is missing'),
        (WHOLE.replace("\t.", "\t;"), 'Decimal_Separator is ";"'),
        (WHOLE + "0\t1\n", "line 9: the header of a segment is not whole"),
        (WHOLE + "Channels\t1\n", "line 9: the header of a segment is not whole"),
        (WHOLE + SEGMENT.partition("X_Value")[0], "line 10: the header of a segment is not whole"),
        (WHOLE + segment([]), "no channel holds numbers"),
    ],
)
def test_a_file_that_ends_too_early_says_where(path, text, told):
    path.write_text(text)
    with pytest.raises(ReadError, match=told):
        read(path)


def test_a_later_header_that_is_not_whole_is_a_warning(tmp_path):
    recording = recorded(tmp_path, segment(ONE), "\nChannels\t1\n")
    told = "line 24: the header of a segment is not whole: the file was cut off or is damaged"
    assert recording.warnings == (told,)
    assert recording.channel("top").values.tolist() == [0, 1, 2]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=50, deadline=None)
@given(some.text("0123456789,\t\n*abC", max_size=60))
def test_any_text_below_a_sound_segment_leaves_that_as_it_is(tmp_path, below):
    assert recorded(tmp_path, segment(ONE), "\n" + below).channel("top").values[:3].tolist() == [0, 1, 2]


def test_without_x_columns_time_comes_from_the_header(tmp_path):
    rows = [f"\t{row}.5\t-{row}.25" for row in range(4)]
    recording = recorded(tmp_path, segment(rows, x0="1.0"))
    top, table = recording.channels
    assert (top.name, top.unit, table.name, table.unit) == ("top", "Volts", "table", "g")
    assert top.values.tolist() == [0.5, 1.5, 2.5, 3.5]
    np.testing.assert_allclose(top.time, [1.0, 1.005, 1.01, 1.015], atol=1e-12)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 2, 500000)


@every("decimal", [".", ","])
def test_the_header_decides_the_decimal_sign(tmp_path, decimal):
    rows = [f"{row * 0.005:.3f}\t{row}.125\t1.5E-1".replace(".", decimal) for row in range(3)]
    recording = recorded(tmp_path, segment(rows), clocks="One", decimal=decimal)
    assert recording.channel("top").values.tolist() == [0.125, 1.125, 2.125]
    assert recording.channel("table").values.tolist() == [0.15] * 3
    assert recording.channels[0].is_clock


def test_segments_are_joined_by_their_dates_and_times(tmp_path):
    recording = recorded(tmp_path, segment(ONE, "10:15:01.5"), segment(TWO, "10:15:03.25"))
    top = recording.channel("top")
    assert top.values.tolist() == [0, 1, 2, 10, 11, 12]
    np.testing.assert_allclose(top.time, [0, 0.005, 0.01, 1.75, 1.755, 1.76], atol=1e-9)


def test_x_values_that_go_on_are_not_shifted_by_their_segments_time(tmp_path):
    one, two = ([f"{(row + first) * 0.005:.3f}\t{row}\t0" for row in range(3)] for first in (0, 3))
    recording = recorded(tmp_path, segment(one), segment(two, "10:15:01.515"), clocks="One")
    np.testing.assert_allclose(recording.channel("top").time, 0.005 * np.arange(6), atol=1e-12)


def test_x_values_since_1904_count_from_the_first(tmp_path):
    epoch = datetime(1904, 1, 1)
    begin = (datetime(2013, 4, 26, 8, 0) - epoch).total_seconds()
    rows = [f"{begin + 0.5 * row:.3f}\t{row}\t0" for row in range(3)]
    recording = recorded(tmp_path, segment(rows), clocks="One")
    np.testing.assert_allclose(recording.channel("top").time, [0, 0.5, 1])
    assert recording.start == datetime(2013, 4, 26, 10, 15, 1, 500000)


def test_channels_of_unequal_length_keep_their_own(tmp_path):
    rows = ["\t1\t5", "\t2\t6", "\t3", "\t4"]
    recording = recorded(tmp_path, segment(rows).replace("Samples\t4\t4", "Samples\t4\t2"))
    assert recording.channel("top").values.tolist() == [1, 2, 3, 4]
    assert recording.channel("table").values.tolist() == [5, 6]
    assert recording.warnings == ()


def test_fewer_rows_than_announced_are_told(tmp_path):
    recording = recorded(tmp_path, segment(["\t1\t2", "\t3\t4"], samples=500))
    assert recording.warnings == ('the samples below line 19 end too early: the header says 500, "top" has 2',)


def test_a_cell_without_a_number_is_missing_and_told_with_its_line(tmp_path):
    rows = ["\t1\t2\tLOST COMMUNICATION", "\tOVL\t4", "\t5\t6\tOK"]
    recording = recorded(tmp_path, segment(rows))
    np.testing.assert_array_equal(recording.channel("top").values, [1, np.nan, 5])
    assert recording.warnings == ('"top": 1 cell holds no number (on line 21: "OVL"); missing',)


@every("place", ["before", "within"])
def test_notes_in_a_segments_header_are_no_damage(tmp_path, place):
    pieces = [segment(ONE, "10:15:01.5"), segment(TWO, "10:15:03.5")]
    note = "Notes\tthe prism was turned\tafter 3 s\n"
    moved = "Channels\t2\n" + note if place == "within" else note + "Channels\t2\n"
    recording = recorded(tmp_path, *(piece.replace("Channels\t2\n", moved) for piece in pieces))
    assert recording.warnings == ()
    assert recording.channel("top").values.tolist() == [0, 1, 2, 10, 11, 12]
    np.testing.assert_allclose(recording.channel("top").time, [0, 0.005, 0.01, 2, 2.005, 2.01], atol=1e-9)
