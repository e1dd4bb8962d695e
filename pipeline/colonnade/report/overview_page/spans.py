"""Earthquake tests of one specimen and motion side by side, by rising Span."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

from colonnade.figures.files.output import Picture
from colonnade.figures.spans import SpanPanel
from colonnade.figures.stored import record
from colonnade.report.rows import TestRow


class SpanTest(NamedTuple):
    """An earthquake test with a Span: what the figure of all Spans and its table show."""

    row: TestRow
    panel: SpanPanel
    description: str


class SpanGroup(NamedTuple):
    """Earthquake tests of one specimen and motion, by rising Span."""

    title: str
    tests: tuple[SpanTest, ...]
    picture: Picture


def span_groups(drawn: Sequence[SpanTest]) -> list[SpanGroup]:
    """Draw the earthquake tests that have an angle, those of one specimen and motion side by side."""
    together: dict[tuple[str, str, float], list[SpanTest]] = defaultdict(list)
    for entry in drawn:
        test = entry.row.test
        together[test.specimen, test.motion or "", test.time_scale or 1.0].append(entry)
    groups = []
    for count, ((specimen, motion, scale), members) in enumerate(together.items(), start=1):
        if len(members) < 2:
            continue
        members.sort(key=lambda entry: (entry.row.test.span or 0.0, entry.row.id))
        title = f"{motion or 'Base motion'}, {specimen}" + (f", time scale {scale:.4g}" if scale != 1.0 else "")
        described = " ".join(f"{entry.panel.title}: {entry.description}" for entry in members)
        picture = record.spans(f"spans-{count}", title, described, [entry.panel for entry in members])
        groups.append(SpanGroup(title, tuple(members), picture))
    return groups
