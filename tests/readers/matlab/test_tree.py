"""Objects of MATLAB's classes are refused with what to type in MATLAB."""

from __future__ import annotations

import pytest

from colonnade.readers.matlab.tree import object_reason


@pytest.mark.parametrize(("name", "told"), [("timetable", "timetable2table(x)"), ("odd", "as plain arrays")])
def test_an_object_is_refused_with_what_to_do(name: str, told: str) -> None:
    reason = object_reason(name)
    assert f"MATLAB's class {name}, which only MATLAB can open" in reason
    assert told in reason
