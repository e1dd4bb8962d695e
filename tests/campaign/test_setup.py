"""Setups: recorders with their clocks, options of file formats, angles in SI."""

from math import radians

import pytest
from pydantic import ValidationError

from colonnade.campaign.setup import Align, FileOptions, Setup
from colonnade.errors import CampaignError
from every import every

CHANNELS = {"top": {"column": 1, "quantity": "other"}, "second": {"column": 1, "quantity": "other", "recorder": "daq2"}}


def setup(**keys):
    return Setup.model_validate({"channels": CHANNELS} | keys)


def problems(**keys):
    """Places below the setup, and the error at each."""
    with pytest.raises(ValidationError) as caught:
        setup(**keys)
    return {
        ".".join(map(str, error["loc"])): error["msg"].removeprefix("Value error, ") for error in caught.value.errors()
    }


def test_the_main_recorder_is_the_setups_own_and_comes_first():
    found = setup(
        file={"format": "delimited", "delimiter": ";"},
        sampling_rate="200 Hz",
        recorders={"daq2": {"sampling_rate": "0.5 kHz"}, "daq1": {}},
    ).recorders
    assert list(found) == ["main", "daq2", "daq1"]
    assert found["main"].file == FileOptions(format="delimited", options={"delimiter": ";"})
    assert [recorder.sampling_rate for recorder in found.values()] == [200.0, 500.0, None]


def test_a_setup_without_channels_is_refused():
    assert "channels" in problems(channels={})


@every(
    ("written", "clock"),
    [("trigger", "trigger"), ({"align": ["top", "second"]}, Align(align=("top", "second")))],
)
def test_a_clock_starts_with_the_main_one_or_is_linked_to_it(written, clock):
    assert setup(recorders={"daq2": {"clock": written}}).recorders["daq2"].clock == clock


@every(
    ("clock", "place", "words"),
    [
        ("Trigger", "", 'was found. Expected: "trigger" if it starts with the main recorder'),
        (3, "", 'was found. Expected: "trigger" if it starts with the main recorder'),
        ({}, ".align", "It is missing. Expected: a channel of the main recorder"),
        ({"align": ["top"]}, ".align", "A list of more values was expected: a channel of the main recorder"),
        ({"align": ["top", 2]}, ".align.1", "Text in quotes was expected"),
        ({"align": "top"}, ".align", "A list was expected"),
        ({"align": ["a", "b"], "by": 1}, ".by", "Unknown key."),
    ],
)
def test_what_is_no_clock_is_refused_with_what_was_expected(clock, place, words):
    assert words in problems(recorders={"daq2": {"clock": clock}})[f"recorders.daq2.clock{place}"]


def test_angles_are_taken_to_radians_and_a_catch_is_positive():
    found = setup(catch="12 deg", table_tilt="-0.1 deg")
    assert found.catch == pytest.approx(radians(12.0), rel=1e-14)
    assert found.table_tilt == pytest.approx(radians(-0.1), rel=1e-14)
    assert "catch" in problems(catch="-0.3 rad")
    assert "catch" in problems(catch="0 rad")


MISTYPED = {"format": "delimited", "delimeter": ";"}


@every(
    ("file", "place", "told"),
    [
        ("a.csv", "file", '"a.csv" was found. A table was expected'),
        ({"format": "delimted"}, "file.format", 'Unknown format "delimted". Did you mean "delimited"?'),
        ({"format": 3}, "file.format", "Unknown format 3."),
        (MISTYPED, "file.delimeter", 'Unknown option of format "delimited". Did you mean "delimiter"?'),
        ({"delimeter": ";"}, "file.delimeter", 'Unknown option of format "'),
        ({"format": "delimited", "decimal": 3}, "file.decimal", "3 was found: "),
    ],
)
def test_a_wrong_option_of_a_file_is_told_at_its_key(file, place, told):
    found = problems(file=file)
    assert list(found) == [place]
    assert found[place].startswith(told)


def test_all_wrong_options_are_told_together():
    found = problems(file=MISTYPED | {"decimal": 3})
    assert set(found) == {"file.delimeter", "file.decimal"}


def test_a_campaign_about_a_real_column_alone_needs_no_setup(load_text):
    only = """schema = 1
    campaign = "column"
    title = "The column at the site"
    [specimens]
    column = {shape = "cylinder", diameter = "0.95 m", height = "5.7 m", mass = "10.5 t"}
    """
    assert load_text(only).setups == {}
    asked = '[prototype.column]\nrestitution = 0.94\n[assessments.site]\nspecimen = "column"\nrecords = "records"\n'
    assert load_text(only + asked).warnings == ()
    with pytest.raises(CampaignError, match="setup"):
        load_text(only + '[[tests]]\nid = "a"\nkind = "sine"\nspecimen = "column"\nsetup = "frame"\nfile = "a.csv"\n')
