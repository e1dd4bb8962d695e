"""What figures are drawn of: one test, one specimen with its tests, or the campaign, as stored."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import StabilityMap
from colonnade.figures.agreement import Calibration
from colonnade.figures.restitution.estimators import EstimateRow
from colonnade.figures.restitution.impacts import ImpactSeries
from colonnade.figures.restitution.peaks import PeakSeries
from colonnade.figures.stored import record as curves
from colonnade.figures.stored import restitution
from colonnade.identification.response.boundaries import MapPoint
from colonnade.report.forecasts_page import calibrations_of
from colonnade.report.overview_page.groups import SpanTest, charts_of
from colonnade.report.rows import TestRow
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Failure, Stored, read_specimen, read_test
from colonnade.store.records.summary import map_points, read_summary, records_of_tests


@dataclass(frozen=True)
class OfTest:
    """A test: its row in the tables, and what is stored of it."""

    campaign: Campaign
    row: TestRow
    stored: Stored

    @property
    def block(self) -> Block:
        """Of its specimen."""
        return self.campaign.block(self.row.test.specimen)

    @property
    def failures(self) -> Sequence[Failure]:
        """Why it failed."""
        return self.row.failures


@dataclass(frozen=True)
class Decaying:
    """What the figures of a specimen show of one free vibration."""

    test: str
    rows: Sequence[EstimateRow]
    peaks: PeakSeries | None
    impacts: ImpactSeries | None

    @classmethod
    def of(cls, subject: OfTest) -> Decaying:
        """Read it from what is stored of a test."""
        test, stored = subject.row.test, subject.stored
        return cls(
            test.id,
            restitution.estimate_rows(stored),
            restitution.peak_series(test, stored, subject.block),
            restitution.impact_series(test, stored),
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
    decays : sequence of Decaying
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
    decays: Sequence[Decaying] = ()
    points: Sequence[MapPoint] = ()
    charts: Sequence[StabilityMap] = ()
    spans: Sequence[SpanTest] = field(default=())

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


def read_of_test(campaign: Campaign, layout: Layout, test: str) -> OfTest:
    """Read what is stored of a test, as of the last run, with the samples of its channels."""
    record = records_of_tests(campaign, read_summary(layout))[test]
    return _of_test(campaign, layout, test, record, with_samples=True)


def _of_test(campaign: Campaign, layout: Layout, test: str, record: TestSummary, *, with_samples: bool) -> OfTest:
    entry = campaign.tests[test]
    stored = read_test(campaign, layout, entry, with_samples=with_samples)
    return OfTest(campaign, TestRow.of(campaign, entry, record, stored), stored)


def read_of_specimen(campaign: Campaign, layout: Layout, specimen: str) -> OfSpecimen:
    """Read what is stored of a specimen and its tests, as of the last run."""
    known = records_of_tests(campaign, read_summary(layout))
    records = {name: known[name] for name, test in campaign.tests.items() if test.specimen == specimen}
    tests = [_of_test(campaign, layout, name, each, with_samples=False) for name, each in records.items()]
    decays = [Decaying.of(each) for each in tests if each.stored.has(restitution.STAGE)]
    return of_specimen(campaign, layout, specimen, records, decays, [span_of(each) for each in tests if has_span(each)])


def of_specimen(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    records: Mapping[str, TestSummary],
    decays: Sequence[Decaying],
    spans: Sequence[SpanTest],
) -> OfSpecimen:
    """Lay what is stored of a specimen next to what is known of its tests."""
    pooled, points = read_specimen(campaign, layout, specimen), map_points(records, specimen)
    return OfSpecimen(campaign, specimen, pooled, decays, points, charts_of(campaign, layout, specimen), spans)


def read_of_campaign(campaign: Campaign, layout: Layout) -> OfCampaign:
    """Read the records of all tests, as of the last run."""
    summary = read_summary(layout)
    records = records_of_tests(campaign, summary)
    rows = [TestRow.of(campaign, test, records[name], Stored()) for name, test in campaign.tests.items()]
    return OfCampaign(campaign, rows, calibrations_of(layout, summary))


def has_span(subject: OfTest) -> bool:
    """Whether it is an earthquake test with a Span and an angle, measured or predicted."""
    datasets = subject.stored.datasets.values()
    return subject.row.test.span is not None and any("rocking_angle" in dataset for dataset in datasets)


def span_of(subject: OfTest) -> SpanTest:
    """Gather of an earthquake test what the figure of all Spans shows."""
    row, stored = subject.row, subject.stored
    return SpanTest(row, curves.span_panel(row.test, stored, subject.block), curves.seen(row.record, stored))
