"""Sine tests of a specimen by frequency and amplitude and on maps, earthquakes by rising Span."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError
from colonnade.figures.files.output import Picture
from colonnade.figures.stored import record
from colonnade.figures.stored.record import SpanPanel
from colonnade.identification.response.boundaries import Bracket, MapPoint, bracket_boundaries
from colonnade.report.rows import TestRow
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import as_map
from colonnade.units.text import NOTHING, number, quantity


def ladder(tests: Sequence[TestRow]) -> dict[str, list[TestRow]]:
    """Lay out the sine tests of a specimen with known Ω and A: by rising frequency, of each by rising amplitude."""
    sines: dict[str, list[TestRow]] = defaultdict(list)
    for row in sorted(tests, key=lambda row: (row.frequency or 0.0, row.record.amplitude_ratio or 0.0, row.id)):
        if row.frequency is not None and row.record.amplitude_ratio is not None:
            sines[quantity(row.frequency, "Hz")].append(row)
    return sines


class SpanTest(NamedTuple):
    """An earthquake test with a Span: what the figure of all Spans and its table show."""

    row: TestRow
    panel: SpanPanel
    description: str


class SpanGroup(NamedTuple):
    """Earthquake tests of one specimen and motion, by rising Span."""

    title: str
    tests: list[TestRow]
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
        groups.append(SpanGroup(title, [entry.row for entry in members], picture))
    return groups


def charts_of(campaign: Campaign, layout: Layout, specimen: str) -> list[StabilityMap]:
    """Read the stability maps of a specimen by the campaign's models in the plane, which a run keeps up to date."""
    found = []
    for model in campaign.processing.predict.models:
        path = layout.stage(specimen, "map", model)
        if not MODELS[model].in_space and path.is_file():
            with suppress(StoreError):
                found.append(files.read(path))
    return [as_map(stored) for stored in found if stored.attrs.get("status") == "done"]


def boundaries_of(points: Sequence[MapPoint]) -> list[tuple[str, str, str, str]]:
    """Write what sine tests bracket: Ω, the brackets of rocking and of overturning, notes."""
    return [
        (number(each.frequency_ratio, 4), _bracket(each.rocking), _bracket(each.overturning), "; ".join(each.notes))
        for each in bracket_boundaries(points)
    ]


def _bracket(bracket: Bracket) -> str:
    below, above = number(bracket.below, 4), number(bracket.above, 4)
    if bracket.above is None:
        return NOTHING if bracket.below is None else f"above {below}"
    return f"below {above}" if bracket.below is None else f"{below} – {above}"
