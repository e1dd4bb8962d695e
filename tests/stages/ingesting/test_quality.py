"""Quality of channels, the days of their files, and the error of a zero."""

from datetime import UTC, date, datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chain import plain_channel
from colonnade.campaign.review import Flagged, Review
from colonnade.campaign.settings import QualitySettings
from colonnade.readers.recording import Recording
from colonnade.signals.quality import Flag
from colonnade.signals.rest import RestWindow
from colonnade.stages.ingesting.columns import channel_verdicts, contradictions, recorded_at, reviewed
from colonnade.stages.ingesting.zeroing import find_zero_error, on_angle, on_base
from prism import PRISM

TIME = np.arange(0.0, 10.0, 0.01)
WAVE = np.sin(2 * np.pi * 2.0 * TIME)


def test_clipping_is_judged_by_the_recorded_range_if_it_is_given_so():
    recorded = np.clip(WAVE, -0.5, 0.5)
    channel = plain_channel("acceleration", unit="g", on="table", range_recorded=0.5, full_scale=100.0)
    verdicts = channel_verdicts(TIME, recorded, 9.80665 * recorded, channel, QualitySettings())
    assert [verdict.finding.kind for verdict in verdicts if verdict.reason] == ["end of the range"]


def test_people_flag_a_stretch_or_a_whole_channel():
    flags = (
        Flagged(channel="top", window=(1.0, 2.0), flag="suspect", reason="knocked"),
        Flagged(channel="top", window=None, flag="fail", reason="loose"),
        Flagged(channel="other", window=None, flag="fail", reason="loose"),
    )
    stretch, whole = reviewed("top", TIME, Review(flags=flags))
    assert (stretch.flag, int(stretch.where.sum())) == (Flag.SUSPECT, 101)
    assert (whole.flag, bool(whole.where.all())) == (Flag.FAIL, True)


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


def test_a_drift_is_reported_in_radians_with_a_stretch_without_it():
    lever, window = 0.4, RestWindow(0.0, 1.0, quiet=False)
    drifts = {"top": 0.002 * np.minimum(TIME, 1.0)}  # m, in the first second
    (found,) = find_zero_error(TIME, drifts, {"top": on_angle(lever, PRISM)}, window, free_vibration=False)
    error = 0.002 * 3 / 8 / lever  # from the mean of the last quarter to that of the window
    assert f"uncertain by {error:.2g} rad" in found.text
    assert 'zero = ["1' in found.text
    assert found.severity == "warning"


def test_an_accelerometer_across_the_shaking_weighs_more():
    assert on_base(0.5, PRISM).factor == 2.0
    assert on_base(1.0, PRISM).scale == PRISM.uplift_acceleration
