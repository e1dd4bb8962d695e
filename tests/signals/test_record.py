import numpy as np
import pytest

from colonnade.signals.quality import Flag
from colonnade.signals.record import even_record, on_clock, smoothed

TIME = np.arange(0, 4, 0.002)
GOOD = np.full(TIME.size, Flag.GOOD, dtype=np.int8)


def _brought(record, clock, cutoff=40.0):
    return on_clock(record, smoothed(record, cutoff, 4)[0], clock)


def test_what_lies_above_the_cut_off_does_not_come_back_at_a_lower_rate():
    time, clock = np.arange(0, 12, 0.001), np.arange(0.5, 11.5, 0.005)
    values = np.sin(2 * np.pi * time) + 0.1 * np.sin(2 * np.pi * 190 * time)
    record = even_record(time, values, np.full(time.size, Flag.GOOD, dtype=np.int8))
    brought, _ = _brought(record, clock)
    assert np.sqrt(np.mean((brought - np.sin(2 * np.pi * clock)) ** 2)) < 1e-4


@pytest.mark.parametrize(
    ("stamps", "values", "words"),
    [
        (TIME, np.full(TIME.size, np.nan), "no usable sample among its 2000"),
        (np.where(TIME < 2, TIME, TIME + 1e6), TIME, r"2000 samples at 500 Hz over 1e\+06 s"),
    ],
    ids=["nothing recorded", "times too far apart"],
)
def test_a_record_without_use_is_refused(stamps, values, words):
    with pytest.raises(ValueError, match=words):
        even_record(stamps, values, GOOD)
