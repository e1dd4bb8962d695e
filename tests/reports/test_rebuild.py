"""The reference reports say what the program gives today; that of the short demo is held in test_readme.py."""

from pathlib import Path

import pytest

import rebuild

REPORTS = Path(__file__).resolve().parents[2] / "reports"


@pytest.mark.slow
def test_the_whole_demo_gives_the_numbers_of_its_report_and_every_outcome_is_right(tmp_path, as_reported):
    rebuild.rebuild(tmp_path)
    as_reported(tmp_path, "demo")


def test_the_reports_are_small():
    assert sum(path.stat().st_size for path in REPORTS.rglob("*") if path.is_file()) < 5_000_000
