"""The report of the small campaign."""

import shutil

import pytest

from colonnade.store.layout import Layout
from read_pages import built


@pytest.fixture(scope="session")
def report_folder(filled_campaign, made_once):
    """Folder of the report of the small campaign, of which one test was not run; look only."""
    campaign, layout = filled_campaign

    def report(folder):
        shutil.copytree(layout.processed, Layout(folder).processed)
        built(campaign, Layout(folder), {"later"})

    return Layout(made_once("reported", report)).report.parent
