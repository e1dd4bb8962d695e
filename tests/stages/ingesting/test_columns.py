"""The column of a raw file that a channel is: its times, what its unit says, and where its samples go."""

from pathlib import Path

import numpy as np
import pytest

from chain import plain_channel
from colonnade.errors import ReadError, StageError
from colonnade.findings import Severity
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.signals.timing import Clock
from colonnade.stages.ingesting.columns import dimension_of, find_column, rounding, too_short, unit_findings, within
from every import every

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
