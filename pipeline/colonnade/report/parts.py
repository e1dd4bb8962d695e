"""A test in the report: its own page, and its part of the pages about all tests, which is kept as text."""

from __future__ import annotations

import gc
import json
from base64 import b64decode, b64encode
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np

from colonnade.figures.stored.record import SpanPanel, measured_ratio
from colonnade.figures.style import styled
from colonnade.report import addresses, pages, rows, specimens_page
from colonnade.report.asked import Asked
from colonnade.report.interactive import test_data
from colonnade.report.methods import Used
from colonnade.report.overview_page.groups import SpanTest
from colonnade.report.pictures.subjects import OfTest, has_span, span_of
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import FreeVibration
from colonnade.report.test_page import channels, page
from colonnade.report.test_page.channels import ChannelRow
from colonnade.store.layout import Layout
from colonnade.store.records.stored import WITHOUT_SAMPLES, Failure, read_test

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


@dataclass(frozen=True)
class Part:
    """
    A test on the pages about all tests.

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
    """

    row: TestRow
    channels: tuple[ChannelRow, ...]
    thumbnail: str
    span: SpanTest | None
    free_vibration: FreeVibration | None
    used: Used

    @classmethod
    def of(cls, asked: Asked, text: str) -> Part:
        """Read a part from the text that `drawn` gave."""
        kept: Kept = _typed(Kept, json.loads(text))
        row = TestRow.known(asked.campaign, asked.campaign.tests[asked.test], asked.record, kept.failures)
        span = None if kept.panel is None else SpanTest(row, kept.panel, kept.described)
        return cls(row, kept.channels, kept.thumbnail, span, kept.free_vibration, kept.used)


def drawn(layout: Layout, asked: Asked) -> tuple[list[str], str]:
    """Read a test and draw its page: the page, the script with its samples, and its part as text."""
    with seldom_collected(), styled():
        return _drawn(pages.renderer_of(asked.campaign), layout, asked)


def _drawn(renderer: pages.Renderer, layout: Layout, asked: Asked) -> tuple[list[str], str]:
    campaign, test = asked.campaign, asked.campaign.tests[asked.test]
    stored = read_test(campaign, layout, test, outdated="" if asked.is_outdated else None, with_samples=True)
    row = TestRow.of(campaign, test, asked.record, stored)
    subject, used, panel, described = OfTest(campaign, row, stored), Used(), None, ""
    used.gather(test.id, stored)
    if has_span(subject):
        span = span_of(subject)
        panel, described = span.panel.thinned(), span.description
    shown = page.of_test(campaign, row, stored, asked.photos)
    address = addresses.of_test(test.id)
    text = renderer.page("test", address, test=shown, before=asked.before, after=asked.after)
    samples = (stored.datasets.get((stage, None)) for stage in WITHOUT_SAMPLES)
    data = test_data.of_test(campaign, test, stored, renderer.pictures, *samples)
    kept = Kept(
        tuple(row.failures),
        channels.of_test(stored),
        rows.polyline(measured_ratio(stored, campaign.block(test.specimen))),
        panel,
        described,
        specimens_page.free_vibration(subject) if stored.has("restitution") else None,
        used,
    )
    return [text, data], json.dumps(_plain(kept), separators=(",", ":"))


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


def _plain(value: Any) -> Any:
    """Write a value as JSON can hold it: arrays by their bytes, records as lists."""
    if isinstance(value, np.ndarray):
        return [value.dtype.str, b64encode(value.tobytes()).decode()]
    if is_dataclass(value) and not isinstance(value, type):
        return [_plain(getattr(value, field.name)) for field in fields(value)]
    if isinstance(value, Mapping):
        return {name: _plain(each) for name, each in value.items()}
    return [_plain(each) for each in value] if isinstance(value, (list, tuple)) else value


def _typed(kind: Any, plain: Any) -> Any:
    """Make a value of a type from what `_plain` gave."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is np.ndarray:
        return np.frombuffer(b64decode(plain[1]), dtype=plain[0])
    if type(None) in arguments:
        return None if plain is None else _typed(next(each for each in arguments if each is not type(None)), plain)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return {name: _typed(arguments[1], each) for name, each in plain.items()}
    if origin is not None:
        values = [_typed(arguments[0], each) for each in plain]
        return tuple(values) if origin is tuple else values
    if is_dataclass(kind) or hasattr(kind, "_fields"):
        names = [field.name for field in fields(kind)] if is_dataclass(kind) else kind._fields
        hints = get_type_hints(kind)
        return kind(*(_typed(hints[name], each) for name, each in zip(names, plain, strict=True)))
    return plain
