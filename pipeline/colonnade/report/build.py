"""The report: self-contained pages, made from the store even if tests failed."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Iterable, Iterator, Mapping, MutableMapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from colonnade.assessment.criteria import NOT_COMPUTED
from colonnade.campaign import Campaign
from colonnade.campaign.settings import settings
from colonnade.identification.response.base_motion import LEAST_MOTION
from colonnade.identification.response.rank import WITHIN
from colonnade.identification.restitution.choice import RULE
from colonnade.identification.restitution.estimators.registry import ESTIMATORS
from colonnade.interruption import expect_none
from colonnade.report import addresses, drawings, methods, pages, problems, specimens_page
from colonnade.report.asked import Asked, asked_of
from colonnade.report.assessments_page.page import AssessmentShown, assessments_page, symbol
from colonnade.report.forecasts_page.page import forecasts_page
from colonnade.report.interactive import tables
from colonnade.report.interactive.scripts import scripts
from colonnade.report.interactive.state import UNWATCHED
from colonnade.report.kept import ALTERED, from_text, to_text
from colonnade.report.methods import Used
from colonnade.report.overview_page import groups, maps, peaks, spans
from colonnade.report.overview_page.agreement import agreement
from colonnade.report.overview_page.attention import attention
from colonnade.report.overview_page.confusion import confusions
from colonnade.report.parts import Part, is_drawn, parts_of
from colonnade.report.references import REFERENCES
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import SpecimenPage
from colonnade.store import files, stamps
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.records import advice as advising
from colonnade.store.records.advice import Advice
from colonnade.store.records.assessment import NOT_COVERED
from colonnade.store.records.stored import read_specimen
from colonnade.store.records.summary import read_summary
from colonnade.units import format_percent

IN_A_BLOCK = 2
"""Tests whose pages are drawn one after the other: few, so that no process waits long for the last of another."""

OWN = ("tests/*.html", "specimens/*.html", "data/**/*.js", "scripts/*.js", "setups/*.svg", *addresses.OPTIONAL)
"""Files of the report's folders; one that nothing of the campaign leads to any more is removed."""

Block = tuple[Campaign, list[Asked]]
"""Some tests whose pages are asked for, and their campaign."""

Rendered = tuple[str, str | None, str]
"""A page: its address, its text, and a hash of what it is made from; see `render`."""

Spread = Callable[[Callable[[Block], list[Part]], list[Block]], Iterable[list[Part]]]


def build(
    campaign: Campaign,
    layout: Layout,
    outdated: Collection[str] = (),
    advice: Sequence[Advice] = (),
    *,
    code: str = "",
    key: str = "",
    kept: MutableMapping[str, str] | None = None,
    spread: Spread = map,
) -> Path:
    """
    Write the report of a campaign.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
        Where its results are. Tests that failed or were never run are reported as such.
    outdated : collection of str, optional
        Tests whose stored results are out of date: they are pending, and not shown.
    advice : sequence of Advice, optional
        On the next tests.
    code : str, optional
        Hash of the code. With it, pages of tests and specimens that would come out the same are not drawn again.
    key : str, optional
        Hash of all that the report is made from, for the stamp of the pages about the whole campaign.
    kept : dict of str to str, optional
        Parts of tests as text, by test (`report.kept`): of tests that are here neither the results are read nor the
        page is drawn; the others are added.
    spread : callable, optional
        Calls a function once for each item, as `map` does, in other processes if it likes, in any order.

    Returns
    -------
    overview : Path
        ``report/index.html``; the others are next to it. The same results give the same bytes, and an unchanged page is
        not written again. Pages of tests and specimens that have left the campaign are removed. The state script is
        written only if it is missing: it may be that of a watch in progress.

    Raises
    ------
    StoreError
        If a page cannot be written.
    """
    folder = layout.report.parent
    there = set()
    if not layout.state.is_file():
        files.write_text(layout.state, UNWATCHED)
    for address, text, made_from in render(campaign, layout, outdated, advice, code=code, kept=kept, spread=spread):
        expect_none()
        if text is not None:
            files.write_text(folder / address, stamps.stamped(text, made_from or key, script=address.endswith(".js")))
        there.add(folder / address)
    for stale in {path for pattern in OWN for path in folder.glob(pattern)} - there:
        files.remove(stale)
    return layout.report


