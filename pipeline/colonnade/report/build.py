"""The pages: of a test with its part of the pages about all tests, of specimens, and of the whole campaign."""

from __future__ import annotations

import gc
import json
import re
from base64 import b64decode, b64encode
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup
from pydantic import ConfigDict, TypeAdapter
from pydantic_core import to_json

from colonnade import __version__
from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.campaign.settings import settings
from colonnade.dynamics.models import MODELS
from colonnade.errors import count
from colonnade.figures.files.output import Picture, link_to
from colonnade.figures.stored.record import SpanPanel
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import styled
from colonnade.identification.response.base_motion import LEAST_MOTION
from colonnade.identification.response.rank import WITHIN
from colonnade.report import addresses, methods, overview, pictures, specimens_page
from colonnade.report.addresses import of_specimen, of_test, scripts, scripts_of, way
from colonnade.report.asked import Asked
from colonnade.report.assessments_page import assessments_page, symbol
from colonnade.report.forecasts_page import forecasts_page
from colonnade.report.interactive import panels, test_data
from colonnade.report.methods import Used
from colonnade.report.overview import SpanTest, TestRow
from colonnade.report.pictures import FreeVibration, picture, pictures_in, span_of
from colonnade.report.test_page import channels, facts, page
from colonnade.report.test_page.channels import ChannelRow
from colonnade.store.layout import Layout
from colonnade.store.records import advice as advising
from colonnade.store.records import wording
from colonnade.store.records.advice import Advice
from colonnade.store.records.assessment import deciding, estimated
from colonnade.store.records.forecast import shown_table
from colonnade.store.records.stored import Failure, read_test
from colonnade.store.records.summary import read_summary
from colonnade.store.records.test import predicted_peak_time
from colonnade.store.records.wording import agreement
from colonnade.store.results import models_moving, models_shown
from colonnade.units import text
from colonnade.units.text import format_percent

_SECTION = re.compile(r'<section id="([\w-]+)"(?: data-paper="no")?>\s*<h2>(.*?)</h2>', re.DOTALL)
"""Id and title of a section, as templates write them: for the table of contents of a page."""

_MARK = re.compile(f'href="{link_to("")}([^"]+)"')
"""Link of a mark in a figure to a test."""


_DRAWN: ContextVar[list[Picture]] = ContextVar("drawn")
"""Pictures of the page that is being rendered."""


def rendered(campaign: Campaign, template: str, address: str, **given: Any) -> tuple[str, list[Picture]]:
    """Return the page that stands at an address within the report's folder, and its pictures."""
    drawn: list[Picture] = []
    token = _DRAWN.set(drawn)
    root = "../" * address.count("/")
    common = {
        "campaign": campaign,
        "models": models_shown(campaign),
        "forecasts": None,  # a forecast that is added draws no page of a test or specimen again
        "here": address,
        "root": root,
    }
    text = _environment().get_template(f"{template}.html.jinja").render(common | given)
    _DRAWN.reset(token)
    return _MARK.sub(lambda found: f'href="{root}{of_test(found[1])}"', text), drawn


def _svg(picture: Picture) -> Markup:
    """Give the `<svg>` of a picture, and note that the page shows it."""
    _DRAWN.get().append(picture)
    return Markup(picture.svg)


