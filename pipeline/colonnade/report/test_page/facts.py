"""Labels with their text, as every section lists them; where, when and by whom tests were done."""

from __future__ import annotations

from collections.abc import Iterable
from hashlib import sha256

from colonnade.campaign import Campaign, Test
from colonnade.units.text import NOTHING, listed

Fact = tuple[str, str]
"""A label and its text."""


def known(facts: list[Fact]) -> list[Fact]:
    """Leave out what is not known, and what has no label."""
    return [(label, text) for label, text in facts if label and text not in ("", NOTHING)]


MOST_NAMED = 12
"""Operators that are named."""


def who_and_when(campaign: Campaign) -> list[Fact]:
    """Give facility, days and operators, as far as they are known."""
    tests = list(campaign.tests.values())
    operators = list(dict.fromkeys(test.operator for test in tests if test.operator))
    return known(
        [
            ("facility", campaign.facility or ""),
            ("tested", _days(tests)),
            ("operator" if len(operators) == 1 else "operators", listed(operators, MOST_NAMED)),
        ]
    )


def on_cover(campaign: Campaign) -> list[Fact]:
    """Give the same, and from which state of the campaign file a report was made."""
    digest = sha256(campaign.path.read_bytes()).hexdigest()
    return [*who_and_when(campaign), ("campaign file", f"{campaign.path.name}, SHA-256 {digest[:16]}…")]


def _days(tests: Iterable[Test]) -> str:
    """Write the first and the last day of tests; empty if no day is known."""
    days = sorted(test.date.isoformat() for test in tests if test.date)
    return " to ".join(dict.fromkeys([days[0], days[-1]])) if days else ""
