"""The column of a raw file that a channel is: its times, what its unit says, and where its samples go."""

from datetime import UTC, date, datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chain import plain_channel
from colonnade.campaign.review import Flagged, Review
from colonnade.campaign.settings import QualitySettings
from colonnade.errors import ReadError, StageError
from colonnade.findings import Severity
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.signals.quality import Flag
from colonnade.signals.rest import RestWindow
from colonnade.signals.timing import Clock
from colonnade.stages.ingesting.columns import (
    channel_verdicts,
    contradictions,
    dimension_of,
    find_column,
    recorded_at,
    reviewed,
    rounding,
    too_short,
    unit_findings,
    within,
)
from colonnade.stages.ingesting.zeroing import find_zero_error, on_angle, on_base
from every import every
from prism import PRISM

VALUES = np.array([4.0, 5.0, 6.0])
FILE_TIME = np.array([0.0, 0.5, 1.0])
RECORDING = Recording(
    Path("raw/free-01.csv"),
    "delimited",
    (
        RecordedChannel("Seconds", "s", np.array([10.0, 10.1, 10.2])),
        RecordedChannel("Timed", "mm", VALUES, FILE_TIME, "Timed [mm]"),
        RecordedChannel("Untimed", "mm", VALUES),
    ),
)


def channel(**changes):
    return plain_channel("displacement", **{"column": "Timed", "unit": "mm", "factor": 1e-3} | changes)


def test_a_column_has_the_clock_of_its_file():
    assert find_column(RECORDING, "top", channel(), None) is RECORDING.channels[1]


@every("column", ["Timed", "Untimed"])
def test_a_sampling_rate_counts_the_samples_from_zero_even_beside_a_clock(column):
    found = find_column(RECORDING, "top", channel(column=column), 200.0)
    np.testing.assert_array_equal(found.time, [0.0, 0.005, 0.01])
    np.testing.assert_array_equal(found.values, VALUES)
    assert (found.name, found.unit) == (column, "mm")


def test_a_rate_leaves_the_heading_as_written():
    assert find_column(RECORDING, "top", channel(), 200.0).heading == "Timed [mm]"


@every("rate", [None, 200.0])
def test_a_time_column_of_the_channel_comes_before_all_other_clocks(rate):
    found = find_column(RECORDING, "top", channel(time="Seconds"), rate)
    np.testing.assert_array_equal(found.time, [10.0, 10.1, 10.2])
    np.testing.assert_array_equal(found.values, VALUES)


def test_without_any_clock_the_message_gives_channel_file_and_both_remedies():
    with pytest.raises(StageError) as refusal:
        find_column(RECORDING, "top", channel(column="Untimed"), None)
    for words in ("channel top: free-01.csv", 'sampling_rate = "200 Hz"', "`time`"):
        assert words in str(refusal.value)


@pytest.mark.parametrize("changes", [{"column": "Tined"}, {"time": "Tined"}])
def test_a_column_that_is_not_in_the_file_is_told_with_the_nearest(changes):
    with pytest.raises(ReadError, match=r'no column is called "Tined".*Did you mean "Timed'):
        find_column(RECORDING, "top", channel(**changes), None)


@every(("of_file", "of_campaign"), [(" mm ", "mm"), ("g's", "g"), (None, "mm"), ("mm", None), (None, None)])
def test_units_that_agree_or_are_not_given_are_not_told(of_file, of_campaign):
    column = RecordedChannel("Top", of_file, VALUES)
    assert unit_findings(RECORDING, column, "top", channel(unit=of_campaign)) == []


def test_a_letter_that_the_campaign_file_takes_for_a_label_is_not_told():
    lettered = RecordedChannel("Acc", "V", VALUES, heading="Acc (V)")
    assert unit_findings(RECORDING, lettered, "top", channel(unit="g")) == []
    assert unit_findings(RECORDING, lettered, "top", channel(unit="mV", gain="1 g/V")) != []
    bracketed = RecordedChannel("Acc", "V", VALUES, heading="Acc [V]")
    assert unit_findings(RECORDING, bracketed, "top", channel(unit="g")) != []


