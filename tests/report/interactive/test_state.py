"""The state script: what the page's own script reads of a watch."""

from __future__ import annotations

import json

from colonnade.report.interactive.state import UNWATCHED, state_script


def test_it_calls_the_page_with_one_value_that_no_text_can_leave():
    line = 'free-01: </script><script>alert("1")\u2028\n\\'
    text = state_script(is_watched=True, written=1.7e9, shown="a-1", line=line, line_written=1.6e9)
    assert text.isascii()
    assert "<" not in text
    assert text.count("\n") == 1
    given = json.loads(text.removeprefix("colonnadeState(").removesuffix(");\n"))
    assert given == {
        **{"watched": True, "written": 1.7e9, "every": 5.0},
        **{"shown": "a-1", "line": line, "line_written": 1.6e9},
    }


def test_without_a_watch_it_has_no_time_and_no_line():
    given = json.loads(UNWATCHED.removeprefix("colonnadeState(").removesuffix(");\n"))
    assert (given["watched"], given["written"], given["line"]) == (False, 0, "")
