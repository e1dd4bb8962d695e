"""COSMOS records: several channels, the step in ms, and ends."""

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read


def test_channels_of_one_file_are_told_apart(written):
    recording = read(written("cosmos"))
    assert [channel.name for channel in recording.channels] == ["acceleration", "acceleration 2"]
    assert all(channel.unit == "cm/s^2" for channel in recording.channels)


def test_a_record_that_was_cut_off_says_how_many_points_are_there(written):
    path = written("cosmos", ("x", "cm/s^2", np.arange(40.0)))
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:-2]) + "\n", encoding="ascii")  # without the last row of 8 and the end mark
    recording = read(path)
    assert recording.channels[0].values.tolist() == [float(row) for row in range(32)]
    assert "gives 40 points, but the file has 32: it ends too early" in recording.warnings[0]


def test_a_header_without_a_step_is_refused(written):
    path = written("cosmos")
    path.write_text(path.read_text().replace(f"{5:15.6f}", f"{-999:15.6f}"), encoding="ascii")
    with pytest.raises(ReadError, match=r"give no time step \(value 62\)"):
        read(path)


def test_raw_counts_of_volume_0_are_refused_in_plain_words(written):
    path = written("cosmos", ("top", "cm/s^2", np.arange(40.0)))
    text = path.read_text().replace("acceleration pts", "raw accel.  counts")
    path.write_text(text.replace("cm/sec2(04),Format=(8F10.5)", "counts  (50)"), encoding="ascii")
    with pytest.raises(ReadError, match=r"holds raw counts \(V0\)\. .*download volume 1"):
        read(path)