@every(("of_file", "of_campaign"), [("cm", "mm"), ("mV", "V"), ("g", "m/s^2")])
def test_units_that_differ_are_serious_and_both_are_shown(of_file, of_campaign):
    expected = "channel top: free-01.csv", f'"{of_file}"', f'"{of_campaign}"', '"Top left"'
    assert_unit_finding(Severity.SERIOUS, expected, of_file, unit=of_campaign)


def assert_unit_finding(severity, words, of_file, **of_campaign):
    column = RecordedChannel("Top", of_file, VALUES, heading="Top left")
    (finding,) = unit_findings(RECORDING, column, "top", channel(**of_campaign))
    assert (finding.kind, finding.severity) == ("unit", severity)
    assert [each for each in words if each not in finding.text] == []


@every("own", ["counts", "LSB", "Einheiten", "1"])
def test_a_recorders_own_unit_is_noted_where_the_campaign_file_explains_it(own):
    expected = f'"{own}"', '"Top left"', "unit (V) and gain (10 mm/V) were used"
    assert_unit_finding(Severity.NOTE, expected, own, unit="V", gain="10 mm/V")


def test_counts_taken_for_millimetres_and_another_known_unit_stay_serious():
    assert_unit_finding(Severity.SERIOUS, (), "counts", unit="mm")
    assert_unit_finding(Severity.SERIOUS, (), "mV", unit="V", gain="10 mm/V")


def test_a_window_takes_its_edges_and_leaves_out_what_has_no_time():
    time = np.array([0.0, 1.0, np.nan, 2.0, 3.0])
    found = within(RecordedChannel("Top", None, np.arange(5.0), time), (1.0, 2.0))
    np.testing.assert_array_equal(found, [[1.0, 2.0], [1.0, 3.0]])


def test_without_a_window_everything_belongs_to_the_test():
    time, values = within(RECORDING.channels[1], None)
    assert time is FILE_TIME
    assert values is VALUES


@every(("window", "words"), [(None, "; at least"), ((2.0, 2.5), " between 2 and 2.5 s; at")])
def test_too_few_samples_are_told_with_the_window_that_cut_them(window, words):
    error = too_short("top", 1, window)
    assert isinstance(error, StageError)
    assert f"channel top has 1 sample{words}" in str(error)


@pytest.mark.parametrize(("resolution", "is_warned"), [(0.0, False), (0.0005, False), (0.00051, True), (0.001, True)])
def test_rounded_times_are_noted_above_the_share_of_an_interval(resolution, is_warned):
    findings = rounding(RECORDING, Clock(FILE_TIME, 0.005, resolution), jitter=0.1)
    assert bool(findings) is is_warned
    if is_warned:
        assert (findings[0].kind, findings[0].severity) == ("rounded times", Severity.NOTE)
        assert f"rounded to {1e3 * resolution:g} ms; an even clock of 200 Hz" in findings[0].text


def test_a_clock_without_an_interval_is_not_called_rounded():
    assert rounding(RECORDING, Clock(FILE_TIME, float("nan"), 0.001), jitter=0.1) == []


def test_a_channel_is_on_the_clock_of_its_recorder_or_its_own():
    changes = {}, {"recorder": "daq-2"}, {"time": "Seconds"}, {"recorder": "daq-2", "time": "Seconds"}
    found = [dimension_of({}, FILE_TIME, "top-left", channel(**each)) for each in changes]
    assert found == ["elapsed", "elapsed_daq_2", "elapsed_top_left", "elapsed_top_left"]


HOLED = np.array([0.0, np.nan, 1.0])


@every(
    ("known", "time", "dimension"),
    [
        (FILE_TIME.copy(), FILE_TIME, "elapsed"),
        (FILE_TIME + 1e-9, FILE_TIME, "elapsed_top"),
        (FILE_TIME[:-1], FILE_TIME, "elapsed_top"),
        (HOLED, FILE_TIME, "elapsed_top"),
        (HOLED.copy(), HOLED, "elapsed"),
    ],
)
def test_channels_share_a_dimension_only_with_the_same_times(known, time, dimension):
    assert dimension_of({"elapsed": known}, time, "top", channel()) == dimension


def test_a_dimension_that_is_taken_by_other_times_is_never_given_twice():
    known = {"elapsed": FILE_TIME + 1, "elapsed_top": FILE_TIME + 2}
    assert dimension_of(known, FILE_TIME, "top", channel()) not in known


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
