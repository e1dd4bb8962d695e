"""Lists of records are read as written or refused, whatever a stranger writes; what names say of components."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from colonnade.errors import ReadError
from colonnade.readers.ground_motions.files import COLUMNS, Entry, direction_of, named, read_list
from every import every

MANY = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
PARTS = [*COLUMNS, "[s]", "[", "]", "x", "../x", "/x", "1", "nan", "\0", '"', "é"]


@MANY
@given(
    st.one_of(
        st.text(max_size=200),
        st.lists(st.sampled_from(PARTS), max_size=40).map(
            lambda parts: ",".join(parts[:6]) + "\n" + ",".join(parts[6:])
        ),
    )
)
def test_whatever_is_written_is_read_or_refused(tmp_path, text):
    path = tmp_path / "list.csv"
    path.write_text(text, encoding="utf-8", errors="replace")
    try:
        entries, left_out, _ = read_list(path)
    except ReadError as refusal:
        assert "list.csv" in str(refusal)  # noqa: PT017 - either outcome is right
        return
    assert all(isinstance(each, Entry) and each.path.is_relative_to(tmp_path) for each in entries)
    assert all(each.reason for each in left_out)


@every("text", ["../a", "a/../../b", "/etc/passwd", "C:\\a", "\\\\host\\a", ".", "link/a"])
def test_a_path_stays_in_the_folder_of_the_list(tmp_path, text):
    if not (tmp_path / "link").is_symlink():
        (tmp_path / "link").symlink_to("/")
    (tmp_path / "list.csv").write_text(f"file\n{text}\na/../b\\c.csv\n")
    (entry,), (left_out,), _ = read_list(tmp_path / "list.csv")
    assert entry.path == tmp_path.resolve() / "b/c.csv"
    assert any(said in left_out.reason for said in ("outside the folder", "an absolute path", "an invalid path"))


@every(
    ("text", "message"),
    [
        ("", "the file is empty"),
        ("name,unit\na,g\n", 'no column "file"'),
        ("file,intervall\na,1\n", 'unknown column "intervall". Did you mean "interval"'),
        ("file,file\na,b\n", 'duplicate column head "file"'),
        ("file,component\na,x\n", '"component" without "record"'),
        ("\0\1\2\3file", "it is no text"),
    ],
)
def test_what_is_no_list_is_refused(path, text, message):
    path.write_text(text)
    with pytest.raises(ReadError, match=message):
        read_list(path)


def test_units_are_in_heads_or_cells_and_other_columns_are_ignored(path):
    path.write_text("file;interval;unit [g];distance;who\na;0,01 s;;12 km;me\nb;0.01;;;\n")
    (entry,), (missing,), notes = read_list(path)
    assert (entry.interval, entry.unit, entry.distance) == (0.01, "g", 12_000.0)
    assert "has no unit" in missing.reason
    assert '"who"' in notes[0]


@every(
    ("name", "record", "direction"),
    [
        ("lefkada_x.csv", "lefkada", "x"),
        ("Lefkada-NS.txt", "Lefkada", "y"),
        ("station 3 up.mseed", "station 3", "z"),
        ("RSN6_IMPVALL.I_I-ELC180.AT2", "RSN6_IMPVALL.I_I-ELC", "180"),
        ("RSN6_IMPVALL.I_I-ELC-UP.AT2", "RSN6_IMPVALL.I_I-ELC", "z"),
        ("AOM0011903.UD", "AOM0011903", "z"),
        ("AOMH0119.NS2", "AOMH01192", "y"),
        ("GR.KRP.HNE.sac", "GR.KRP.HN", "x"),
        ("GR.KRP.HNZ.D.2014.sac", "GR.KRP.HN.D.2014", "z"),
        ("pulse-180.csv", "pulse-180", ""),
        ("athens.csv", "athens", ""),
        ("ACHE.csv", "ACHE", ""),
        ("record", "record", ""),
        ("north.csv", "north", "y"),
    ],
)
def test_a_file_says_its_record_and_direction(name, record, direction):
    assert named(name) == (record, direction)


@every(
    ("head", "direction"),
    [("NS [cm/s^2]", "y"), ("acc x (g)", "x"), ("HNZ", "z"), ("Acceleration", ""), ("U-D", "z"), ("exx", "")],
)
def test_a_column_says_its_direction(head, direction):
    assert direction_of(head).direction == direction
