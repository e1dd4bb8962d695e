"""Days as people write them: one order only, or refused."""

from __future__ import annotations

from datetime import date, datetime, time, timedelta, timezone

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.syntax.days import FIRST_YEAR, LAST_YEAR, day
from every import every

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
