"""Scripts of the report: the library's from its wheel, and ours."""

from __future__ import annotations

import pytest

from colonnade.errors import StoreError
from colonnade.report import addresses
from colonnade.report.interactive import scripts as module
from colonnade.report.interactive.scripts import FOLDER, PARTS, scripts


def test_a_page_of_a_test_loads_every_script_and_then_the_state_and_its_data():
    assert addresses.scripts_of("tests/a.html") == [*scripts(), "state.js", "data/a.js"]


def test_ours_is_all_of_the_folder():
    assert {path.stem for path in FOLDER.glob("*.js")} == set(PARTS)
    assert all((FOLDER / f"{name}.js").read_text(encoding="utf-8") in scripts()[addresses.OWN] for name in PARTS)


def test_nothing_is_loaded_that_a_file_cannot_load():
    ours = scripts()[addresses.OWN]
    for refused in ("fetch(", "import(", "import ", "new Worker", "XMLHttpRequest", "http://", "https://", "innerHTML"):
        assert refused not in ours.replace("http://www.w3.org/2000/svg", ""), refused


def test_a_library_without_its_scripts_is_said_plainly(monkeypatch, tmp_path):
    class Found:
        submodule_search_locations = (str(tmp_path),)

    monkeypatch.setattr(module, "find_spec", lambda name: Found())
    with pytest.raises(StoreError, match="pip install --force-reinstall bokeh"):
        scripts()
