"""Stored results of the small campaign, as pictures read them."""

import pytest

from colonnade.figures.stored.subject import OfTest
from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import read_summary, records_of_tests


@pytest.fixture(scope="session")
def known(filled_campaign):
    """Return a test by its id."""
    campaign, layout = filled_campaign
    records = records_of_tests(campaign, read_summary(layout))
    return lambda name: OfTest(
        campaign, campaign.tests[name], records[name], read_test(campaign, layout, campaign.tests[name])
    )
