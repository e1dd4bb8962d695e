"""TDMS and MATLAB files read back as they were written, and are the same bytes every time."""

import time

import numpy as np
import pytest

from colonnade.laboratory.files import MATLAB, TDMS, Sheet
from colonnade.readers.registry import read

FORMATS = [
    pytest.param(TDMS, {}, "V", id="tdms"),
    pytest.param(MATLAB, {"time": "time"}, None, id="matlab"),
]


def sheet():
    clock = np.arange(1000) / 400.0
    columns = {"lvdt_top": ("V", np.sin(clock)), "table_acc": ("V", np.cos(3 * clock))}
    return Sheet(clock, 400.0, columns, np.datetime64("2013-05-14T09:00:00", "us"))


@pytest.mark.parametrize(("written", "options", "unit"), FORMATS)
def test_what_was_written_is_read_with_its_clock(written, options, unit, tmp_path):
    path = tmp_path / f"record{written.suffix}"
    path.write_bytes(written.content(sheet()))
    recording = read(path, {".tdms": "tdms", ".mat": "matlab"}[written.suffix], options)
    assert recording.warnings == ()
    for name, (_, values) in sheet().columns.items():
        channel = recording.channel(name)
        np.testing.assert_array_equal(channel.values, values)
        np.testing.assert_allclose(channel.time, sheet().time, atol=1e-12)
        assert channel.unit == unit
    np.testing.assert_array_equal(read(path).channel("lvdt_top").values, sheet().columns["lvdt_top"][1])


@pytest.mark.parametrize("written", [TDMS, MATLAB], ids=["tdms", "matlab"])
def test_the_same_sheet_gives_the_same_bytes_at_another_time(written, monkeypatch):
    first = written.content(sheet())
    monkeypatch.setattr(time, "asctime", lambda *_: "Thu Jan  1 00:00:00 1970")
    assert written.content(sheet()) == first
