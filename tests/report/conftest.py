"""Rows and results of the small campaign, as the report reads them."""

from __future__ import annotations

import pytest

from colonnade.report.rows import TestRow
from colonnade.store.records.stored import Stored, read_test
from colonnade.store.records.summary import read_summary, records_of_tests


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
