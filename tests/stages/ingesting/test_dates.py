"""When a test was recorded, and whether the file's day is that of the campaign file."""

from __future__ import annotations

from datetime import UTC, date, datetime, timedelta, timezone
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.readers.recording import Recording
from colonnade.stages.ingesting.dates import contradictions, recorded_at

ATHENS = timezone(timedelta(hours=3))
TEN = datetime(2013, 4, 26, 10, 15, 0)


def recorded(*starts):
    return {f"daq{number}": Recording(Path(f"{number}.csv"), "any", (), start) for number, start in enumerate(starts)}


@pytest.mark.parametrize(
    ("start", "written"),
    [
        (TEN, "2013-04-26 10:15:00, no time zone recorded"),
        (TEN.replace(tzinfo=ATHENS), "2013-04-26 10:15:00+03:00"),
        (TEN.replace(tzinfo=UTC, microsecond=125_000), "2013-04-26 10:15:00.125+00:00"),
    ],
)
def test_the_time_is_written_in_its_zone_or_without_one_says_so(start, written):
    assert recorded_at(recorded(None, start)) == written


def test_a_file_without_a_date_says_nothing():
    assert recorded_at(recorded(None)) == ""
    assert contradictions(recorded(None), date(2013, 4, 26)) == []


def test_a_file_of_another_day_is_a_warning_with_both_dates():
    (found,) = contradictions(recorded(TEN, TEN + timedelta(days=3)), date(2013, 4, 26))
    assert (found.kind, found.severity) == ("date", "warning")
    assert "1.csv was recorded on 2013-04-29" in found.text
    assert "gives the date 2013-04-26" in found.text


def test_without_a_date_in_the_campaign_file_nothing_contradicts():
    assert contradictions(recorded(TEN), None) == []


@given(st.datetimes(datetime(1990, 1, 1), datetime(2090, 1, 1)), st.integers(-12, 14))
def test_no_laboratory_on_earth_is_warned_of_a_file_in_utc_of_its_own_day(wall, hours):
    start = wall.replace(tzinfo=timezone(timedelta(hours=hours))).astimezone(UTC)
    assert contradictions(recorded(start), wall.date()) == []


@given(
    st.datetimes(datetime(1990, 1, 1), datetime(2090, 1, 1)),
    st.none() | st.integers(-12, 14).filter(bool).map(lambda hours: timezone(timedelta(hours=hours))),
    st.integers(-400, 400),
)
def test_any_other_clock_is_taken_at_its_word(wall, zone, days):
    found = contradictions(recorded(wall.replace(tzinfo=zone)), wall.date() + timedelta(days=days))
    assert bool(found) == (days != 0)


@pytest.mark.parametrize("start", [datetime.min, datetime.max])
def test_the_ends_of_the_calendar_are_dates_too(start):
    assert contradictions(recorded(start.replace(tzinfo=UTC)), start.date()) == []
    assert recorded_at(recorded(start))


def test_a_test_late_in_a_long_file_has_its_own_time():
    night = datetime(2013, 4, 25, 23, 30, 0)
    assert recorded_at(recorded(night), 3600.0) == "2013-04-26 00:30:00, no time zone recorded"
    assert contradictions(recorded(night), date(2013, 4, 26), 3600.0) == []
    assert len(contradictions(recorded(night), date(2013, 4, 25), 3600.0)) == 1
