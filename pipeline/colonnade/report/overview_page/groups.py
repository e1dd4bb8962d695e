"""Tests by specimen and kind, sine tests by frequency and amplitude."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

from colonnade.campaign import Campaign
from colonnade.report.pages import KINDS
from colonnade.report.rows import TestRow
from colonnade.units.text import quantity


class SineGroup(NamedTuple):
    """Sine tests of one frequency, by rising amplitude."""

    frequency: str
    tests: tuple[TestRow, ...]


class KindGroup(NamedTuple):
    """Tests of one kind with a row each."""

    title: str
    tests: tuple[TestRow, ...]


class SpecimenGroup(NamedTuple):
    """All tests of one specimen: sine tests of known Ω and A by rising frequency, all others by kind."""

    specimen: str
    kinds: tuple[KindGroup, ...]
    sines: tuple[SineGroup, ...]

    @property
    def steps(self) -> int:
        """Largest number of sine tests of one frequency."""
        return max((len(group.tests) for group in self.sines), default=0)


def by_specimen(campaign: Campaign, tests: Sequence[TestRow]) -> list[SpecimenGroup]:
    """Group tests; specimens without any are left out."""
    groups = []
    for specimen in campaign.specimens:
        own = [row for row in tests if row.test.specimen == specimen]
        sines = [row for row in own if row.frequency is not None and row.record.amplitude_ratio is not None]
        if own:
            in_ladder = {row.id for row in sines}
            others = [row for row in own if row.id not in in_ladder]
            groups.append(SpecimenGroup(specimen, _kinds(others), _ladder(sines)))
    return groups


def _kinds(tests: Sequence[TestRow]) -> tuple[KindGroup, ...]:
    by_kind = {kind: tuple(row for row in tests if row.test.kind == kind) for kind in KINDS}
    return tuple(
        KindGroup(f"{KINDS[kind]} of unknown amplitude" if kind == "sine" else KINDS[kind], members)
        for kind, members in by_kind.items()
        if members
    )


def _ladder(sines: Sequence[TestRow]) -> tuple[SineGroup, ...]:
    by_frequency: dict[str, list[TestRow]] = defaultdict(list)
    for row in sorted(sines, key=lambda row: (row.frequency or 0.0, row.record.amplitude_ratio or 0.0, row.id)):
        by_frequency[quantity(row.frequency, "Hz")].append(row)
    return tuple(SineGroup(frequency, tuple(members)) for frequency, members in by_frequency.items())
