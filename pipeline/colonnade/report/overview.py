"""The overview: tests by specimen and kind, sine tests by frequency and amplitude, Spans side by side."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from markupsafe import Markup

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.history import Outcome
from colonnade.figures import SpanPanel
from colonnade.identification.boundaries import Boundaries, Bracket, MapPoint, bracket_boundaries
from colonnade.report import charts, wording
from colonnade.report.agreement import sentences
from colonnade.report.pages import KINDS
from colonnade.report.rows import TestRow

OUTCOMES: tuple[Outcome, ...] = ("no-rocking", "rocking", "overturned")
"""Those that a map shows; what was only seen not to overturn may have rocked or not."""


class SineGroup(NamedTuple):
    """Sine tests of one frequency, by rising amplitude."""

    frequency: str
    frequency_ratio: str
    tests: tuple[tuple[str, TestRow], ...]
    """A of each as text, and its row."""


class KindGroup(NamedTuple):
    """Tests of one kind with a row each."""

    title: str
    tests: tuple[TestRow, ...]


class BoundaryRow(NamedTuple):
    """Between which A the boundaries lie at one Ω, and what is out of order or missing; text for the page."""

    frequency_ratio: str
    rocking: str
    overturning: str
    notes: str


@dataclass(frozen=True)
class MeasuredMap:
    """The sine tests of a specimen over Ω and A, and the boundaries that they bracket."""

    specimen: str
    chart: Markup
    boundaries: tuple[BoundaryRow, ...]


@dataclass(frozen=True)
class SpecimenGroup:
    """
    All tests of one specimen.

    Attributes
    ----------
    specimen : str
    kinds : tuple of KindGroup
        All tests but those of `sines`.
    sines : tuple of SineGroup
        By rising frequency.
    steps : int
        Largest number of sine tests of one frequency.
    """

    specimen: str
    kinds: tuple[KindGroup, ...]
    sines: tuple[SineGroup, ...]
    steps: int


@dataclass(frozen=True)
class SpanGroup:
    """Earthquake tests of one specimen and motion, by rising Span."""

    title: str
    tests: tuple[TestRow, ...]
    spans: tuple[str, ...]
    chart: Markup


class SpanTest(NamedTuple):
    """An earthquake test with a Span: what the figure of all Spans and the table below it show."""

    test: Test
    row: TestRow
    panel: SpanPanel
    description: str


def by_specimen(campaign: Campaign, tests: Sequence[TestRow]) -> tuple[SpecimenGroup, ...]:
    """Group tests; specimens without any are left out."""
    groups = []
    for specimen in campaign.specimens:
        own = [test for test in tests if test.specimen == specimen]
        sines = [test for test in own if isfinite(test.frequency) and isfinite(test.amplitude_ratio)]
        placed = {test.id for test in sines}
        kinds = []
        for kind, title in KINDS.items():
            members = tuple(test for test in own if test.kind == kind and test.id not in placed)
            if members:
                kinds.append(KindGroup(f"{title} of unknown amplitude" if kind == "sine" else title, members))
        ladder = _ladder(sines)
        if own:
            groups.append(
                SpecimenGroup(specimen, tuple(kinds), ladder, max((len(group.tests) for group in ladder), default=0))
            )
    return tuple(groups)


def _ladder(sines: Sequence[TestRow]) -> tuple[SineGroup, ...]:
    by_frequency: dict[str, list[TestRow]] = defaultdict(list)
    for test in sorted(sines, key=lambda test: (test.frequency, test.amplitude_ratio, test.id)):
        by_frequency[wording.quantity(test.frequency, "Hz")].append(test)
    return tuple(
        SineGroup(
            frequency,
            wording.number(members[0].frequency_ratio, 4),
            tuple((wording.number(test.amplitude_ratio), test) for test in members),
        )
        for frequency, members in by_frequency.items()
    )


def measured_maps(campaign: Campaign, tests: Sequence[TestRow]) -> tuple[MeasuredMap, ...]:
    """Draw a map for each specimen that has a sine test of known Ω, A and outcome."""
    maps = []
    for specimen in campaign.specimens:
        points = [
            MapPoint(test.id, test.frequency_ratio, test.amplitude_ratio, outcome, test.order_number)
            for test in tests
            if test.specimen == specimen
            and isfinite(test.frequency_ratio)
            and isfinite(test.amplitude_ratio)
            and (outcome := _map_outcome(test)) is not None
        ]
        if points:
            boundaries = tuple(_boundary_row(each) for each in bracket_boundaries(points))
            maps.append(MeasuredMap(specimen, charts.measured_map(f"map-{specimen}", points), boundaries))
    return tuple(maps)


def _map_outcome(test: TestRow) -> Outcome | None:
    for outcome in OUTCOMES:
        if outcome == (test.outcome or test.observed):
            return outcome
    return None


def _boundary_row(boundaries: Boundaries) -> BoundaryRow:
    return BoundaryRow(
        wording.number(boundaries.frequency_ratio, 4),
        _bracket(boundaries.rocking),
        _bracket(boundaries.overturning),
        "; ".join(boundaries.notes),
    )


def _bracket(bracket: Bracket) -> str:
    if bracket.below is not None and bracket.above is not None:
        return f"{wording.number(bracket.below, 4)} – {wording.number(bracket.above, 4)}"
    if bracket.below is not None:
        return f"above {wording.number(bracket.below, 4)}"
    return wording.NOTHING if bracket.above is None else f"below {wording.number(bracket.above, 4)}"


def span_groups(drawn: Sequence[SpanTest]) -> tuple[SpanGroup, ...]:
    """Draw the earthquake tests that have an angle, those of one specimen and motion side by side."""

    together_by: dict[tuple[str, str, float], list[SpanTest]] = defaultdict(list)
    for entry in drawn:
        together_by[entry.test.specimen, entry.test.motion or "", entry.test.time_scale or 1.0].append(entry)
    groups = []
    for number, ((specimen, motion, scale), members) in enumerate(together_by.items(), start=1):
        together = sorted(members, key=lambda entry: (entry.test.span or 0.0, entry.test.id))
        if len(together) < 2:
            continue
        title = f"{motion or 'Base motion'}, {specimen}" + (f", time scale {scale:.4g}" if scale != 1.0 else "")
        described = " ".join(f"{entry.panel.title}: {entry.description}" for entry in together)
        groups.append(
            SpanGroup(
                title,
                tuple(entry.row for entry in together),
                tuple(entry.panel.title for entry in together),
                charts.spans(f"spans-{number}", title, described, [entry.panel for entry in together]),
            )
        )
    return tuple(groups)


def agreement(tests: Sequence[TestRow], models: Sequence[str]) -> tuple[str, ...]:
    """Say of each model how far it agrees with the tests."""
    told = (sentences(model, [test.models[model].score for test in tests]) for model in models)
    return tuple(filter(None, told))
