"""The stored restitution of a free vibration in words: estimators, departures, peaks."""

from __future__ import annotations

from colonnade.campaign.forms.summary import IdentifiedSummary
from colonnade.figures.restitution.decay import STAGE
from colonnade.figures.restitution.estimators import estimate_rows
from colonnade.report.test_page.facts import known
from colonnade.store.records.stored import Stored
from colonnade.units.text import format_uncertain, interval, quantity


def value_of(stored: Stored, found: IdentifiedSummary | None) -> str:
    """Write e of a free vibration with the half-width of its interval."""
    found = found or IdentifiedSummary()
    return interval(found.value, found.low, found.high, stored.value(STAGE, "level"))


def facts_of(stored: Stored, found: IdentifiedSummary | None) -> list[tuple[str, str]]:
    """Give e of a free vibration, by which estimator and what that assumes, or why it was refused."""
    chosen = next((each for each in estimate_rows(stored) if each.recommended), None)
    slope, error = (stored.value(STAGE, f"restitution_slope{end}") for end in ("", "_standard_error"))
    facts = [
        ("e", value_of(stored, found)),
        ("refused", stored.text(STAGE, "reason")),
        ("from", chosen.name if chosen else ""),
        ("assumptions", chosen.assumptions if chosen else ""),
        ("method", stored.text(STAGE, "method")),
        (
            "change of e with the speed of impact",
            f"{format_uncertain(slope, error)} per rad/s" if error > 0 else "",
        ),
        ("rest angle subtracted", quantity(stored.value(STAGE, "zero_offset"), "mrad", 2)),
    ]
    return known(facts)


PEAK = ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
"""Columns of the table of peaks, by their stored names."""


def peaks_of(stored: Stored) -> list[tuple[float, ...]]:
    """Give number, time, angle, standard error, fitted angle and use of each peak."""
    columns = (stored.array(STAGE, name).tolist() for name in PEAK)
    return [(number, *peak) for number, peak in enumerate(zip(*columns, strict=True), 1)]
