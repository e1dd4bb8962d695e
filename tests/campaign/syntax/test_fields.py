"""The kinds of value of a campaign file: what becomes which SI value, and what is said of what does not."""

import math
import re
import tomllib
from copy import deepcopy
from datetime import date, datetime, time, timedelta, timezone
from typing import Annotated, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import Field, ValidationError, create_model

from colonnade.campaign import load
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.document import toml_value
from colonnade.campaign.syntax.fields import day
from colonnade.campaign.syntax.table import Table
from colonnade.errors import CampaignError
from every import every


def read(kind, value):
    return (
        create_model("Values", __base__=Table, value=(kind, Field(description="What it is for.")))
        .model_validate({"value": value})
        .value
    )


@every(
    ("kind", "value", "found"),
    [
        (fields.Length, "86 mm", 0.086),
        (fields.Angle, "-2 deg", pytest.approx(-0.0349066)),
        (fields.Sided[fields.PositiveAngle], ["0.21 rad", "0.2 rad"], (0.21, 0.2)),
        (fields.Sided[fields.Restitution], 1, 1.0),
        (fields.Position, ["43 mm", "0 m", "440 mm"], (0.043, 0.0, 0.44)),
        (fields.Direction, [0, 0, -2], (0.0, 0.0, -1.0)),
        (fields.Interval, ["2 s", "0.5 min"], (2.0, 30.0)),
        (fields.Column, 3, 3),
        (Literal["auto"] | fields.Frequency, "auto", "auto"),
        (Literal["auto"] | fields.Frequency, "25 Hz", 25.0),
        (Annotated[fields.Number, Field(ge=0.0, le=1.0)], 1, 1.0),
    ],
)
def test_what_is_written_becomes_its_si_value(kind, value, found):
    assert read(kind, value) == found


@every(
    ("kind", "value", "told"),
    [
        (fields.Length, 86, "86 has no unit. A quantity in quotes was expected"),
        (fields.Length, "? mm", "has no number. A quantity in quotes was expected, such as"),
        (fields.Length, "-86 mm", "A value between 0.001 m and 1000 m was expected"),
        (fields.Length, "1e400 m", "is too large"),
        (fields.Frequency, "86 mm", "frequency"),
        (fields.Sided[fields.PositiveAngle], ["0.2 rad"], "A list of more values was expected: what it is for."),
        (fields.Sided[fields.Restitution], 1.2, "It should be less than or equal to 1: what it is for."),
        (fields.Direction, [0, 0, 0], "A direction other than zero was expected"),
        (fields.Interval, ["14 s", "2 s"], "The second has to be the larger one."),
        (fields.Interval, "2 s", "A list was expected: what it is for."),
        (fields.Column, 0, "Expected: what it is for."),
        (fields.Text, "  ", "Text in quotes was expected: what it is for."),
        (fields.PositiveNumber, "20", "A plain number was expected, without quotes"),
        (fields.PositiveNumber, True, "A plain number was expected"),
        (fields.PositiveNumber, 10**5000, "a whole number of very many digits was found."),
        (fields.PositiveNumber, float("nan"), "A finite number was expected: what it is for."),
        (fields.Scale, 0, "It should be greater than or equal to 0.001: what it is for."),
        (Annotated[fields.Number, Field(gt=0.0, lt=1.0)], 1.0, "It should be less than 1: what it is for."),
        (Literal["auto"] | fields.Frequency, "atuo", 'Or "auto".'),
        (Annotated[str, fields.OneOf(("table", "ground"))], "tabel", '"tabel" was found. Did you mean "table"?'),
        (Annotated[str, fields.OneOf(("table", "ground"))], 3, 'Choose one of: "table", "ground".'),
    ],
)
def test_what_does_not_fit_is_refused_with_what_was_expected(kind, value, told):
    with pytest.raises(ValidationError, match=re.escape(told)):
        read(kind, value)


