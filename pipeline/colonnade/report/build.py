"""The report: pages that stand alone, made from the store whatever became of the tests."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.campaign.settings import settings
from colonnade.dynamics.models.registry import MODELS
from colonnade.figures.stored import record
from colonnade.identification.response.base_motion import LEAST_MOTION
from colonnade.identification.response.rank import WITHIN
from colonnade.identification.restitution.choice import RULE
from colonnade.identification.restitution.estimators.registry import ESTIMATORS
from colonnade.interruption import expect_none
from colonnade.report import addresses, channels, methods, overview, pages, problems, specimens_page, tests_page
from colonnade.report.agreement import agreement
from colonnade.report.channels import ChannelRow
from colonnade.report.methods import Used
from colonnade.report.overview import SpanTest
from colonnade.report.references import REFERENCES
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import FreeVibration, SpecimenPage
from colonnade.store import files, stamps
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.store.records.stored import Stored, read_specimen, read_test
from colonnade.store.records.summary import read_summary, records_of_tests
from colonnade.store.records.wording import quantity


@dataclass
class Gathered:
    """What is kept of the tests for the pages about all of them, light enough for thousands."""

    rows: list[TestRow] = field(default_factory=list)
    channels: dict[str, tuple[ChannelRow, ...]] = field(default_factory=dict)
    spans: list[SpanTest] = field(default_factory=list)
    free_vibrations: defaultdict[str, list[FreeVibration]] = field(default_factory=lambda: defaultdict(list))
    used: Used = field(default_factory=Used)

    def add(self, campaign: Campaign, row: TestRow, stored: Stored) -> None:
        """Keep of a test what the other pages show."""
        test, block = row.test, campaign.block(row.test.specimen)
        self.rows.append(row)
        self.channels[test.id] = channels.of_test(stored)
        self.used.gather(test.id, stored)
        if test.span is not None and any("rocking_angle" in dataset for dataset in stored.datasets.values()):
            panel = record.span_panel(test, stored, block)
            self.spans.append(SpanTest(row, panel, record.seen(row.record, stored)))
        if stored.has("restitution"):
            self.free_vibrations[test.specimen].append(specimens_page.free_vibration(row, stored, block))


def build(campaign: Campaign, layout: Layout, outdated: Collection[str] = (), *, code: str = "", key: str = "") -> Path:
    """
    Write the report of a campaign.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
        Where its results lie. Tests that failed or were never run are reported as such.
    outdated : collection of str, optional
        Tests whose stored results are not of this campaign any more: they are pending, and not shown.
    code : str, optional
        Hash of the code. With it, pages of tests that would come out the same are not drawn again.
    key : str, optional
        Hash of all that the report is made from, for the stamp of the pages that show several tests.

    Returns
    -------
    overview : Path
        ``report/index.html``; the others lie beside it. The same results give the same bytes, and an unchanged page is
        not written again. Pages of tests and specimens that are not in the campaign any more are removed.

    Raises
    ------
    StoreError
        If a page cannot be written.
    """
    folder = layout.report.parent
    there = set()
    for address, text, made_from in render(campaign, layout, outdated, code=code):
        expect_none()
        if text is not None:
            files.write_text(folder / address, stamps.stamped(text, made_from or key))
        there.add(folder / address)
    for stale in {*folder.glob("tests/*.html"), *folder.glob("specimens/*.html")} - there:
        files.remove(stale)
    return layout.report


def render(
    campaign: Campaign, layout: Layout, outdated: Collection[str] = (), *, code: str = ""
) -> Iterator[tuple[str, str | None, str]]:
    """
    Render the pages, the overview last.

    Yields
    ------
    address : str
        Within the report's folder.
    text : str or None
        None if the page of a test is there already.
    made_from : str
        Of the page of a test: hash of what it shows.
    """
    renderer = pages.Renderer(
        campaign=campaign,
        models=campaign.processing.predict.models,
        registry=MODELS,
        gravity=quantity(campaign.gravity, "m/s²", 5),
        version=methods.software()[0][1],
    )
    gathered = Gathered()
    yield from _tests(renderer, campaign, layout, outdated, code, gathered)
    groups, maps = overview.by_specimen(campaign, gathered.rows), overview.measured_maps(campaign, gathered.rows)
    specimens = []
    for name in campaign.specimens:
        pooled = read_specimen(campaign, layout, name)
        gathered.used.versions |= pooled.versions
        specimens.append(specimens_page.of_specimen(campaign, name, pooled, gathered.free_vibrations[name]))
        yield (
            addresses.of_specimen(name),
            renderer.page(
                "specimen",
                addresses.of_specimen(name),
                specimen=specimens[-1],
                groups=[group for group in groups if group.specimen == name],
                maps=[drawn for drawn in maps if drawn.specimen == name],
            ),
            "",
        )
    shown = {
        "tests": gathered.rows,
        "specimens": specimens,
        "warnings": _warnings(gathered.rows, specimens),
        "groups": groups,
        "maps": maps,
        "spans": overview.span_groups(gathered.spans),
        "agreement": agreement({row.id: row.record.model_dump() for row in gathered.rows}),
        "channels": gathered.channels,
        "used": gathered.used,
        "settings": list(settings(campaign.processing)),
        "references": REFERENCES,
        "software": methods.software(),
        "rule": RULE,
        "estimators": ESTIMATORS.values(),
        "within": f"{WITHIN:.0%}",
        "least_motion": LEAST_MOTION,
    }
    for template, address in addresses.WHOLE.items():
        yield address, renderer.page(template, address, **shown), ""


def _warnings(tests: list[TestRow], specimens: list[SpecimenPage]) -> list[problems.WarningGroup]:
    given = [(row.id, found) for row in tests for found in row.record.warnings]
    given += [(f"specimen {specimen.id}", found) for specimen in specimens for found in specimen.warnings]
    return problems.warning_groups(given)


def _tests(
    renderer: pages.Renderer,
    campaign: Campaign,
    layout: Layout,
    outdated: Collection[str],
    code: str,
    gathered: Gathered,
) -> Iterator[tuple[str, str | None, str]]:
    """Render the page of each test, unless its page says that it was made from the same."""
    ids = [None, *campaign.tests, None]
    elsewhere = campaign.wherever_it_lies()
    records = records_of_tests(campaign, read_summary(layout))
    for before, test, after in zip(ids, campaign.tests.values(), ids[2:], strict=False):
        stored = read_test(campaign, layout, test, is_outdated=test.id in outdated)
        row = TestRow.of(campaign, test, records[test.id], stored)
        gathered.add(campaign, row, stored)
        address = addresses.of_test(test.id)
        made_from = _made_from(elsewhere, row, stored, code, (before, after)) if code else ""
        if made_from and made_from == stamps.key_of(layout.report.parent / address):
            yield address, None, made_from
            continue
        page = tests_page.of_test(campaign, row, stored)
        yield address, renderer.page("test", address, test=page, before=before, after=after), made_from


def _made_from(
    campaign: Campaign, row: TestRow, stored: Stored, code: str, neighbours: tuple[str | None, str | None]
) -> str:
    """Hash of all that the page of a test shows; paths of the campaign are those from its folder."""
    test = campaign.tests[row.id]
    around = (campaign.title, campaign.gravity, tuple(campaign.specimens), campaign.processing.predict.models)
    own = (test, campaign.specimens[test.specimen], campaign.review(test.id))
    found = stored.keys, row.failures, row.record, stored.raw_files
    return hash_of([code, repr((found, around, own, neighbours))])
