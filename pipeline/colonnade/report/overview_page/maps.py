"""Each specimen's sine tests over frequency and amplitude, and the boundaries that they bracket."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.figures.output import Picture
from colonnade.figures.stored import maps
from colonnade.identification.response.boundaries import Boundaries, Bracket, bracket_boundaries
from colonnade.report.rows import TestRow
from colonnade.store.records.summary import map_points
from colonnade.store.records.wording import NOTHING, number


class MeasuredMap(NamedTuple):
    """The sine tests of a specimen over Ω and A, and the boundaries that they bracket: Ω, two brackets, notes."""

    specimen: str
    picture: Picture
    boundaries: tuple[tuple[str, str, str, str], ...]


def measured_maps(campaign: Campaign, tests: Sequence[TestRow]) -> list[MeasuredMap]:
    """Draw a map for each specimen that has a sine test of known Ω, A and outcome."""
    records = {row.id: row.record for row in tests}
    found = {specimen: map_points(records, specimen) for specimen in campaign.specimens}
    return [
        MeasuredMap(specimen, maps.tested(f"map-{specimen}", points), tuple(map(_boundary, bracket_boundaries(points))))
        for specimen, points in found.items()
        if points
    ]


def _boundary(found: Boundaries) -> tuple[str, str, str, str]:
    ratio = number(found.frequency_ratio, 4)
    return ratio, _bracket(found.rocking), _bracket(found.overturning), "; ".join(found.notes) or NOTHING


def _bracket(bracket: Bracket) -> str:
    below, above = number(bracket.below, 4), number(bracket.above, 4)
    if bracket.above is None:
        return NOTHING if bracket.below is None else f"above {below}"
    return f"below {above}" if bracket.below is None else f"{below} – {above}"
