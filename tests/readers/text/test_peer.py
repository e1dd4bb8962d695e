"""Records of PEER, with units as the networks spell them."""

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.motion import read_motion
from colonnade.readers.registry import read
from colonnade.readers.text.peer import spelled
from every import every


@every(
    ("written", "usual"),
    [("CM/S/S", "cm/s^2"), ("cm/sec", "cm/s"), ("G", "g"), ("g/10", "g/10"), ("Furlong", "furlong")],
)
def test_a_unit_is_spelled_as_usual(written, usual):
    assert spelled(written) == usual


VALUES = [0.00123, -0.0456, 0.0789, -0.1, 0.2, 0.0]


def record(tmp_path, sizes, quantity="ACCELERATION TIME SERIES IN UNITS OF G"):
    head = ["PEER NGA STRONG MOTION DATABASE RECORD", "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180"]
    rows = ["".join(f"{value:15.7E}" for value in VALUES[:5]), f"{VALUES[5]:15.7E}"]
    path = tmp_path / "RSN6_IMPVALL.I_I-ELC180.AT2"
    path.write_text("\n".join([*head, quantity, sizes, *rows, ""]), encoding="ascii")
    return path


@every(
    "sizes",
    [
        "NPTS=  6, DT= .01000 SEC",
        "NPTS=      6, DT=   .0100 SEC,",
        "6    0.0100    NPTS, DT",
        "NPTS=6, DT= 1.0E-02 SEC",
    ],
)
def test_every_spelling_of_points_and_step_is_read(tmp_path, sizes):
    recording = read(record(tmp_path, sizes))
    (channel,) = recording.channels
    assert recording.format == "peer"
    assert (channel.name, channel.unit) == ("acceleration", "g")
    np.testing.assert_allclose(channel.values, VALUES)
    np.testing.assert_allclose(channel.time, 0.01 * np.arange(6))
    assert recording.warnings == ()


@every(
    ("told", "name", "unit"),
    [
        ("VELOCITY TIME SERIES IN UNITS OF CM/S", "velocity", "cm/s"),
        ("VELOCITY TIME HISTORY IN UNITS OF CM/SEC", "velocity", "cm/s"),
        ("DISPLACEMENT TIME SERIES IN UNITS OF CM", "displacement", "cm"),
        ("ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz", "acceleration", "g"),
        ("ACCELERATION IN UNITS OF CM/SEC/SEC", "acceleration", "cm/s^2"),
    ],
)
def test_quantity_and_unit_are_those_of_the_header(tmp_path, told, name, unit):
    (channel,) = read(record(tmp_path, "NPTS= 6, DT= .01 SEC", told)).channels
    assert (channel.name, channel.unit) == (name, unit)


def test_fields_that_touch_are_told_apart_by_their_signs(tmp_path):
    path = record(tmp_path, "NPTS= 6, DT= .01 SEC")
    path.write_text(path.read_text().replace(" -", "-"), encoding="ascii")
    np.testing.assert_allclose(read(path).channels[0].values, VALUES)


def test_a_record_that_was_cut_off_says_how_many_points_are_there(tmp_path):
    path = record(tmp_path, "NPTS=  2999, DT= .01000 SEC")
    assert read(path).warnings == ("the header gives 2999 points, but the file has 6: it ends too early",)
    with pytest.warns(UserWarning, match="gives 2999 points, but the file has 6"):
        assert read_motion(path).acceleration.size == 6


def test_what_is_no_number_is_missing_and_told_with_its_line(tmp_path):
    path = record(tmp_path, "NPTS= 6, DT= .01 SEC")
    path.write_text(path.read_text().replace("7.8900000E-02", "7.89####E-02"), encoding="ascii")
    recording = read(path)
    assert np.isnan(recording.channels[0].values).sum() == 1
    assert "line 5" in recording.warnings[0]
    with pytest.raises(ReadError, match="accelerations are missing"), pytest.warns(UserWarning, match="line 5"):
        read_motion(path)


def test_a_velocity_is_no_base_acceleration(tmp_path):
    with pytest.raises(ReadError, match="unit of a velocity"):
        read_motion(record(tmp_path, "NPTS= 6, DT= .01 SEC", "VELOCITY TIME SERIES IN UNITS OF CM/S"))


def test_a_step_of_zero_is_refused(tmp_path):
    with pytest.raises(ReadError, match="time step of 0 s"):
        read(record(tmp_path, "NPTS= 6, DT= .0000 SEC"))
