"""When the tests of a virtual campaign are said to be done: the same days for the same plan, whenever it is written."""

from __future__ import annotations

from datetime import datetime, time, timedelta

import numpy as np

FIRST_DAY = np.datetime64("2013-05-14")
FIRST_TEST = time(9)
"""A working day begins with it."""
BETWEEN_TESTS = timedelta(minutes=24)
TESTS_A_DAY = 18
"""The last begins at 15:48."""


def begun(position: int) -> datetime:
    """
    Return when a test began, by its place in the plan from 0: on working days, one test after the other.

    Examples
    --------
    >>> begun(0).isoformat(" "), begun(4 * TESTS_A_DAY).isoformat(" ")
    ('2013-05-14 09:00:00', '2013-05-20 09:00:00')
    """
    days, before = divmod(position, TESTS_A_DAY)
    day = datetime.fromisoformat(str(np.busday_offset(FIRST_DAY, days)))
    return datetime.combine(day, FIRST_TEST) + before * BETWEEN_TESTS
