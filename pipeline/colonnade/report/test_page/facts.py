"""Labels with their text, as every section lists them."""

from __future__ import annotations

from colonnade.units.text import NOTHING

Fact = tuple[str, str]
"""A label and its text."""


def known(facts: list[Fact]) -> list[Fact]:
    """Leave out what is not known, and what has no label."""
    return [(label, text) for label, text in facts if label and text not in ("", NOTHING)]