def render(
    campaign: Campaign,
    layout: Layout,
    outdated: Collection[str] = (),
    advice: Sequence[Advice] = (),
    *,
    code: str = "",
    kept: MutableMapping[str, str] | None = None,
    spread: Spread = map,
) -> Iterator[Rendered]:
    """
    Render the pages, the overview last.

    Yields
    ------
    address : str
        Within the report's folder.
    text : str or None
        None if the page of a test or specimen, or a drawing, is up to date.
    made_from : str
        Of the page of a test or specimen and of a drawing: hash of what it shows.
    """
    renderer = pages.renderer_of(campaign)
    yield from drawings.files(campaign, layout.report.parent, code)
    asked = asked_of(campaign, layout, outdated)
    tests = yield from _tests(campaign, layout, code, asked, {} if kept is None else kept, spread)
    rows, used = [part.row for part in tests], Used()
    for part in tests:
        used.add(part.used)
    grouped, mapped = groups.by_specimen(campaign, rows), maps.measured_maps(campaign, layout, rows)
    specimens = yield from _specimens(campaign, layout, code, renderer, tests, grouped, mapped)
    for page in specimens:
        used.versions |= page.subject.pooled.versions
    for address, text in scripts().items():
        yield address, text, ""
    summary = read_summary(layout)
    foreseen, assessed = forecasts_page(layout, summary), assessments_page(campaign, layout, summary)
    shown = _shown(campaign, tests, specimens, assessed, used) | {
        "groups": grouped,
        "maps": mapped,
        "forecasts": foreseen,
        "advice": {"heads": advising.HEADS, "rows": [each.row() for each in advice]},
        "assessments": assessed,
        "symbol": symbol,
        "not_covered": NOT_COVERED,
        "not_computed": NOT_COMPUTED,
    }
    if campaign.assessments:
        yield from _page(renderer, "assessments", addresses.ASSESSMENTS, shown)
    if foreseen is not None:
        yield from _page(renderer, "forecasts", addresses.FORECASTS, shown)
    for template, address in addresses.WHOLE.items():
        yield from _page(renderer, template, address, shown)


def _tests(
    campaign: Campaign,
    layout: Layout,
    code: str,
    asked: Sequence[Asked],
    kept: MutableMapping[str, str],
    spread: Spread,
) -> Generator[Rendered, None, list[Part]]:
    """Draw the pages of tests whose parts are not kept, and return the parts of all tests."""
    found = _known(campaign, asked, kept)
    for part in found.values():
        yield addresses.of_test(part.row.id), None, part.made_from
        yield addresses.of_data(addresses.of_test(part.row.id)), None, part.made_from
    missing = [each for each in asked if each.test not in found]
    blocks = [missing[start : start + IN_A_BLOCK] for start in range(0, len(missing), IN_A_BLOCK)]
    for parts in spread(partial(_drawn, layout, code), [(_with(campaign, block), block) for block in blocks]):
        for part in parts:
            yield addresses.of_test(part.row.id), part.text, part.made_from
            yield addresses.of_data(addresses.of_test(part.row.id)), part.data, part.made_from
            found[part.row.id] = replace(part, text=None, data=None)
            kept[part.row.id] = to_text(part)
    return [found[name] for name in campaign.tests]


def _specimens(
    campaign: Campaign,
    layout: Layout,
    code: str,
    renderer: pages.Renderer,
    tests: Sequence[Part],
    grouped: Sequence[groups.SpecimenGroup],
    mapped: Sequence[maps.MeasuredMap],
) -> Generator[Rendered, None, list[SpecimenPage]]:
    """Render the pages of specimens that are out of date, and return what all of them show."""
    specimens = []
    for name in campaign.specimens:
        own = [part for part in tests if part.row.test.specimen == name]
        free = [part.free_vibration for part in own if part.free_vibration]
        specimens.append(specimens_page.of_specimen(campaign, name, read_specimen(campaign, layout, name), free))
        address, made_from = addresses.of_specimen(name), _made_from(campaign, layout, code, specimens[-1], own)
        if is_drawn(layout, address, made_from):
            yield from ((made, None, made_from) for made in (addresses.of_data(address), address))
            continue
        shown = {
            "specimen": specimens[-1],
            "groups": [group for group in grouped if group.specimen == name],
            "maps": [drawn for drawn in mapped if drawn.specimen == name],
        }
        yield from _page(renderer, "specimen", address, shown, made_from)
    return specimens


