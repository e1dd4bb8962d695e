"""Lists of records: what is written is what is read, and whatever a stranger writes is read or refused."""

import csv
import io
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from colonnade.errors import ReadError
from colonnade.readers.ground_motions.listed import COLUMNS, Entry, inside, read_list
from every import every

MANY = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
PARTS = [*COLUMNS, "[s]", "[", "]", "x", "../x", "/x", "1", "nan", "\0", '"', "é"]
FIGURES = st.floats(1e-3, 1e3).map(lambda value: float(f"{value:.6g}"))
WORDS = st.text("abcXYZ αé;,\"'._-0123", min_size=1, max_size=12).map(str.strip).filter(lambda text: text[:1].isalpha())


@MANY
@given(
    st.lists(
        st.tuples(
            WORDS, st.sampled_from(["", "g", "cm/s^2"]), FIGURES, FIGURES, st.sampled_from("xyz"), WORDS, FIGURES
        ),
        min_size=1,
        max_size=5,
    ),
    st.sampled_from(",\t"),
)
def test_what_is_written_is_read(tmp_path, rows, delimiter):
    stream = io.StringIO()
    writer = csv.writer(stream, delimiter=delimiter, lineterminator="\n")
    writer.writerow(["file", "unit", "interval [s]", "Scale", "component", "record", "distance [km]"])
    writer.writerows(rows)
    path = tmp_path / "list.csv"
    path.write_text(stream.getvalue(), encoding="utf-8")
    entries, left_out, notes = read_list(path)
    assert left_out == notes == []
    for entry, (file, unit, interval, scale, component, record, distance) in zip(entries, rows, strict=True):
        assert entry.path == tmp_path / file
        assert (entry.unit or "", entry.component, entry.record) == (unit, component, record)
        assert (entry.interval, entry.scale) == (interval, scale)
        assert entry.distance == pytest.approx(1000.0 * distance)


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


@pytest.mark.parametrize(
    "text", ["../a", "a/../../b", "/etc/passwd", "C:\\a", "\\\\host\\a", "", ".", "a\0b", "link/a"]
)
def test_a_path_stays_in_the_folder_of_the_list(tmp_path, text):
    folder = (tmp_path / "folder").resolve()
    folder.mkdir()
    (folder / "link").symlink_to(tmp_path)
    with pytest.raises(ReadError, match=r"outside the folder|an absolute path|an invalid path"):
        inside(folder, text)


def test_a_path_in_the_folder_is_found(tmp_path):
    assert inside(tmp_path, "a/../b\\c.csv") == Path(tmp_path, "b/c.csv")


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
def test_what_is_no_list_is_refused(tmp_path, text, message):
    path = tmp_path / "list.csv"
    path.write_text(text)
    with pytest.raises(ReadError, match=message):
        read_list(path)


def test_units_are_in_heads_or_cells_and_other_columns_are_ignored(tmp_path):
    path = tmp_path / "list.csv"
    path.write_text("file;interval;unit [g];distance;who\na;0,01 s;;12 km;me\nb;0.01;;;\n")
    (entry,), (missing,), notes = read_list(path)
    assert (entry.interval, entry.unit, entry.distance) == (0.01, "g", 12_000.0)
    assert "has no unit" in missing.reason
    assert '"who"' in notes[0]
