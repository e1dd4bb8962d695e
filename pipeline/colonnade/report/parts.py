"""A test in the report: its own page, and its part of the pages about all tests, which is kept as text."""

from __future__ import annotations

import gc
import json
from base64 import b64decode, b64encode
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from pydantic import ConfigDict, TypeAdapter
from pydantic_core import to_json

from colonnade.arrays import Array
from colonnade.figures.stored.record import SpanPanel
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import styled
from colonnade.report import addresses, rows
from colonnade.report.asked import Asked
from colonnade.report.interactive import test_data
from colonnade.report.methods import Used
from colonnade.report.overview import SpanTest
from colonnade.report.pages import rendered
from colonnade.report.pictures import FreeVibration, has_span, span_of
from colonnade.report.rows import TestRow
from colonnade.report.test_page import channels, page
from colonnade.report.test_page.channels import ChannelRow
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Failure, read_test

SELDOM = (200_000, 20, 100)
"""Thresholds of the garbage collector while pages are drawn: what a page makes stays young."""


class Kept(NamedTuple):
    """What of a test is kept, besides what the campaign and its record give."""

    failures: tuple[Failure, ...]
    channels: tuple[ChannelRow, ...]
    thumbnail: str
    panel: SpanPanel | None
    described: str
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
        row = TestRow.known(asked.campaign, asked.campaign.tests[asked.test], asked.record, kept.failures)
        return cls(row, kept, None if kept.panel is None else SpanTest(row, kept.panel, kept.described))


def drawn(layout: Layout, asked: Asked) -> tuple[list[str], str]:
    """Read a test and draw its page: the page, the script with its samples, and its part as text."""
    with seldom_collected(), styled():
        return _drawn(layout, asked)


def _drawn(layout: Layout, asked: Asked) -> tuple[list[str], str]:
    campaign, test = asked.campaign, asked.campaign.tests[asked.test]
    stored = read_test(campaign, layout, test, outdated="" if asked.is_outdated else None, with_samples=True)
    one, used, panel, described = OfTest(campaign, test, asked.record, stored), Used(), None, ""
    used.gather(test.id, stored)
    if has_span(one):
        span = span_of(one)
        panel, described = span.panel.thinned(), span.description
    shown = page.of_test(one, asked.photos) | {"before": asked.before, "after": asked.after}
    text, pictures = rendered(campaign, "test", addresses.of_test(test.id), **shown)
    data = test_data.of_test(one, pictures)
    kept = Kept(
        tuple(one.failures),
        channels.of_test(stored),
        rows.polyline(one.measured_ratio()),
        panel,
        described,
        FreeVibration.of(one) if stored.has("restitution") else None,
        used,
    )
    return [text, data], to_json(kept, fallback=_without_array).decode()


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
