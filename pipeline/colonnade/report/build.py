"""The report: pages that stand alone, made from the store whatever became of the tests."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import settings
from colonnade.identification.base_motion import LEAST_MOTION
from colonnade.identification.restitution.choice import RULE
from colonnade.identification.verdict import WITHIN
from colonnade.interruption import expect_none
from colonnade.report import (
    channels,
    charts,
    methods,
    overview,
    pages,
    problems,
    results,
    rows,
    specimens_page,
    tests_page,
    wording,
)
from colonnade.report.channels import ChannelRow
from colonnade.report.methods import Used
from colonnade.report.overview import SpanTest
from colonnade.report.references import REFERENCES
from colonnade.report.results import NOTHING, Results
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import FreeVibration
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of

_HEAD = 1000
"""Characters of a page within which it says what it was made from."""


@dataclass
class Gathered:
    """What is kept of the tests for the pages about all of them, light enough for thousands."""

    rows: list[TestRow] = field(default_factory=list)
    channels: dict[str, tuple[ChannelRow, ...]] = field(default_factory=dict)
    spans: list[SpanTest] = field(default_factory=list)
    free_vibrations: defaultdict[str, list[FreeVibration]] = field(default_factory=lambda: defaultdict(list))
    used: Used = field(default_factory=Used)

    def add(self, campaign: Campaign, test: Test, found: Results, row: TestRow) -> None:
        """Keep of a test what the other pages show."""
        self.rows.append(row)
        self.channels[test.id] = channels.of_test(found)
        self.used.gather(test.id, found)
        if test.span is not None and any("rocking_angle" in dataset for dataset in found.datasets.values()):
            panel = charts.span_panel(test, found, campaign.block(test.specimen))
            self.spans.append(SpanTest(test, row, panel, charts.seen(test, found)))
        if "restitution" in found.datasets:
            vibration = specimens_page.free_vibration(test, found, campaign.block(test.specimen))
            self.free_vibrations[test.specimen].append(vibration)


def build(campaign: Campaign, layout: Layout, outdated: Collection[str] = (), *, code: str = "") -> Path:
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
        Hash of the program's sources. With it, pages of tests that would come out the same are not drawn again.

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
    for address, text in render(campaign, layout, outdated, code=code):
        expect_none()
        if text is not None:
            files.write_text(folder / address, text)
        there.add(folder / address)
    for stale in {*folder.glob("tests/*.html"), *folder.glob("specimens/*.html")} - there:
        files.remove(stale)
    return layout.report


def render(
    campaign: Campaign, layout: Layout, outdated: Collection[str] = (), *, code: str = ""
) -> Iterator[tuple[str, str | None]]:
    """Return each page's address within the report's folder and its text, None where it stands; the overview last."""
    renderer = pages.Renderer(
        campaign=campaign,
        models=campaign.processing.predict.models,
        gravity=wording.quantity(campaign.gravity, "m/s²", 5),
        version=methods.software()[0][1],
    )
    gathered = Gathered()
    yield from _tests(renderer, campaign, layout, outdated, code, gathered)
    groups, maps = overview.by_specimen(campaign, gathered.rows), overview.measured_maps(campaign, gathered.rows)
    specimens = []
    for name in campaign.specimens:
        pooled = results.of_specimen(campaign, layout, name)
        gathered.used.versions |= dict.fromkeys(pooled.versions)
        specimens.append(specimens_page.of_specimen(campaign, name, pooled, gathered.free_vibrations[name]))
        yield (
            pages.of_specimen(name),
            renderer.page(
                "specimen",
                pages.of_specimen(name),
                specimen=specimens[-1],
                groups=[group for group in groups if group.specimen == name],
                maps=[drawn for drawn in maps if drawn.specimen == name],
            ),
        )
    shown = {
        "tests": gathered.rows,
        "specimens": specimens,
        "warnings": problems.warning_groups(gathered.rows, specimens),
        "groups": groups,
        "maps": maps,
        "spans": overview.span_groups(gathered.spans),
        "agreement": overview.agreement(gathered.rows, campaign.processing.predict.models),
        "channels": gathered.channels,
        "used": gathered.used,
        "settings": list(settings(campaign.processing)),
        "references": REFERENCES,
        "software": methods.software(),
        "rule": RULE,
        "within": f"{WITHIN:.0%}",
        "least_motion": LEAST_MOTION,
    }
    for template, address in pages.WHOLE.items():
        yield address, renderer.page(template, address, **shown)


def _tests(
    renderer: pages.Renderer,
    campaign: Campaign,
    layout: Layout,
    outdated: Collection[str],
    code: str,
    gathered: Gathered,
) -> Iterator[tuple[str, str | None]]:
    """Render the page of each test whose page does not say that it was made from the same."""
    ids = [None, *campaign.tests, None]
    elsewhere = campaign.wherever_it_lies()
    for before, test, after in zip(ids, campaign.tests.values(), ids[2:], strict=False):
        found = NOTHING if test.id in outdated else results.of_test(campaign, layout, test)
        row = rows.of_test(campaign, test, found)
        gathered.add(campaign, test, found, row)
        address = pages.of_test(test.id)
        made_from = _made_from(elsewhere, test.id, found, code, (before, after)) if code else ""
        if made_from and made_from in _head(layout.report.parent / address):
            yield address, None
            continue
        page = tests_page.of_test(campaign, test, found, row)
        yield address, renderer.page("test", address, test=page, before=before, after=after, made_from=made_from)


def _made_from(
    campaign: Campaign, name: str, found: Results, code: str, neighbours: tuple[str | None, str | None]
) -> str:
    """Hash of all that the page of a test shows; paths of the campaign are those from its folder."""
    test = campaign.tests[name]
    around = (campaign.title, campaign.gravity, tuple(campaign.specimens), campaign.processing.predict.models)
    own = (test, campaign.specimens[test.specimen], campaign.review(test.id))
    told = found.keys, found.failures, found.warnings, found.raw_files
    return hash_of([code, repr((told, around, own, neighbours))])


def _head(page: Path) -> str:
    try:
        with page.open(encoding="utf-8", errors="replace") as stream:
            return stream.read(_HEAD)
    except OSError:
        return ""
