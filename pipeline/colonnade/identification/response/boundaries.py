"""The two boundaries of a measured map, bracketed by its tests: no rocking | rocking | overturning."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from colonnade.dynamics.history import Outcome

Of = TypeVar("Of")

SAME_FREQUENCY = 0.02
"""Tests whose Ω differ from the group's first by less than this fraction were meant to have one frequency."""


@dataclass(frozen=True)
class MapPoint:
    """
    One sine test on the map.

    Attributes
    ----------
    test : str
        Its id.
    frequency_ratio, amplitude_ratio : float
        Ω and A.
    outcome : str
    order : int, "irregular" or None
        Of its response.
    """

    test: str
    frequency_ratio: float
    amplitude_ratio: float
    outcome: Outcome
    order: int | str | None = None


@dataclass(frozen=True)
class Bracket:
    """
    Where a boundary is, going up in A.

    Attributes
    ----------
    below, above : float or None
        The smallest A beyond the boundary, and the largest one short of it that is smaller; None if not measured.
    exceptions : tuple of float
        Larger A that had the outcome from below the boundary all the same, in order.
    """

    below: float | None
    above: float | None
    exceptions: tuple[float, ...] = ()

    @classmethod
    def between(cls, short: list[float], beyond: list[float]) -> Bracket:
        """Bracket the boundary between the A of tests short of it and of those beyond it."""
        above = min(beyond, default=None)
        below = [amplitude for amplitude in short if above is None or amplitude < above]
        exceptions = tuple(sorted(set(short) - set(below)))
        return cls(max(below, default=None), above, exceptions)

    @property
    def middle(self) -> float | None:
        """Middle of the bracket, None if a side is missing."""
        return None if self.below is None or self.above is None else (self.below + self.above) / 2


@dataclass(frozen=True)
class Boundaries:
    """
    Both boundaries at one frequency.

    Attributes
    ----------
    frequency_ratio : float
        Mean Ω of the group.
    rocking : Bracket
        Between tests without and with rocking; overturning is rocking here.
    overturning : Bracket
        Between tests that rocked and that overturned; those without rocking bound it from below where none rocked.
    """

    frequency_ratio: float
    rocking: Bracket
    overturning: Bracket


def makes_map(points: Iterable[MapPoint]) -> bool:
    """Return whether tests make a map: they are at two frequencies at least."""
    return len(bracket_boundaries(points)) > 1


def bracket_boundaries(points: Iterable[MapPoint]) -> list[Boundaries]:
    """
    Bracket both boundaries at each frequency.

    Parameters
    ----------
    points : iterable of MapPoint
        Of one specimen.

    Returns
    -------
    boundaries : list of Boundaries
        In order of Ω; tests within `SAME_FREQUENCY` of each other form a group.
    """
    found = []
    for group in at_one_frequency(points, lambda each: each.frequency_ratio):
        still, rocked, fell = (
            [point.amplitude_ratio for point in group if point.outcome == outcome]
            for outcome in ("no-rocking", "rocking", "overturned")
        )
        rocking, overturning = Bracket.between(still, [*rocked, *fell]), Bracket.between(rocked or still, fell)
        found.append(Boundaries(sum(point.frequency_ratio for point in group) / len(group), rocking, overturning))
    return found


def at_one_frequency(tests: Iterable[Of], frequency_ratio: Callable[[Of], float]) -> list[list[Of]]:
    """Group what was meant to have one frequency, see `SAME_FREQUENCY`; in order of Ω."""
    groups: list[list[Of]] = []
    for test in sorted(tests, key=frequency_ratio):
        if groups and frequency_ratio(test) <= frequency_ratio(groups[-1][0]) * (1 + SAME_FREQUENCY):
            groups[-1].append(test)
        else:
            groups.append([test])
    return groups
