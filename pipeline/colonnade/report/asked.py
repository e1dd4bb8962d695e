"""The tests whose pages a report asks for, and what of the campaign each shows; light to import, for idle runs."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.store.layout import Layout
from colonnade.store.records.summary import read_summary, records_of_tests
from colonnade.store.results import models_shown

KIND = "photo"
"""Kind of the findings about photos that cannot be shown."""


@dataclass(frozen=True)
class Photo:
    """A photo: its address within the report, what it is, for those who do not see it, and its path as written."""

    address: str
    description: str
    written: str


def address_of(test: str, number: int) -> str:
    """Address of a test's photo within the report; photos are numbered from 1."""
    return f"photos/{test}-{number}.jpg"


@dataclass(frozen=True)
class Asked:
    """
    A test whose page is asked for: its neighbours, record and photos, and whether its results are out of date.

    `campaign` holds this test alone; `shows` is all of it that a page shows, with paths from its folder.
    """

    campaign: Campaign
    test: str
    before: str | None
    after: str | None
    record: TestSummary
    is_outdated: bool
    photos: Sequence[Photo]
    shows: str


def asked_of(
    campaign: Campaign,
    layout: Layout,
    outdated: Collection[str] = (),
    photos: Mapping[str, Sequence[Photo]] | None = None,
) -> Iterator[Asked]:
    """Ask for the page of each test: with its record and its neighbours."""
    ids = [None, *campaign.tests, None]
    records = records_of_tests(campaign, read_summary(layout))
    place = (campaign.title, campaign.facility, campaign.gravity, campaign.of_interest)
    specimens, setups = (
        {name: repr(each) for name, each in of.items()} for of in (campaign.specimens, campaign.setups)
    )
    for before, (name, test), after in zip(ids, campaign.tests.items(), ids[2:], strict=False):
        alone = campaign.but(tests={name: test})
        # Forecasts have a page of their own: one that is added redoes no other.
        record = records[name].model_copy(update={"forecast": None})
        own = (test, specimens[test.specimen], setups[test.setup], campaign.review(name))
        given = (before, after, record, name in outdated, (photos or {}).get(name, ()))
        yield Asked(alone, name, *given, campaign.told((place, models_shown(alone), own, given)))
