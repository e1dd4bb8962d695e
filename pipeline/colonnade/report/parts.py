"""What the report draws and keeps of each test: its own page, and its part of the pages about all tests."""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from colonnade.campaign import Campaign
from colonnade.figures.stored.curves import measured_ratio
from colonnade.figures.style import styled
from colonnade.report import addresses, pages, specimens_page
from colonnade.report.asked import Asked, shows
from colonnade.report.interactive import test_data
from colonnade.report.methods import Used
from colonnade.report.overview_page import thumbnails
from colonnade.report.overview_page.spans import SpanTest
from colonnade.report.pictures.subjects import OfTest, has_span, span_of
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import FreeVibration
from colonnade.report.test_page import channels, page
from colonnade.report.test_page.channels import ChannelRow
from colonnade.store import stamps
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.records.stored import WITHOUT_SAMPLES, read_test

SELDOM = (200_000, 20, 100)
"""Thresholds of the garbage collector while pages are drawn: about once a page."""


@dataclass(frozen=True)
class Part:
    """
    What the report keeps of a test; small enough for thousands of tests once the text is written.

    Attributes
    ----------
    row : TestRow
    channels : tuple of ChannelRow
    thumbnail : str
        Its measured rocking angle as a polyline.
    span : SpanTest or None
        Of an earthquake test with a Span.
    free_vibration : FreeVibration or None
    used : Used
        What its results were made with.
    text, data : str or None
        Its page, and the script with the page's samples; None if both are up to date.
    made_from : str
        Hash of what the page shows; empty if it is not needed.
    """

    row: TestRow
    channels: tuple[ChannelRow, ...]
    thumbnail: str
    span: SpanTest | None
    free_vibration: FreeVibration | None
    used: Used
    text: str | None
    data: str | None
    made_from: str


def parts_of(campaign: Campaign, layout: Layout, code: str, block: Sequence[Asked]) -> list[Part]:
    """
    Read some tests, and draw those of their pages that are out of date.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    code : str
        Hash of the code; if empty, every page is drawn.
    block : sequence of Asked
    """
    renderer = pages.renderer_of(campaign)
    with _seldom_collected(), styled():
        return [_part(renderer, campaign, layout, code, asked) for asked in block]


def is_drawn(layout: Layout, address: str, made_from: str) -> bool:
    """Return whether a page and its data are there and were made from what this hash stands for; never from ""."""
    written = [layout.report.parent / made for made in (address, addresses.of_data(address))]
    return bool(made_from) and all(made_from == stamps.key_of(path) for path in written)


@contextmanager
def _seldom_collected() -> Iterator[None]:
    """
    Look for garbage seldom: a figure is thousands of objects that refer to each other and live for one page.

    Going through all libraries' objects for them takes a fifth of the time of a page.
    """
    thresholds = gc.get_threshold()
    gc.freeze()
    gc.set_threshold(*SELDOM)
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.unfreeze()


def _part(renderer: pages.Renderer, campaign: Campaign, layout: Layout, code: str, asked: Asked) -> Part:
    test = campaign.tests[asked.test]
    block = campaign.block(test.specimen)
    stored = read_test(campaign, layout, test, outdated="" if asked.is_outdated else None, with_samples=True)
    row = TestRow.of(campaign, test, asked.record, stored)
    used, span, free_vibration = Used(), None, None
    used.gather(test.id, stored)
    subject = OfTest(campaign, row, stored)
    if has_span(subject):
        span = span_of(subject)
        span = span._replace(panel=span.panel.thinned())
    if stored.has("restitution"):
        free_vibration = specimens_page.free_vibration(subject)
    address, text, data = addresses.of_test(test.id), None, None
    made_from = ""
    if code:
        made_from = Recipe("page", code, repr((shows(campaign, asked), row.failures)), stored.keys).key
    if not is_drawn(layout, address, made_from):
        shown = page.of_test(campaign, row, stored, asked.photos)
        text = renderer.page("test", address, test=shown, before=asked.before, after=asked.after)
        samples = (stored.datasets.get((stage, None)) for stage in WITHOUT_SAMPLES)
        data = test_data.of_test(campaign, test, stored, renderer.pictures, *samples)
    thumbnail = thumbnails.polyline(measured_ratio(stored, block))
    return Part(row, channels.of_test(stored), thumbnail, span, free_vibration, used, text, data, made_from)
