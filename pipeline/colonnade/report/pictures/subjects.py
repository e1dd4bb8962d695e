"""What figures are drawn of: one test, one specimen with its tests, or the campaign, as stored."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import StabilityMap
from colonnade.figures.agreement import Calibration
from colonnade.figures.restitution.decay import STAGE, ImpactSeries, PeakSeries, impact_series, peak_series
from colonnade.figures.restitution.estimators import EstimateRow, estimate_rows
from colonnade.figures.stored import record
from colonnade.figures.stored.subject import OfTest
from colonnade.identification.response.boundaries import MapPoint
from colonnade.report.forecasts_page import calibrations_of
from colonnade.report.overview_page.groups import SpanTest, charts_of
from colonnade.report.rows import TestRow
from colonnade.report.test_page.restitution import value_of
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Failure, Stored, read_specimen, read_test
from colonnade.store.records.summary import map_points, read_summary, records_of_tests


class FreeVibration(NamedTuple):
    """One free vibration in words and figures of its specimen: e with its interval, why it was refused, departures."""

    test: str
    e: str
    reason: str
    departures: list[str]
    estimates: list[EstimateRow]
    peaks: PeakSeries | None
    impacts: ImpactSeries | None

    @classmethod
    def of(cls, one: OfTest) -> FreeVibration:
        """Read it from what is stored of a test."""
        return cls(
            one.test.id,
            value_of(one.stored, one.record.restitution),
            one.stored.text(STAGE, "reason"),
            one.stored.texts(STAGE, "departures"),
            estimate_rows(one.stored),
            peak_series(one),
            impact_series(one),
        )


@dataclass(frozen=True)
class OfSpecimen:
    """
    A specimen.

    Attributes
    ----------
    campaign : Campaign
    name : str
    pooled : Stored
        Its own results.
    decays : sequence of FreeVibration
        Its free vibrations.
    points : sequence of MapPoint
        Its sine tests of known Ω, A and outcome.
    charts : sequence of StabilityMap
        Its stability maps, one a model.
    spans : sequence of SpanTest
        Its earthquake tests with a Span.
    """

    campaign: Campaign
    name: str
    pooled: Stored
    decays: Sequence[FreeVibration] = ()
    points: Sequence[MapPoint] = ()
    charts: Sequence[StabilityMap] = ()
    spans: Sequence[SpanTest] = ()

    @property
    def block(self) -> Block:
        """Of the specimen."""
        return self.campaign.block(self.name)

    @property
    def failures(self) -> Sequence[Failure]:
        """Why it failed."""
        return self.pooled.failures


@dataclass(frozen=True)
class OfCampaign:
    """A campaign: all its tests as rows of the tables, and how good its forecasts were, by model."""

    campaign: Campaign
    rows: Sequence[TestRow]
    calibrations: Mapping[str, Calibration] = field(default_factory=dict)
    failures: Sequence[Failure] = ()


Subject = OfTest | OfSpecimen | OfCampaign
"""What a figure is drawn of."""


def read_of_test(campaign: Campaign, layout: Layout, test: str, *, with_samples: bool = True) -> OfTest:
    """Read what is stored of a test, as of the last run, with the samples of its channels."""
    entry, records = campaign.tests[test], records_of_tests(campaign, read_summary(layout))
    return OfTest(campaign, entry, records[test], read_test(campaign, layout, entry, with_samples=with_samples))


def read_of_specimen(campaign: Campaign, layout: Layout, specimen: str) -> OfSpecimen:
    """Read what is stored of a specimen and its tests, as of the last run."""
    own = [name for name, test in campaign.tests.items() if test.specimen == specimen]
    tests = [read_of_test(campaign, layout, name, with_samples=False) for name in own]
    records = {each.test.id: each.record for each in tests}
    decays = [FreeVibration.of(each) for each in tests if each.stored.has(STAGE)]
    return of_specimen(campaign, layout, specimen, records, decays, [span_of(each) for each in tests if has_span(each)])


def of_specimen(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    records: Mapping[str, TestSummary],
    decays: Sequence[FreeVibration],
    spans: Sequence[SpanTest],
) -> OfSpecimen:
    """Lay what is stored of a specimen next to what is known of its tests."""
    pooled, points = read_specimen(campaign, layout, specimen), map_points(records, specimen)
    return OfSpecimen(campaign, specimen, pooled, decays, points, charts_of(campaign, layout, specimen), spans)


def read_of_campaign(campaign: Campaign, layout: Layout) -> OfCampaign:
    """Read the records of all tests, as of the last run."""
    summary = read_summary(layout)
    records = records_of_tests(campaign, summary)
    rows = [TestRow.of(OfTest(campaign, test, records[name], Stored())) for name, test in campaign.tests.items()]
    return OfCampaign(campaign, rows, calibrations_of(layout, summary))


def has_span(one: OfTest) -> bool:
    """Whether it is an earthquake test with a Span and an angle, measured or predicted."""
    return one.test.span is not None and any("rocking_angle" in dataset for dataset in one.stored.datasets.values())


def span_of(one: OfTest) -> SpanTest:
    """Gather of an earthquake test what the figure of all Spans shows."""
    return SpanTest(TestRow.of(one), record.span_panel(one), record.seen(one))
