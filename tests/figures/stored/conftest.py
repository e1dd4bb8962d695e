"""Stored results of the small campaign, as pictures read them."""

import pytest

from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import read_summary, records_of_tests


@pytest.fixture(scope="session")
def known(filled_campaign):
    """Return entry, record, stored results and block of a test."""
    campaign, layout = filled_campaign
    records = records_of_tests(campaign, read_summary(layout))

    def look(name):
        test = campaign.tests[name]
        return test, records[name], read_test(campaign, layout, test), campaign.block(test.specimen)

    return look
