"""The pages about specimens and about the whole campaign, made from the store even if tests failed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from colonnade.assessment.criteria import NOT_COMPUTED
from colonnade.campaign import Campaign
from colonnade.campaign.settings import settings
from colonnade.identification.response.base_motion import LEAST_MOTION
from colonnade.identification.response.rank import WITHIN
from colonnade.report import addresses, methods, overview, pictures, specimens_page
from colonnade.report.assessments_page import assessments_page
from colonnade.report.forecasts_page import forecasts_page
from colonnade.report.interactive import panels
from colonnade.report.interactive.scripts import scripts
from colonnade.report.methods import REFERENCES, Used
from colonnade.report.overview import attention, confusions, peak_points, peaks_picture, warning_groups, worst
from colonnade.report.pages import rendered
from colonnade.report.parts import Part
from colonnade.store.layout import Layout
from colonnade.store.records import advice as advising
from colonnade.store.records.advice import Advice
from colonnade.store.records.summary import read_summary
from colonnade.store.records.wording import agreement
from colonnade.store.results import models_moving, models_shown
from colonnade.units.text import format_percent

Pages = Iterator[tuple[str, str]]
"""Address and text of pages and scripts."""


def specimen_page(campaign: Campaign, layout: Layout, name: str, parts: Sequence[Part]) -> Pages:
    """Give the data and the page of a specimen, whose tests are among those of `parts`."""
    shown = {
        "specimen": _specimen(campaign, layout, name, parts),
        "models": models_moving(campaign, name, models_shown(campaign)),
        "thumbnails": {part.row.id: part.kept.thumbnail for part in parts},
    }
    yield from _page(campaign, "specimen", addresses.of_specimen(name), shown)


def whole_pages(campaign: Campaign, layout: Layout, parts: Sequence[Part], advice: Sequence[Advice] = ()) -> Pages:
    """
    Give the pages about the whole campaign with their scripts, the overview last.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
        Where its results are. Tests that failed or were never run are reported as such.
    parts : sequence of Part
        Of all tests.
    advice : sequence of Advice, optional
        On the next tests.
    """
    used = Used()
    specimens = [_specimen(campaign, layout, name, parts) for name in campaign.of_interest]
    for part in parts:
        used.add(part.kept.used)
    for specimen in specimens:
        used.versions |= specimen["subject"].pooled.versions
    yield from scripts().items()
    summary, rows = read_summary(layout), [part.row for part in parts]
    foreseen, assessed = forecasts_page(layout, summary), assessments_page(campaign, layout, summary)
    asked = models_shown(campaign)
    # Bodies that do not rock as one block are predicted by one model alone, whatever is asked for.
    models = [model for model in asked if any(row.predicted(model).outcome for row in rows)] or asked
    warned = [(row.id, found) for row in rows for found in row.record.warnings]
    warned += [(f"specimen {one['id']}", found) for one in specimens for found in one["warnings"]]
    warned += [(f"assessment {one.name}", found) for one in assessed for found in one.warned()]
    warnings, mistaken, furthest = warning_groups(warned), confusions(rows, models), worst(rows, models)
    shown = {
        "tests": rows,
        "thumbnails": {part.row.id: part.kept.thumbnail for part in parts},
        "models": models,
        "specimens": specimens,
        "warnings": warnings,
        "attention": attention(rows, models, warnings, mistaken, {one.name: one.record for one in assessed}),
        "confusions": mistaken,
        "worst": furthest,
        "peaks": peaks_picture(peak_points(rows, models, furthest)),
        "spans": overview.span_groups([part.span for part in parts if part.span is not None]),
        "agreement": agreement({row.id: row.record.model_dump() for row in rows}),
        "channels": {part.row.id: part.kept.channels for part in parts},
        "doubtful": [
            (part.row.id, bad) for part in parts if (bad := [one for one in part.kept.channels if not one.is_good])
        ],
        "used": used,
        "settings": settings(campaign.processing, "processing") | settings(campaign.next, "next"),
        "references": REFERENCES,
        "software": methods.software(),
        "within": format_percent(WITHIN),
        "least_motion": format_percent(LEAST_MOTION, 1),
        "forecasts": foreseen,
        "advice_heads": [f"#{head}" if head in ("risk", "tests left") else head for head in advising.HEADS],
        "advice": [each.row() for each in advice],
        "assessments": assessed,
        "not_computed": NOT_COMPUTED,
    }
    if campaign.assessments:
        yield from _page(campaign, "assessments", addresses.ASSESSMENTS, shown)
    if foreseen:
        yield from _page(campaign, "forecasts", addresses.FORECASTS, shown)
    for template, address in addresses.WHOLE.items():
        yield from _page(campaign, template, address, shown)


def _specimen(campaign: Campaign, layout: Layout, name: str, parts: Sequence[Part]) -> dict[str, Any]:
    own = [part for part in parts if part.row.test.specimen == name]
    rows, free = [part.row for part in own], [part.kept.free_vibration for part in own if part.kept.free_vibration]
    records, spans = {row.id: row.record for row in rows}, [part.span for part in own if part.span]
    return specimens_page.of_specimen(pictures.of_specimen(campaign, layout, name, records, free, spans), rows)


def _page(campaign: Campaign, template: str, address: str, shown: Mapping[str, Any]) -> Pages:
    """Render a page that shows several tests, and its data."""
    text, drawn = rendered(campaign, template, address, **shown)
    yield addresses.of_data(address), panels.of_page(address, drawn)
    yield address, text