@pytest.mark.parametrize(
    ("value", "found"),
    [
        ("x" * 70, '"' + "x" * 57 + '…"'),
        ([1, 2, 3, "a"], '[1, 2, 3, "a"]'),
        (list(range(99)), "[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16…"),
        ({"a": 1}, "a table"),
        (10**5000, "a whole number of very many digits"),
    ],
    ids=["long text", "a list", "a long list", "a table", "a huge number"],
)
def test_a_value_is_repeated_in_short(value, found):
    assert fields.shown(value) == found


DAYS = st.dates(date(1900, 1, 1), date(2100, 12, 31))
TIMES = st.sampled_from(["", "T10:15", " 10:15:00", "T10:15:00.125Z", " 10:15:00+02:00", "T00:00:00"])


@given(DAYS, TIMES)
def test_a_day_with_the_year_first_is_that_day(expected, clock):
    assert day(f"{expected.isoformat()}{clock}") == expected


@given(DAYS, TIMES, st.booleans())
def test_a_day_with_dots_is_written_day_first(expected, clock, is_padded):
    written = expected.strftime("%d.%m.%Y") if is_padded else f"{expected.day}.{expected.month}.{expected.year}"
    assert day(f" {written}{clock} ") == expected


@given(DAYS, st.booleans())
def test_a_day_with_slashes_is_taken_only_if_one_order_is_possible(expected, is_day_first):
    first, second = (expected.day, expected.month) if is_day_first else (expected.month, expected.day)
    written = f"{first:02d}/{second:02d}/{expected.year}"
    if max(first, second) > 12 or first == second:
        assert day(written) == expected
    else:
        other = expected.replace(month=expected.day, day=expected.month)
        with pytest.raises(ValueError, match="it is not clear which number is the day") as told:
            day(written)
        assert str(expected) in str(told.value)
        assert str(other) in str(told.value)


@given(DAYS, st.times(), st.integers(-14, 14))
def test_dates_of_toml_and_excel_are_taken_as_they_are(expected, clock, hours):
    zone = timezone(timedelta(hours=hours))
    assert day(expected) == expected
    assert day(datetime.combine(expected, clock)) == day(datetime.combine(expected, clock, zone)) == expected


@every(
    "written",
    [
        *("last week", "", "2013", "2013-04", "2013-13-01", "2013-02-30", "31.04.2013", "26.4.13", "26/04/13"),
        *("04/26/13", "2013-04/26", "26.04-2013", "32/01/2013", "2013-04-26 nearly", "41390"),
        *("２０１３-04-26x", 41390, 41390.0, True, None, ["2013-04-26"], time(10, 15)),
    ],
    ids=repr,
)
def test_anything_else_is_refused_with_what_was_expected(written):
    with pytest.raises(ValueError, match=r"A date .*was expected"):
        day(written)


@given(st.text(max_size=30))
def test_no_text_is_answered_with_anything_but_a_day_or_a_sentence(written):
    try:
        assert isinstance(day(written), date)
    except ValueError as error:
        assert str(error).endswith((".", "2013-04-26."))  # noqa: PT017


CAMPAIGN = tomllib.loads("""
schema = 1
campaign = "bounds"
title = "Numbers"
gravity = "9.81 m/s^2"
motions.pulse = {file = "raw/motion.txt", interval = "0.02 s"}

[specimens]
prism = {shape = "prism", width = "0.086 m", depth = "0.086 m", height = "0.456 m", mass = "26.1 kg", scale = 20.0, \
critical_angle = "0.1864 rad", pole_distance = "0.232 m", inertia = "1.873 kg m^2", restitution = 0.95}

[setups.frame]
sampling_rate = "200.0 Hz"
catch = "0.3 rad"
table_tilt = "0.001 rad"

[setups.frame.channels]
top = {column = "top", quantity = "displacement", unit = "V", gain = "10.0 mm/V", offset = "0.1 mm", range = "10.0 V", \
on = "specimen", at = ["0.043 m", "0 mm", "440 mm"], direction = [1.0, 0, 0], relative_to = "table", delay = "0.002 s"}

[processing]
sampling_rate = "200.0 Hz"
lowpass = "25.0 Hz"
base_lowpass = "25.0 Hz"
spike_threshold = 8.0
flat_duration = "0.5 s"
gap = 1.5
jitter = 0.05
rest_duration = "0.5 s"
longest_offset = "1.0 s"
restitution = {lowest_amplitude = 0.02, level = 0.95}

[processing.predict]
rest_angle = 1e-6
ensemble = {critical_angle = 0.005, p = 0.005, filter = 0.1}

contact = {step = "1e-5 s", penetration = 1e-6, friction = 0.6, modulus = "2e11 Pa", poisson_ratio = 0.3, \
out_of_plane = "0.0 rad", damping_fraction = 0.1}

[[tests]]
id = "free-01"
kind = "free-vibration"
specimen = "prism"
setup = "frame"
file = "raw/free-01.csv"
window = ["0 s", "8.0 s"]
frequency = "3.0 Hz"
span = 2.0
time_scale = 1.0
""")


