"""Damaged files that once ended in something else than a recording or a refusal, or that lost channels in silence."""

import re
import struct
import subprocess
import sys

import h5py
import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.registry import read
from every import every
from workbooks import xls

TIME = np.arange(60) * 0.01


def test_a_damaged_class_of_a_dimension_scale_does_not_end_the_process(path):
    """HDF5's own question whether a dataset is a scale frees memory twice; so it is read in a process of its own."""
    with h5py.File(path, "w") as file:
        file.create_dataset("time", data=TIME).make_scale("time")
        file.create_dataset("top", data=TIME).dims[0].attach_scale(file["time"])
    path.write_bytes(path.read_bytes().replace(b"DIMENSION_SCALE", b"DiMENSION_SCALE"))
    reading = "import sys; from colonnade.readers.registry import formats, read; read(sys.argv[1])"
    told = subprocess.run([sys.executable, "-c", reading, str(path)], capture_output=True, text=True)
    assert told.returncode == 0, told.stderr


@every("block", [b"|Cb,", b"|CC,"])
def test_a_channel_without_its_last_blocks_is_told(written, block):
    path = written("famos")
    content = path.read_bytes()
    path.write_bytes(content[: content.rindex(block)])
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["top"]
    assert "was cut off" in " ".join(recording.warnings)


def test_a_file_that_ends_within_the_first_line_of_a_channel_says_so(written):
    path = written("cosmos")
    content = path.read_bytes()
    path.write_bytes(content[: content.rindex(b"Corrected acceleration") + 40])
    recording = read(path)
    assert len(recording.channels) == 1
    assert "cut off" in " ".join(recording.warnings)


@every("count", [r"(follow on\s+)\d+(\s+lines)", r"(with\s+)\d+(\s+text lines)"])
def test_a_number_in_a_header_that_is_none_is_a_refusal(written, count):
    path = written("cosmos")
    text, changed = re.subn(count, rf"\g<1>{'9' * 20}\g<2>", path.read_text(encoding="ascii"))
    assert changed
    path.write_text(text, encoding="ascii")
    with pytest.raises(ReadError, match=path.name):
        read(path, "cosmos")


@every(("step", "begin"), [(np.inf, 0.0), (1e308, 0.0), (0.005, np.inf), (np.nan, 0.0)])
def test_a_damaged_step_gives_no_infinite_times(step, begin):
    assert np.isnan(even_times(4, step, begin)).all()


def test_a_segment_without_rows_adds_nothing(written):
    path = written("lvm")
    text = path.read_bytes()
    head = text[text.index(b"Channels") : text.index(b"Comment") + len(b"Comment\r\n")]
    path.write_bytes(text + head)
    assert {channel.values.size for channel in read(path).channels} == {40}


def xls_with(path, record, changed):
    """A workbook of 30 rows and 2 columns, with a record of its bytes changed."""
    # The second column holds no fractions of a hundred, which are stored otherwise.
    xls(path, [[row * 0.01, row / 7 + 0.1] for row in range(30)])
    assert {channel.values.size for channel in read(path).channels} == {30}
    content = path.read_bytes()
    assert content.count(record) == 1
    path.write_bytes(content.replace(record, changed))
    return path


DIMENSIONS = struct.pack("<2H2I2H", 0x200, 14, 0, 30, 0, 2)
LAST_CELL = struct.pack("<2H2H", 0x203, 14, 29, 1)


def test_an_old_workbook_of_more_rows_than_memory_fails_alone_and_says_why(tmp_path):
    path = xls_with(tmp_path / "a.xls", DIMENSIONS, struct.pack("<2H2I2H", 0x200, 14, 0, 1 << 31, 0, 2))
    with pytest.raises(ReadError, match=r"crashed the library that does it.* a cell far outside its table"):
        read(path)


@every(("row", "column"), [(29, 40_000), (3000, 20)])
def test_a_stray_cell_of_an_old_workbook_leaves_the_others_as_they_are(tmp_path, row, column):
    path = xls_with(tmp_path / "a.xls", LAST_CELL, struct.pack("<2H2H", 0x203, 14, row, column))
    times = read(path).channels[0].values
    np.testing.assert_allclose(times[:29], 0.01 * np.arange(29))


def test_a_header_in_an_encoding_that_there_is_not_is_refused(path):
    path.write_bytes(b'<?xml version="1.0" encoding="UTF-6"?><usi:tdm xmlns:usi="http://www.ni.com/Schemas/USI/1_0"/>')
    with pytest.raises(ReadError, match="unknown encoding"):
        read(path)
