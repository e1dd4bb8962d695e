"""Each specimen's sine tests over frequency and amplitude, and the boundaries that they bracket."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError
from colonnade.figures.files.output import Picture
from colonnade.figures.stored import maps
from colonnade.identification.response.boundaries import (
    Boundaries,
    Bracket,
    MapPoint,
    bracket_boundaries,
    makes_map,
)
from colonnade.report.rows import TestRow
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stability_map import as_map
from colonnade.store.records.summary import map_points
from colonnade.units.text import NOTHING, number


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
    computed = maps.computed(specimen, charts, points, linked=True) if charts else None
    return MeasuredMap(specimen, computed, maps.tested(f"map-{specimen}", points), boundaries)


def charts_of(campaign: Campaign, layout: Layout, specimen: str) -> list[StabilityMap]:
    """Read the stability maps of a specimen by the campaign's models in the plane."""
    return list(filter(None, (_chart(layout, specimen, model) for model in campaign.processing.predict.models)))


def _chart(layout: Layout, specimen: str, model: str) -> StabilityMap | None:
    """Read the map of a model in the plane, which a run keeps up to date; None if it was not made."""
    path = layout.stage(specimen, "map", model)
    if MODELS[model].in_space or not path.is_file():
        return None
    try:
        stored = files.read(path)
    except StoreError:
        return None
    return as_map(stored) if stored.attrs.get("status") == "done" else None


def _boundary(found: Boundaries) -> tuple[str, str, str, str]:
    ratio = number(found.frequency_ratio, 4)
    return ratio, _bracket(found.rocking), _bracket(found.overturning), "; ".join(found.notes) or NOTHING


def _bracket(bracket: Bracket) -> str:
    below, above = number(bracket.below, 4), number(bracket.above, 4)
    if bracket.above is None:
        return NOTHING if bracket.below is None else f"above {below}"
    return f"below {above}" if bracket.below is None else f"{below} – {above}"
