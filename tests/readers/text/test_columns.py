"""Timestamps are seconds from the first of them."""

from datetime import datetime, timedelta, timezone

import numpy as np
import pandas as pd

from colonnade.readers.text.columns import Timestamps, past_midnight
from every import every


def test_pieces_count_on_from_the_first_timestamp():
    column = Timestamps()
    assert column.seconds(pd.Series(["2013-04-26 10:15:00.5", "2013-04-26 10:15:01"])).tolist() == [0, 0.5]
    assert column.seconds(pd.Series(["2013-04-26 10:16:00.5"])).tolist() == [60]
    assert column.start == datetime(2013, 4, 26, 10, 15, 0, 500000)


def test_what_is_not_a_timestamp_is_missing():
    seconds = Timestamps().seconds(pd.Series(["10:15:00", "broken", "10:15:02"]))
    np.testing.assert_array_equal(seconds, [0, np.nan, 2])


def test_times_of_day_go_on_after_midnight():
    np.testing.assert_array_equal(past_midnight(np.array([86399.0, np.nan, 1.0])), [86399, np.nan, 86401])


@every(("zone", "hours"), [("Z", 0), ("+02:00", 2), ("-0330", -3.5), (" +05:45", 5.75), ("+00:00", 0)])
def test_the_first_timestamp_keeps_its_zone(zone, hours):
    column = Timestamps()
    written = [f"2013-04-26T23:15:{second}{zone}" for second in ("00.5", "01.0")]
    assert column.seconds(pd.Series(written)).tolist() == [0, 0.5]
    assert column.start == datetime(2013, 4, 26, 23, 15, 0, 500000, timezone(timedelta(hours=hours)))
    assert column.start.utcoffset() == timedelta(hours=hours)


def test_a_timestamp_without_a_zone_has_none():
    column = Timestamps()
    column.seconds(pd.Series(["26.04.2013 10:15:00"]))
    assert column.start is not None
    assert column.start.tzinfo is None
