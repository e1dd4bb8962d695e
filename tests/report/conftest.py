"""The small campaign as the report reads it, row by row, and its report."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from colonnade.report.rows import TestRow
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored, read_test
from colonnade.store.records.summary import read_summary, records_of_tests
from read_pages import built


@pytest.fixture(scope="session")
def reported(filled_campaign) -> dict[str, tuple[TestRow, Stored]]:
    """Row and stored results of each test."""
    campaign, layout = filled_campaign
    records = records_of_tests(campaign, read_summary(layout))
    found = {}
    for name, test in campaign.tests.items():
        stored = read_test(campaign, layout, test)
        found[name] = TestRow.of(campaign, test, records[name], stored), stored
    return found


@pytest.fixture(scope="session")
def report_folder(filled_campaign: tuple[Any, Any], made_once: Callable[..., Path]) -> Path:
    """Folder of the report of the small campaign, of which one test was not run; look only."""
    campaign, layout = filled_campaign

    def report(folder: Path) -> None:
        shutil.copytree(layout.processed, Layout(folder).processed)
        built(campaign, Layout(folder), {"later"})

    return Layout(made_once("reported", report)).report.parent
