"""Scripts of the report: the library's from its wheel, ours, and the state that a watch writes."""

import json

import pytest

from colonnade.errors import StoreError
from colonnade.report import addresses
from colonnade.report.addresses import UNWATCHED, scripts, state_script


def test_nothing_is_loaded_that_a_file_cannot_load():
    ours = scripts()[addresses.OWN]
    for refused in ("fetch(", "import(", "import ", "new Worker", "XMLHttpRequest", "http://", "https://", "innerHTML"):
        assert refused not in ours.replace("http://www.w3.org/2000/svg", ""), refused


def test_a_library_without_its_scripts_is_said_plainly(monkeypatch, tmp_path):
    class Found:
        submodule_search_locations = (str(tmp_path),)

    monkeypatch.setattr(addresses, "find_spec", lambda name: Found())
    with pytest.raises(StoreError, match="pip install --force-reinstall bokeh"):
        scripts()


def test_data_of_pages_of_one_name_are_apart():
    pages = ["index.html", "tests/index.html", "specimens/index.html"]
    assert len(set(map(addresses.of_data, pages))) == 3


def test_the_state_calls_the_page_with_one_value_that_no_text_can_leave():
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


def test_without_a_watch_the_state_has_no_time_and_no_line():
    given = json.loads(UNWATCHED.removeprefix("colonnadeState(").removesuffix(");\n"))
    assert (given["watched"], given["written"], given["line"]) == (False, 0, "")
