"""C3D files of an optical system: markers, analog channels, their clocks; what was cut off."""

import numpy as np
import pytest
from ezc3d import c3d

from colonnade.campaign.draft.write import draft
from colonnade.errors import ReadError
from colonnade.readers.registry import read

TABLE = np.random.default_rng(5).random((60, 3))


@pytest.fixture
def path(tmp_path):
    """A marker that is hidden for three frames, and an analog channel at twice its rate."""
    file, points = c3d(), np.ones((4, 1, 60))
    points[:3, 0], points[:3, 0, 20:23] = TABLE.T, np.nan
    for group, rate, name, unit in (("POINT", 200.0, "m1", "mm"), ("ANALOG", 400.0, "table", "g")):
        for key, value in (("RATE", rate), ("LABELS", name), ("UNITS", unit)):
            file["parameters"][group][key]["value"] = [value]
    file["data"]["points"], file["data"]["analogs"] = points, np.repeat(TABLE[:, 1], 2)[None, None]
    file.write(str(tmp_path / "recording.c3d"))
    return tmp_path / "recording.c3d"


def test_a_marker_is_three_columns_and_missing_where_it_was_not_seen(path):
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["m1 X", "m1 Y", "m1 Z", "table"]
    for along, true in zip(recording.channels[:3], TABLE.T, strict=True):
        assert np.flatnonzero(np.isnan(along.values)).tolist() == [20, 21, 22]
        seen = np.isfinite(along.values)
        np.testing.assert_allclose(along.values[seen], true[seen], atol=1e-6)
        assert along.unit == "mm"


def test_markers_and_analog_channels_have_their_own_rates(path):
    recording = read(path)
    marker, table = recording.channels[0], recording.channels[-1]
    np.testing.assert_allclose(marker.time, np.arange(60) / 200, atol=1e-12)
    np.testing.assert_allclose(table.time, np.arange(120) / 400, atol=1e-12)
    np.testing.assert_allclose(table.values, np.repeat(TABLE[:, 1], 2), atol=1e-6)
    assert table.unit == "g"
    assert "clock of the analog channels: 400 Hz, by the rate in the file" in recording.notes


def test_a_file_that_was_cut_off_says_how_many_frames_are_there(path):
    path.write_bytes(path.read_bytes()[:-900])
    recording = read(path)
    frames = recording.channels[0].values.size
    assert 0 < frames < 60
    assert recording.warnings == (f"it ends after {frames} of 60 frames: a recording or a copy was interrupted",)


def test_a_file_without_data_is_refused(path):
    path.write_bytes(path.read_bytes()[:700])
    with pytest.raises(ReadError, match=r"it ends after 700 bytes, before its data begin at byte 1536"):
        read(path)


def test_its_markers_are_drafted(path):
    assert 'columns = ["m1 X", "m1 Y", "m1 Z"]' in draft(path.parent).text
