"""The tests whose pages a report asks for, and what of the campaign each page shows; light to import."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.report.photos import NO_PHOTOS, Photos, photos_of
from colonnade.store.layout import Layout
from colonnade.store.records.summary import read_summary, records_of_tests


@dataclass(frozen=True)
class Asked:
    """A test whose page is asked for: its neighbours, record and photos, and whether its results are out of date."""

    test: str
    before: str | None
    after: str | None
    record: TestSummary
    is_outdated: bool
    photos: Photos = NO_PHOTOS


def asked_of(campaign: Campaign, layout: Layout, outdated: Collection[str] = ()) -> list[Asked]:
    """Ask for the page of each test: with its record and its neighbours."""
    ids = [None, *campaign.tests, None]
    # Forecasts have a page of their own: one that is added redoes no other.
    records = {
        name: record.model_copy(update={"forecast": None})
        for name, record in records_of_tests(campaign, read_summary(layout)).items()
    }
    folder = layout.report.parent
    return [
        Asked(test.id, before, after, records[test.id], test.id in outdated, photos_of(campaign, test, folder))
        for before, test, after in zip(ids, campaign.tests.values(), ids[2:], strict=False)
    ]


def shows(campaign: Campaign, asked: Asked) -> str:
    """Write all of the campaign that the page of a test shows; paths are those from the campaign's folder."""
    campaign = campaign.but(tests={asked.test: campaign.tests[asked.test]}).with_relative_paths()
    test = campaign.tests[asked.test]
    place = (campaign.title, campaign.facility, campaign.gravity)
    around = (place, tuple(campaign.specimens), campaign.processing.predict.models)
    own = (test, campaign.specimens[test.specimen], campaign.setups[test.setup], campaign.review(test.id))
    return repr((around, own, asked))
