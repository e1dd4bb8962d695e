"""Where, when and by whom: the span of days, each operator once, and nothing that is not known."""

from datetime import date

import pytest

from colonnade.report.test_page import facts


@pytest.fixture
def campaign(empty_campaign):
    return empty_campaign[0].but(facility="Simulator <1>")


def dated(campaign, *said):
    """Give the campaign's first tests a day and an operator each."""
    tests = {name: test.model_copy(update={"date": None, "operator": None}) for name, test in campaign.tests.items()}
    for name, (day, who) in zip(tests, said, strict=False):
        tests[name] = tests[name].model_copy(update={"date": day, "operator": who})
    return campaign.but(tests=tests)


def test_one_day_and_one_operator_are_one(campaign):
    said = facts.who_and_when(dated(campaign, *[(date(2013, 4, 26), "M. Rossi")] * 3))
    assert said[1:] == [("tested", "2013-04-26"), ("operator", "M. Rossi")]


def test_what_is_not_known_is_not_shown(campaign):
    assert facts.who_and_when(dated(campaign).but(facility=None)) == []
