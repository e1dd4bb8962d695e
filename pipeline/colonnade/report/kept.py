"""Parts of tests as text, so that a report need not read again the results of tests that are as they were."""

from __future__ import annotations

import json
from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.figures.spans import SpanPanel
from colonnade.report.methods import Used
from colonnade.report.overview_page.spans import SpanTest
from colonnade.report.parts import Part
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import FreeVibration
from colonnade.report.test_page.channels import ChannelRow
from colonnade.store.records.stored import Failure

ALTERED = (ValueError, TypeError, KeyError, IndexError, AttributeError)
"""Raised where the text of a part is not as it was written."""


class _Kept(NamedTuple):
    """A part without what the campaign and the record of its test give."""

    failures: tuple[Failure, ...]
    channels: tuple[ChannelRow, ...]
    thumbnail: str
    panel: SpanPanel | None
    described: str
    free_vibration: FreeVibration | None
    used: Used


def to_text(part: Part) -> str:
    """Write a part; the first line is the key of its pages. The same part gives the same text."""
    panel, described = (part.span.panel, part.span.description) if part.span else (None, "")
    kept = _Kept(
        part.row.failures,
        part.channels,
        part.thumbnail,
        panel,
        described,
        part.free_vibration,
        part.used,
    )
    return f"{part.made_from}\n{json.dumps(_plain(kept), separators=(',', ':'))}"


def from_text(campaign: Campaign, test: str, record: TestSummary, text: str) -> Part:
    """
    Read a part again, without page and data.

    Raises
    ------
    ValueError, TypeError, KeyError, IndexError, AttributeError
        If the text is not as it was written, see `ALTERED`.
    """
    made_from, _, written = text.partition("\n")
    kept: _Kept = _typed(_Kept, json.loads(written))
    row = TestRow.known(campaign, campaign.tests[test], record, kept.failures)
    span = None if kept.panel is None else SpanTest(row, kept.panel, kept.described)
    return Part(
        row, kept.channels, kept.thumbnail, span, kept.free_vibration, kept.used, None, None, made_from=made_from
    )


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
        dtype, data = plain
        return np.frombuffer(b64decode(data), dtype=dtype)
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
