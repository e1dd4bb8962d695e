"""
The figures of tests, specimens and the campaign, each by its name: what it is of, shows and needs, and who draws it.

A new figure is a module in `figures` and an entry in `FIGURES`: its section of the page and the PDF show it, and
`colonnade figure` draws it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from inspect import cleandoc
from math import isfinite
from typing import Any, Literal, NamedTuple

from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import IdentifiedSummary, TestSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import StabilityMap
from colonnade.figures import base_motion, channels, closer, moving
from colonnade.figures.drawing import described
from colonnade.figures.files.output import Movie, Picture
from colonnade.figures.maps import response_orders
from colonnade.figures.restitution import decay, estimators
from colonnade.figures.restitution.decay import STAGE, EstimateRow, ImpactSeries, PeakSeries
from colonnade.figures.restitution.estimators import estimate_rows
from colonnade.figures.stored import bodies, record
from colonnade.figures.stored.subject import OfTest, some_of
from colonnade.identification.response.boundaries import MapPoint, makes_map
from colonnade.report import forecasts_page, overview
from colonnade.report.forecasts_page import calibrations_of
from colonnade.report.overview import SpanTest, TestRow, charts_of, span_groups
from colonnade.store.layout import Layout
from colonnade.store.records.forecast import FEWEST
from colonnade.store.records.stored import Failure, Stored, read_specimen, read_test
from colonnade.store.records.summary import map_points, read_summary, records_of_tests
from colonnade.store.results import models_shown
from colonnade.units.text import interval, listed


def value_of(one: OfTest) -> str:
    """Write e of a free vibration with the half-width of its interval."""
    found = one.record.restitution or IdentifiedSummary()
    return interval(found.value, found.low, found.high, one.stored.value(STAGE, "level"))


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
            value_of(one),
            one.stored.text(STAGE, "reason"),
            one.stored.texts(STAGE, "departures"),
            estimate_rows(one.stored),
            decay.peak_series(one),
            decay.impact_series(one),
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
    calibrations: Mapping[str, Array] = field(default_factory=dict)
    failures: Sequence[Failure] = ()


Subject = OfTest | OfSpecimen | OfCampaign
"""What a figure is drawn of."""

SUBJECTS = {"test": OfTest, "specimen": OfSpecimen, "campaign": OfCampaign}
"""The same by their names."""


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
    spans = [span for each in tests if (span := span_of(each))]
    return of_specimen(campaign, layout, specimen, records, decays, spans)


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
    rows = [TestRow.of(campaign, test, records[name]) for name, test in campaign.tests.items()]
    return OfCampaign(campaign, rows, calibrations_of(layout, summary))


def span_of(one: OfTest) -> SpanTest | None:
    """Gather what the figure of all Spans shows of a test; None without a Span, or an angle measured or predicted."""
    if one.test.span is None or not any("rocking_angle" in dataset for dataset in one.stored.datasets.values()):
        return None
    return SpanTest(
        TestRow.of(one.campaign, one.test, one.record, one.failures), record.span_panel(one), record.seen(one)
    )


class Entry(NamedTuple):
    """
    A figure; the docstring of what draws it says what it shows, and under it the caption.

    Attributes
    ----------
    name : str
        Its name, the same for a test and a specimen if it shows the same of both.
    of : {"test", "specimen", "campaign"}
    needs : str
        What has to be there.
    draw : callable
        Takes an `OfTest`, `OfSpecimen` or `OfCampaign`; None if there is nothing to draw.
    section : str
        Of the subject's page, which shows it; empty if a template places it.
    is_narrow : bool
        Whether it is legible in a single column of a journal.
    """

    name: str
    of: Literal["test", "specimen", "campaign"]
    needs: str
    draw: Callable[[Any], Picture | Movie | None]
    section: str = ""
    is_narrow: bool = True

    @property
    def shows(self) -> str:
        """In words, for lists."""
        return cleandoc(self.draw.__doc__ or "").partition("\n\n")[0].rstrip(".")

    @property
    def caption(self) -> str:
        """What stands under it on a page."""
        return " ".join(cleandoc(self.draw.__doc__ or "").partition("\n\n")[2].split())


def _estimators_of_test(one: OfTest) -> Picture | None:
    """
    e from every estimator.

    e from the whole history and, as a cross-check, from the peaks, with intervals; diamond: the value given. Dotted
    line: rigid-body e, without bounce.
    """
    rows = estimators.estimate_rows(one.stored)
    return estimators.estimators(f"estimators-{one.test.id}", {"": rows}, one.block.restitution)


def _decays(one: OfTest | OfSpecimen) -> tuple[str, Sequence[FreeVibration], EstimateRow]:
    """Give the name of a test or specimen, its free vibrations, and e of all together."""
    if isinstance(one, OfTest):
        return one.test.id, [FreeVibration.of(one)], decay.level_of(one.stored, STAGE, "e identified")
    return one.name, one.decays, decay.level_of(one.pooled, "specimen", "e pooled")


def _peaks(one: OfTest | OfSpecimen) -> Picture | None:
    """
    Energy of successive peaks and its line.

    Energy of each peak over the energy that overturns the block, against the number of the preceding impact: a constant
    e is a straight line. Bars: ± two standard errors.
    """
    name, decays, _ = _decays(one)
    series, note = some_of([each.peaks for each in decays if each.peaks is not None], "free vibrations")
    return decay.peaks(f"peaks-{name}", series, one.block, note)


def _impacts(one: OfTest | OfSpecimen) -> Picture | None:
    """
    e of each impact over its velocity.

    e of each impact against the angular velocity before it, and against its number; each free vibration has its own
    marker. Bars, or of many impacts the grey band: ± two standard errors of an impact. Line and narrow band: e that is
    identified, with its interval.
    """
    name, decays, level = _decays(one)
    series, note = some_of([each.impacts for each in decays if each.impacts is not None], "free vibrations")
    return decay.impacts(f"impacts-{name}", series, level, one.block.restitution, note)


def _base(one: OfTest) -> Picture | None:
    """Motion of the table and its spectrum, with the target."""
    return base_motion.base_picture(one, base_motion.base_of(one))


def _setup(one: OfTest) -> Picture:
    """Specimen and transducers to scale."""
    return described.picture(one.campaign, one.test.specimen, one.test.setup)


def _estimators(one: OfSpecimen) -> Picture | None:
    """
    e from every estimator and record.

    e from the history and from the peaks, with intervals; diamond: the value given, and the one pooled over all
    records. Dotted line: rigid-body e, without bounce.
    """
    shown, note = some_of(one.decays, "free vibrations")
    groups = {each.test: each.estimates for each in shown}
    _, _, level = _decays(one)
    if isfinite(level.low):
        groups["all together"] = [level._replace(name="pooled", recommended=True)]
    return estimators.estimators(f"estimators-{one.name}", groups, one.block.restitution, note)


def _measured_map(one: OfSpecimen) -> Picture | None:
    """
    Sine tests by outcome over Ω and A.

    Each mark is a sine test. A bar spans the two tests around a boundary. Dotted line: A = 1. Labels: order of a
    sub-harmonic response.
    """
    return response_orders.tested(f"map-{one.name}", one.points) if makes_map(one.points) else None


def _map(one: OfSpecimen) -> Picture | None:
    """
    Computed stability map with the measured points.

    Computed outcomes over frequency ratio Ω and amplitude ratio A, with the measured sine tests. Thick line: lower
    limit of overturning; thin line: upper limit, above which every test overturns. Labels: order of a sub-harmonic
    response.
    """
    return response_orders.computed(one.name, one.charts, one.points) if one.charts else None


def _spans(one: OfSpecimen) -> Picture | None:
    """Earthquake tests of a motion side by side by Span."""
    groups = sorted(span_groups(one.spans), key=lambda group: -len(group.tests))
    if not groups:
        return None
    shown, *others = groups
    note = f"Shown: {shown.title}. Not shown: {listed([each.title for each in others])}." if others else ""
    return replace(shown.picture, note=note)


def _agreement(one: OfCampaign) -> Picture | None:
    """Predicted over measured peak of each test."""
    models = models_shown(one.campaign)
    return overview.peaks_picture(overview.peak_points(one.rows, models, overview.worst(one.rows, models)))


def _calibration(one: OfCampaign) -> Picture | None:
    """PIT of forecasts."""
    return forecasts_page.calibration(one.calibrations)


_SINES = "It needs sine tests at two frequencies or more."
_MAP = "Without them, `colonnade map` makes one."
_BODIES = "It needs an assembly whose bodies were measured."
_RAW = "It needs a raw file that could be read."
_ANGLE = "It needs a measured or predicted angle."
_FREE = "It needs a free vibration with an angle."
_FREED = f"{_FREE} Its fit must free the critical angle."
FIGURES: tuple[Entry, ...] = (
    Entry("record", "test", _ANGLE, record.record),
    Entry("angle", "test", _ANGLE, record.angle),
    Entry("closer", "test", _ANGLE, closer.picture, "closer", is_narrow=False),
    Entry("base", "test", "It needs a table motion.", _base),
    Entry("channels", "test", _RAW, channels.picture, "channels", is_narrow=False),
    Entry("bands", "test", "It needs an ensemble.", record.bands),
    Entry("fitted", "test", _FREE, estimators.fitted, "restitution"),
    Entry("estimators", "test", _FREE, _estimators_of_test, "restitution", is_narrow=False),
    Entry("peaks", "test", _FREE, _peaks, "restitution"),
    Entry("impacts", "test", _FREE, _impacts, "restitution"),
    Entry("region", "test", _FREED, estimators.region, "restitution", is_narrow=False),
    Entry("plan", "test", _BODIES, bodies.plan, "bodies", is_narrow=False),
    Entry("joints", "test", _BODIES, bodies.joints, "bodies"),
    Entry("setup", "test", "", _setup, is_narrow=False),
    Entry("animation", "test", _ANGLE, moving.animation),
    Entry("peaks", "specimen", _FREE, _peaks, "restitution"),
    Entry("estimators", "specimen", _FREE, _estimators, "restitution", is_narrow=False),
    Entry("impacts", "specimen", _FREE, _impacts, "restitution"),
    Entry("map", "specimen", f"{_SINES} {_MAP}", _map, "map"),
    Entry("measured-map", "specimen", _SINES, _measured_map, "measured-map"),
    Entry("spans", "specimen", "It needs two Spans of one motion.", _spans),
    Entry("agreement", "campaign", "A test must have rocked.", _agreement),
    Entry("calibration", "campaign", f"It needs {FEWEST} scored forecasts.", _calibration),
)
"""Every figure; no two of one subject have the same name."""


def picture(name: str, of: Subject) -> Picture | None:
    """Draw a figure of a test, a specimen or the campaign by its name; None if there is nothing to draw."""
    drawn = next(entry for entry in FIGURES if isinstance(of, SUBJECTS[entry.of]) and entry.name == name).draw(of)
    return drawn if isinstance(drawn, Picture) else None


def pictures_in(section: str, of: Subject) -> Iterator[tuple[Picture, str]]:
    """Draw the figures that are entered for a section of a page, each with its caption."""
    for entry in FIGURES:
        if isinstance(of, SUBJECTS[entry.of]) and entry.section == section and (drawn := picture(entry.name, of)):
            yield drawn, entry.caption