def _made_from(campaign: Campaign, layout: Layout, code: str, page: SpecimenPage, own: Iterable[Part]) -> str:
    """Hash all that the page of a specimen shows: its results and maps, and what its tests' pages are made from."""
    if not code:
        return ""
    around = (campaign.title, campaign.gravity, tuple(campaign.specimens), campaign.processing.predict.models)
    tests = {f"test {part.row.id}": part.made_from for part in own}
    results = page.subject.pooled.keys | maps.keys_of(campaign, layout, page.id)
    return Recipe("page", code, repr((around, page)), tests | results).key


def _page(
    renderer: pages.Renderer, template: str, address: str, shown: dict[str, Any], made_from: str = ""
) -> Iterator[Rendered]:
    """Render a page that shows several tests, and its data."""
    text = renderer.page(template, address, **shown)
    yield addresses.of_data(address), tables.of_page(address, renderer.pictures), made_from
    yield address, text, made_from


def _shown(
    campaign: Campaign,
    tests: list[Part],
    specimens: list[SpecimenPage],
    assessed: list[AssessmentShown],
    used: Used,
) -> dict[str, Any]:
    """Give what the pages about the whole campaign show."""
    rows, models = [part.row for part in tests], campaign.processing.predict.models
    findings, mistaken, worst = (
        _warnings(rows, specimens, assessed),
        confusions(rows, models),
        peaks.worst(rows, models),
    )
    return {
        "tests": rows,
        "specimens": specimens,
        "warnings": findings,
        "attention": attention(rows, models, findings, mistaken, {one.name: one.record for one in assessed}),
        "confusions": mistaken,
        "worst": worst,
        "peaks": peaks.picture(peaks.points(rows, models, worst)),
        "thumbnails": {part.row.id: part.thumbnail for part in tests},
        "spans": spans.span_groups([part.span for part in tests if part.span is not None]),
        "agreement": agreement({row.id: row.record.model_dump() for row in rows}),
        "channels": {part.row.id: part.channels for part in tests},
        "used": used,
        "settings": list(settings(campaign.processing, campaign.next)),
        "references": REFERENCES,
        "software": methods.software(),
        "rule": RULE,
        "estimators": ESTIMATORS.values(),
        "within": format_percent(WITHIN),
        "least_motion": format_percent(LEAST_MOTION, 1),
    }


def _warnings(
    tests: list[TestRow], specimens: list[SpecimenPage], assessed: list[AssessmentShown]
) -> list[problems.WarningGroup]:
    given = [(row.id, found) for row in tests for found in row.record.warnings]
    given += [(f"specimen {specimen.id}", found) for specimen in specimens for found in specimen.warnings]
    given += [(f"assessment {one.name}", found) for one in assessed for found in one.warned()]
    return problems.warning_groups(given)


def _with(campaign: Campaign, block: Iterable[Asked]) -> Campaign:
    """Give the campaign with the tests of a block alone, which is light to send to another process."""
    return campaign.but(tests={asked.test: campaign.tests[asked.test] for asked in block})


def _drawn(layout: Layout, code: str, block: Block) -> list[Part]:
    campaign, asked = block
    return parts_of(campaign, layout, code, asked)


def _known(campaign: Campaign, every: Iterable[Asked], kept: Mapping[str, str]) -> dict[str, Part]:
    """Read the parts that are kept; one whose text was altered is left out."""
    found = {}
    for asked in every:
        if asked.test in kept:
            with suppress(*ALTERED):
                found[asked.test] = from_text(campaign, asked.test, asked.record, kept[asked.test])
    return found
