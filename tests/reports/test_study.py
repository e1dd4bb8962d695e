"""What the programs of reports share: numbers as they were, a record a line; pages that stay small."""

import importlib
import json
from pathlib import Path

import pytest

import rebuild
import study

KEPT = sorted(path for path in study.HERE.rglob("*.json"))


@pytest.mark.parametrize("path", KEPT, ids=lambda path: path.name)
def test_the_numbers_of_a_study_are_kept_a_record_a_line(path, tmp_path):
    study.write_numbers(tmp_path / path.name, json.loads(path.read_text(encoding="utf-8")))
    assert (tmp_path / path.name).read_text(encoding="utf-8") == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["forecast", "fragility", "restitution", "verdict"])
def test_the_page_of_a_study_is_made_from_its_numbers(name):
    made_by = importlib.import_module(f"{name}_study").STUDY
    numbers, page, figure = (study.HERE / f"{made_by.name}.{kind}" for kind in ("json", "md", "svg"))
    found = json.loads(numbers.read_text(encoding="utf-8"))
    assert page.read_text(encoding="utf-8") == made_by.page(found, figure.name)
    assert made_by.draw is None or figure.read_text(encoding="utf-8").startswith("<svg")


def test_a_part_of_a_page_is_replaced_between_its_marks():
    marks = "<!-- (begin) -->", "<!-- (end) -->"
    page = study.renewed("Before <!-- (begin) -->\nold\n<!-- (end) --> after", marks, r"new \1")
    assert page == "Before <!-- (begin) -->\n\nnew \\1\n\n<!-- (end) --> after"
    assert study.renewed(page, marks, r"new \1") == page


REPORTS = Path(__file__).resolve().parents[2] / "reports"


@pytest.mark.slow
def test_the_whole_demo_gives_the_numbers_of_its_report_and_every_outcome_is_right(tmp_path, as_reported):
    rebuild.rebuild(tmp_path)
    as_reported(tmp_path, "demo")


def test_the_reports_are_small():
    assert sum(path.stat().st_size for path in REPORTS.rglob("*") if path.is_file()) < 5_000_000
