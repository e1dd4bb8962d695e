"""HBM catman: precision, clock, overflow, and files that are not whole."""

from datetime import datetime

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every

TOP = 10 * np.sin(np.arange(40) / 5)


@every(("kind", "tolerance"), [(0, 1e-12), (1, 1e-6), (2, 20 / 32767)])
def test_values_of_every_precision_are_read(written, kind, tolerance):
    recording = read(written("catman", ("top", "mm", TOP), kind=kind))
    np.testing.assert_allclose(recording.channel("top").values, TOP, atol=tolerance)
    assert recording.channel("top").unit == "mm"


def test_the_time_channel_is_the_clock_and_the_header_gives_the_date(written):
    recording = read(written("catman", ("top", "mm", TOP), kind=0))
    assert recording.channel("Zeit 1").is_clock
    np.testing.assert_allclose(recording.channel("top").time, np.arange(40) / 200)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 9)


def test_the_sign_of_an_overflow_is_missing_and_told(written):
    values = TOP.copy()
    values[[3, 7]] = -1e6
    recording = read(written("catman", ("top", "mm", values), kind=0))
    assert np.flatnonzero(np.isnan(recording.channel("top").values)).tolist() == [3, 7]
    assert recording.warnings == ('"top": 2 of 40 values are catman\'s sign of an overflow or an open input; missing',)


def test_a_file_that_ends_within_its_headers_is_refused(written):
    path = written("catman", ("top", "mm", TOP))
    path.write_bytes(path.read_bytes()[:200])
    with pytest.raises(ReadError, match='cannot be read as "catman"'):
        read(path)
