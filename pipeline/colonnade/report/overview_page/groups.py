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
from colonnade.figures.maps import response_orders
from colonnade.figures.stored import record
from colonnade.figures.stored.record import SpanPanel
from colonnade.identification.response.boundaries import Boundaries, Bracket, MapPoint, bracket_boundaries, makes_map
from colonnade.report.rows import TestRow
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import as_map
from colonnade.store.records.summary import map_points
from colonnade.units.text import NOTHING, number, quantity


class Ladder(NamedTuple):
    """Sine tests of one specimen with known Ω and A: by rising frequency, and of each frequency by rising amplitude."""

    specimen: str
    sines: dict[str, list[TestRow]]

    @property
    def steps(self) -> int:
        """Largest number of tests of one frequency."""
        return max(map(len, self.sines.values()))


def ladders(campaign: Campaign, tests: Sequence[TestRow]) -> list[Ladder]:
    """Lay out the sine tests of each specimen that has any."""
    known = [row for row in tests if row.frequency is not None and row.record.amplitude_ratio is not None]
    known.sort(key=lambda row: (row.frequency or 0.0, row.record.amplitude_ratio or 0.0, row.id))
    found = []
    for specimen in campaign.specimens:
        sines: dict[str, list[TestRow]] = defaultdict(list)
        for row in known:
            if row.test.specimen == specimen:
                sines[quantity(row.frequency, "Hz")].append(row)
        if sines:
            found.append(Ladder(specimen, sines))
    return found


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


class MeasuredMap(NamedTuple):
    """
    The sine tests of a specimen over Ω and A.

    Attributes
    ----------
    specimen : str
    computed : Picture or None
        Stability map by each model in the plane that has one, with the tests; None without a computed map.
    measured : Picture or None
        The tests and the boundaries that they bracket; None if they are at one frequency, which makes no map.
    boundaries : tuple
        Ω, brackets of rocking and of overturning, notes.
    """

    specimen: str
    computed: Picture | None
    measured: Picture | None
    boundaries: tuple[tuple[str, str, str, str], ...]


def measured_maps(campaign: Campaign, layout: Layout, tests: Sequence[TestRow]) -> list[MeasuredMap]:
    """Draw the maps of each specimen that has a sine test of known Ω, A and outcome."""
    records = {row.id: row.record for row in tests}
    found = {specimen: map_points(records, specimen) for specimen in campaign.specimens}
    return [_map(campaign, layout, specimen, points) for specimen, points in found.items() if points]


def _map(campaign: Campaign, layout: Layout, specimen: str, points: Sequence[MapPoint]) -> MeasuredMap:
    boundaries = tuple(map(_boundary, bracket_boundaries(points)))
    if not makes_map(points):
        return MeasuredMap(specimen, None, None, boundaries)
    charts = charts_of(campaign, layout, specimen)
    computed = response_orders.computed(specimen, charts, points, linked=True) if charts else None
    return MeasuredMap(specimen, computed, response_orders.tested(f"map-{specimen}", points), boundaries)


def charts_of(campaign: Campaign, layout: Layout, specimen: str) -> list[StabilityMap]:
    """Read the stability maps of a specimen by the campaign's models in the plane, which a run keeps up to date."""
    found = []
    for model in campaign.processing.predict.models:
        path = layout.stage(specimen, "map", model)
        if not MODELS[model].in_space and path.is_file():
            with suppress(StoreError):
                found.append(files.read(path))
    return [as_map(stored) for stored in found if stored.attrs.get("status") == "done"]


def _boundary(found: Boundaries) -> tuple[str, str, str, str]:
    ratio = number(found.frequency_ratio, 4)
    return ratio, _bracket(found.rocking), _bracket(found.overturning), "; ".join(found.notes) or NOTHING


def _bracket(bracket: Bracket) -> str:
    below, above = number(bracket.below, 4), number(bracket.above, 4)
    if bracket.above is None:
        return NOTHING if bracket.below is None else f"above {below}"
    return f"below {above}" if bracket.below is None else f"{below} – {above}"
