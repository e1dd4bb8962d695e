"""The kinds of value of a campaign file: what becomes which SI value, and what is said of what does not."""

import re
from datetime import date, datetime, time, timedelta, timezone
from typing import Annotated, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import Field, TypeAdapter, ValidationError, create_model

from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.fields import FIRST_YEAR, LAST_YEAR, day
from colonnade.campaign.syntax.table import Table
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
        (fields.Length, "? mm", "still has to be filled in"),
        (fields.Length, "-86 mm", "A value above zero was expected"),
        (fields.Length, "1e400 m", "is too large"),
        (fields.Frequency, "86 mm", "frequency"),
        (fields.Sided[fields.PositiveAngle], ["0.2 rad"], "A list of 2 was expected: what it is for."),
        (fields.Sided[fields.Restitution], 1.2, "above 0, at most 1"),
        (fields.Direction, [0, 0, 0], "A direction other than zero was expected"),
        (fields.Interval, ["14 s", "2 s"], "The second has to be the larger one."),
        (fields.Interval, "2 s", "A list of 2 was expected: what it is for."),
        (fields.Column, 0, "Expected: what it is for."),
        (fields.Text, "  ", "It is empty. Text was expected."),
        (fields.PositiveNumber, "20", "A plain number was expected, without quotes"),
        (fields.PositiveNumber, True, "A plain number was expected"),
        (fields.PositiveNumber, 10**400, "a whole number of very many digits was found."),
        (fields.PositiveNumber, float("nan"), "A finite number was expected."),
        (fields.Scale, 0, "A number from 0.001 to 100000 was expected."),
        (Annotated[fields.Number, Field(gt=0.0, lt=1.0)], 1.0, "between 0 and 1 was expected."),
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
        ([1, 2, 3, 4, 5], "[1, 2, 3, 4, …]"),
        ({"a": 1}, "a table"),
        (10**5000, "a whole number of very many digits"),
    ],
    ids=["long text", "a long list", "a table", "a huge number"],
)
def test_a_value_is_repeated_in_short(value, found):
    assert fields.shown(value) == found


def test_the_schema_of_a_list_has_its_length():
    schema = TypeAdapter(fields.Interval).json_schema()
    assert (schema["type"], [each["type"] for each in schema["prefixItems"]]) == ("array", ["string", "string"])
    assert (schema["minItems"], schema["maxItems"]) == (2, 2)


DAYS = st.dates(date(FIRST_YEAR, 1, 1), date(LAST_YEAR, 12, 31))
TIMES = st.sampled_from(["", "T10:15", " 10:15:00", "T10:15:00.125Z", " 10:15:00+02:00", "T00:00:00"])


@given(DAYS, TIMES, st.sampled_from(["-", "/", "."]))
def test_a_day_with_the_year_first_is_that_day(expected, clock, sign):
    assert day(f"{expected.year:04d}{sign}{expected.month:02d}{sign}{expected.day:02d}{clock}") == expected


@given(DAYS, TIMES, st.booleans())
def test_a_day_with_dots_is_written_day_first(expected, clock, is_padded):
    written = expected.strftime("%d.%m.%Y") if is_padded else f"{expected.day}.{expected.month}.{expected.year}"
    assert day(f" {written}{clock} ") == expected


@given(DAYS, st.booleans(), st.sampled_from("/-"))
def test_a_day_with_slashes_is_taken_only_if_one_order_is_possible(expected, is_day_first, sign):
    first, second = (expected.day, expected.month) if is_day_first else (expected.month, expected.day)
    written = f"{first:02d}{sign}{second:02d}{sign}{expected.year}"
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
        *("04/26/13", "2013-04/26", "26.04-2013", "32/01/2013", "2013-04-26 nearly", "41390", "0013-04-26"),
        *("2113-04-26", "２０１３-04-26x", 41390, 41390.0, True, None, ["2013-04-26"], time(10, 15), date(1813, 4, 26)),
    ],
    ids=repr,
)
def test_anything_else_is_refused_with_what_was_expected(written):
    with pytest.raises(ValueError, match=r"A date .*was expected"):
        day(written)


@given(st.text(max_size=30))
def test_no_text_is_answered_with_anything_but_a_day_or_a_sentence(written):
    try:
        assert FIRST_YEAR <= day(written).year <= LAST_YEAR
    except ValueError as error:
        assert str(error).endswith((".", "2013-04-26."))  # noqa: PT017