def numbers_in(value, place=()):
    """Places of the numbers of a document, alone or with a unit; 0 and 1 in a list are coordinates."""
    if isinstance(value, (dict, list)):
        for key, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from numbers_in(each, (*place, key))
    elif isinstance(value, float) or (isinstance(value, str) and re.match(r"[\d.e-]+ ", value)):
        yield place


NUMBERS = {".".join(map(str, place)): place for place in numbers_in(CAMPAIGN)}
EXTREMES = (5e-324, 1e-300, 1e-30, 1e-12, 1e12, 1e30, 1e300, 1.7976931348623157e308)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("bounds")


def written(folder, key, value):
    document = deepcopy(CAMPAIGN)
    *tables, last = NUMBERS[key]
    table = document
    for each in tables:
        table = table[each]
    usual = table[last]
    table[last] = value if isinstance(usual, float) else f"{value!r} {usual.partition(' ')[2]}"
    text = "".join(f"{name} = {toml_value(each)}\n" for name, each in document.items())
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return folder


def expect_usable_or_refused(folder, key, value):
    try:
        campaign = load(written(folder, key, value))
    except CampaignError as error:
        told = str(error)
        assert len(told) < 400, told
        assert "Internal" not in told
        assert "Traceback" not in told
        assert any(word in told for word in ("expected", "should be", "above zero", "block")), told
        return False
    block, top = campaign.block("prism"), campaign.setups["frame"].channels["top"]
    assert all(math.isfinite(number) for number in (block.p, block.critical_angle, block.pole_distance, block.inertia))
    assert all(math.isfinite(number) for number in (top.factor, top.offset, top.full_scale))
    return True


def test_the_usual_numbers_are_accepted(folder):
    assert expect_usable_or_refused(folder, "specimens.prism.mass", 26.1)


@given(
    key=st.sampled_from(sorted(NUMBERS)),
    value=st.sampled_from(EXTREMES) | st.floats(min_value=5e-324, allow_infinity=False, allow_nan=False),
)
def test_any_finite_number_above_zero_makes_a_usable_campaign_or_is_refused(folder, key, value):
    expect_usable_or_refused(folder, key, value)


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("processing.predict.rest_angle", 1e-300, "It should be greater than 0.0000000001: an arc"),
        ("processing.sampling_rate", 1e300, "A value between 1 Hz and 100000 Hz was expected."),
        ("gravity", 1e-300, "A value between 0.01 m/s^2 and 10000 m/s^2 was expected."),
        ("processing.predict.contact.step", 5e-13, "A value between 1e-07 s and 0.001 s was expected."),
        ("specimens.prism.inertia", 1e-9, "give a frequency parameter of"),
        ("setups.frame.channels.top.gain", 1e30, "was expected."),
        ("setups.frame.channels.top.offset", 1e300, "was expected."),
        ("setups.frame.channels.top.at.0", 1e300, "A value between -10000 m and 10000 m was expected."),
    ],
)
def test_what_was_met_is_refused_with_what_was_expected(folder, key, value, expected):
    with pytest.raises(CampaignError, match=re.escape(expected)):
        load(written(folder, key, value))
