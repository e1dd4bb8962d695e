"""The small campaign as the report reads it, row by row, and its report."""

import shutil

import pytest

from colonnade.report.rows import TestRow
from colonnade.store.layout import Layout
from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import read_summary, records_of_tests
from read_pages import built


@pytest.fixture(scope="session")
def reported(filled_campaign):
    """Row and stored results of each test."""
    campaign, layout = filled_campaign
    records = records_of_tests(campaign, read_summary(layout))
    found = {}
    for name, test in campaign.tests.items():
        stored = read_test(campaign, layout, test)
        found[name] = TestRow.of(campaign, test, records[name], stored), stored
    return found


@pytest.fixture(scope="session")
def report_folder(filled_campaign, made_once):
    """Folder of the report of the small campaign, of which one test was not run; look only."""
    campaign, layout = filled_campaign

    def report(folder):
        shutil.copytree(layout.processed, Layout(folder).processed)
        built(campaign, Layout(folder), {"later"})

    return Layout(made_once("reported", report)).report.parent
