"""Days of the calendar, as people and programs write them."""

from __future__ import annotations

import re
from datetime import date, datetime
from typing import Annotated

from colonnade.campaign.syntax.fields import Kind, shown

FIRST_YEAR, LAST_YEAR = 1900, 2100
"""Years between which a test was done; another is a slip of the pen."""

_ISO = re.compile(r"(\d{4})([-/.])(\d{1,2})\2(\d{1,2})")
_DOTTED = re.compile(r"(\d{1,2})\.\s?(\d{1,2})\.\s?(\d{4})")
_SLASHED = re.compile(r"(\d{1,2})([-/])(\d{1,2})\2(\d{4})")
_TIME = re.compile(r"(?:[T ]\s*\d{1,2}:\d{2}(?::\d{2}(?:\.\d+)?)?\s*(?:Z|[+-]\d{2}:?\d{2})?)?$")


def day(value: object) -> date:
    """
    Take a day.

    Parameters
    ----------
    value : object
        A date, or a date with a time of day; or text: ``2013-04-26``, ``26.04.2013`` (day first), or with slashes where
        only one order is possible: ``26/04/2013``. A time of day after it is ignored.

    Raises
    ------
    ValueError
        If it is not a day between 1900 and 2100, or if it is not clear which number is the day: ``04/05/2013``.

    Examples
    --------
    >>> day("26.04.2013").isoformat()
    '2013-04-26'
    """
    if isinstance(value, datetime):
        value = value.date()
    found = value if isinstance(value, date) else _written(value.strip()) if isinstance(value, str) else None
    if found is None:
        raise ValueError(f"{shown(value)} was found. A date was expected, such as 2013-04-26.")
    if not FIRST_YEAR <= found.year <= LAST_YEAR:
        raise ValueError(f"{found} was found. A date between {FIRST_YEAR} and {LAST_YEAR} was expected.")
    return found


def _written(text: str) -> date | None:
    """Read a day from text; None if it is not one."""
    for pattern, order in ((_ISO, (1, 3, 4)), (_DOTTED, (3, 2, 1))):
        if (found := _whole(pattern, text)) is not None:
            return _calendar_day(*(int(found[number]) for number in order))
    if (found := _whole(_SLASHED, text)) is None:
        return None
    first, second, year = int(found[1]), int(found[3]), int(found[4])
    day_first, month_first = _calendar_day(year, second, first), _calendar_day(year, first, second)
    if day_first and month_first and day_first != month_first:
        raise ValueError(
            f"{shown(text)} is {day_first} or {month_first}: it is not clear which number is the day. Write the "
            "year first, such as 2013-04-26."
        )
    return day_first or month_first


def _whole(pattern: re.Pattern[str], text: str) -> re.Match[str] | None:
    """Match a date, followed by nothing but a time of day."""
    found = pattern.match(text)
    return found if found and _TIME.match(text, found.end()) else None


def _calendar_day(year: int, month: int, of_month: int) -> date | None:
    try:
        return date(year, month, of_month)
    except ValueError:
        return None


DAY_SCHEMA = {"type": "string", "format": "date", "description": "a date of TOML, or text", "examples": ["2013-04-26"]}
Day = Annotated[date, Kind(day, DAY_SCHEMA)]
