"""Universal files: text and binary, even and uneven, beside an independent reader."""

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every


@every("is_binary", [False, True])
def test_functions_are_read_with_name_unit_and_clock(written, is_binary):
    recording = read(written("uff", is_binary=is_binary))
    top, table = recording.channels
    assert (top.name, top.unit, table.name, table.unit) == ("top", "mm", "table", "g")
    time = np.arange(40) / 200
    np.testing.assert_allclose(top.values, 10 * np.sin(40 * time), atol=1e-11)
    np.testing.assert_allclose(table.values, 0.3 * np.cos(30 * time), atol=1e-12)
    np.testing.assert_allclose(top.time, time, atol=1e-12)


def test_an_uneven_abscissa_is_the_clock(written):
    path = written("uff", ("top", "mm", np.array([0.0, 5.0, 0.1, 6.0, 0.3, 7.0])), samples=6)
    path.write_text(path.read_text().replace(f"{6:10d}{1:10d}", f"{3:10d}{0:10d}", 1), encoding="ascii")
    top = read(path).channel("top")
    assert (top.values.tolist(), top.time.tolist()) == ([5, 6, 7], [0, 0.1, 0.3])


def test_what_is_no_function_of_time_is_left_out(written):
    path = written("uff")
    spectrum = (
        path.read_text().replace(f"{1:5d}{0:10d}{1:5d}", f"{4:5d}{0:10d}{1:5d}", 1).replace(f"{17:10d}", f"{18:10d}", 1)
    )
    units = "    -1\n   164\n         1SI: Meter (newton)         2\n    -1\n"
    path.write_text(units + spectrum, encoding="ascii")
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["table"]
    assert any('"top": not a real function of time' in note for note in recording.notes)


@every("is_binary", [False, True])
def test_numbers_that_are_cut_off_are_told(written, is_binary):
    path = written("uff", ("top", "mm", np.arange(40.0)), is_binary=is_binary)
    content = path.read_bytes()
    path.write_bytes(content[: -(8 + 80) if is_binary else -(8 + 21 * 10)])
    recording = read(path)
    assert any("should have 40 numbers" in told and "cut off" in told for told in recording.warnings)


def test_a_file_without_functions_of_time_is_refused(path):
    path.write_text("    -1\n    58\n" + "too short\n" * 3, encoding="ascii")
    with pytest.raises(ReadError, match=r"no channel holds numbers .*data set 58 at byte 7 is damaged"):
        read(path)


@every("line_end", ["\n", "\r\n"])
def test_a_universal_file_without_functions_is_refused_as_such(path, line_end):
    nodes = [f"{node:10d}{0:10d}{0:10d}{0:10d}{0.1 * node:13.5E}{0:13.5E}{0:13.5E}" for node in range(1, 40)]
    lines = ["    -1", "   151", "model", "    -1", "    -1", "    15", *nodes, "    -1", ""]
    path.write_bytes(line_end.join(lines).encode())
    with pytest.raises(ReadError, match=r"it holds data sets 151, 15, but no data set 58"):
        read(path)


def test_a_column_of_numbers_that_starts_as_a_data_set_would_stays_a_column(path):
    path.write_text("-1\n15\n" + "".join(f"{row % 7}\n" for row in range(40)))
    assert read(path).format == "delimited"


@every("encoding", ["utf-8", "cp1252"])
def test_units_may_be_written_in_utf_8(written, encoding):
    path = written("uff", ("top", "m/s2", np.arange(40.0)))
    path.write_bytes(path.read_text().replace("m/s2", "m/s²").encode(encoding))
    assert read(path).channel("top").unit == "m/s²"