@cache
def _environment() -> Environment:
    """Return the templates with what they use; text of users is escaped."""
    environment = Environment(
        loader=PackageLoader("colonnade.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.globals |= {
        "count": count,
        "picture": picture,
        "pictures_in": pictures_in,
        "listed": text.listed,
        "test_page": of_test,
        "scripts_of": scripts_of,
        "specimen_page": of_specimen,
        "sections": _SECTION.findall,
        "peak_time": predicted_peak_time,
        "registry": MODELS,
        "symbol": symbol,
        "deciding": deciding,
        "estimated": estimated,
        "version": __version__,
        "way": way,
        "who_and_when": facts.who_and_when,
    }
    environment.filters |= {
        "setting": _setting,
        "number": text.number,
        "quantity": text.quantity,
        "acceleration": text.acceleration,
        "order": wording.order,
        "by_bodies": wording.by_bodies,
        "table": shown_table,
        "ratio": text.ratio,
        "signed_ratio": signed_ratio,
        "percent": format_percent,
        "drawn": _svg,
    }
    for name in ("parts", "groups"):
        environment.globals |= vars(environment.get_template(f"{name}.html.jinja").module)
    return environment


def signed_ratio(value: float) -> str:
    """
    Write a difference of angles over the critical angle with its sign, as `ratio` does.

    Examples
    --------
    >>> signed_ratio(0.0123), signed_ratio(-0.5), signed_ratio(-4e-6), signed_ratio(float("nan"))
    ('+0.012', '−0.5', '< 0.001', '–')
    """
    return text.with_minus(f"{value:+.2g}") if text.LEAST_RATIO <= abs(value) < np.inf else text.ratio(value)


def _setting(setting: Mapping[str, Any]) -> str:
    """Write a setting's value with its unit."""
    value = setting["value"]
    if isinstance(value, (list, tuple)):
        return ", ".join(map(str, value))
    if isinstance(value, str):
        return value
    return f"{value:g} {setting['unit']}".rstrip()


SELDOM = (200_000, 20, 100)
"""Thresholds of the garbage collector while pages are drawn: what a page makes stays young."""


class Kept(NamedTuple):
    """What of a test is kept, besides what the campaign and its record give."""

    failures: tuple[Failure, ...]
    channels: tuple[ChannelRow, ...]
    thumbnail: str
    span: tuple[SpanPanel, str] | None
    free_vibration: FreeVibration | None
    used: Used


_KEPT = TypeAdapter(Kept, config=ConfigDict(arbitrary_types_allowed=True))


def _without_array(array: Array) -> dict[str, str]:
    """Write an array as JSON can hold it."""
    return {"dtype": array.dtype.str, "bytes": b64encode(array.tobytes()).decode()}


def _with_array(given: dict[str, Any]) -> Any:
    """Read what may be such an array."""
    is_array = given.keys() == {"dtype", "bytes"}
    return np.frombuffer(b64decode(given["bytes"]), dtype=given["dtype"]) if is_array else given


class Part(NamedTuple):
    """A test on the pages about all tests: its row, what is kept of it, and of an earthquake its Span."""

    row: TestRow
    kept: Kept
    span: SpanTest | None

    @classmethod
    def of(cls, asked: Asked, text: str) -> Part:
        """Read a part from the text that `drawn` gave."""
        kept = _KEPT.validate_python(json.loads(text, object_hook=_with_array))
        row = TestRow.of(asked.campaign, asked.campaign.tests[asked.test], asked.record, kept.failures)
        return cls(row, kept, None if kept.span is None else SpanTest(row, *kept.span))


@contextmanager
def seldom_collected() -> Iterator[None]:
    """
    Look for garbage once, at the end, and only at what is new: a figure is thousands of objects that live for a page.

    Going through all libraries' objects for them takes a fifth of the time of a page.
    """
    thresholds = gc.get_threshold()
    gc.set_threshold(*SELDOM)
    try:
        yield
    finally:
        gc.collect(1)
        gc.set_threshold(*thresholds)


@styled()
@seldom_collected()
def drawn(layout: Layout, asked: Asked) -> tuple[list[str], str]:
    """Read a test and draw its page: the page, the script with its samples, and its part as text."""
    campaign, test = asked.campaign, asked.campaign.tests[asked.test]
    stored = read_test(campaign, layout, test, is_outdated=asked.is_outdated, with_samples=True)
    one, used = OfTest(campaign, test, asked.record, stored), Used()
    used.gather(test.id, stored)
    span = span_of(one)
    shown = page.of_test(one, asked.photos) | {"before": asked.before, "after": asked.after}
    text, pictures = rendered(campaign, "test", addresses.of_test(test.id), **shown)
    data = test_data.of_test(one, pictures)
    kept = Kept(
        tuple(one.failures),
        channels.of_test(stored),
        overview.polyline(one.measured_ratio()),
        None if span is None else (span.panel.thinned(), span.description),
        FreeVibration.of(one) if stored.has("restitution") else None,
        used,
    )
    return [text, data], to_json(kept, fallback=_without_array).decode()


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
    warnings = overview.warning_groups(warned)
    mistaken, furthest = overview.confusions(rows, models), overview.worst(rows, models)
    shown = {
        "tests": rows,
        "thumbnails": {part.row.id: part.kept.thumbnail for part in parts},
        "models": models,
        "specimens": specimens,
        "warnings": warnings,
        "attention": overview.attention(rows, models, warnings, mistaken, {one.name: one.record for one in assessed}),
        "confusions": mistaken,
        "worst": furthest,
        "peaks": overview.peaks_picture(overview.peak_points(rows, models, furthest)),
        "spans": overview.span_groups([part.span for part in parts if part.span is not None]),
        "agreement": agreement({row.id: row.record.model_dump() for row in rows}),
        "channels": {part.row.id: part.kept.channels for part in parts},
        "doubtful": [
            (part.row.id, bad) for part in parts if (bad := [one for one in part.kept.channels if not one["is_good"]])
        ],
        "used": used,
        "settings": settings(campaign.processing, "processing") | settings(campaign.next, "next"),
        "software": methods.software(),
        "within": format_percent(WITHIN),
        "least_motion": format_percent(LEAST_MOTION, 1),
        "forecasts": foreseen,
        "advice_heads": [f"#{head}" if head in ("risk", "tests left") else head for head in advising.HEADS],
        "advice": [each.row() for each in advice],
        "assessments": assessed,
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
