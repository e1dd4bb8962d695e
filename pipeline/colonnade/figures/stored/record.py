"""Pictures of a test over time: measured and predicted, within each model's spread, and earthquake Spans together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.figures.bands import bands_over_time
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.curve import Curve
from colonnade.figures.record import Peak, whole_record
from colonnade.figures.spans import SpanPanel, spans_side_by_side
from colonnade.figures.stored.curves import measured_ratio, misfits, motion, predicted_ratios, quantities, spreads
from colonnade.stages.parts.beginning import RECORDED
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import driven_by, predicted_peak_time
from colonnade.units.text import format_percent, number, quantity

MOTIONS = (
    ("slide", "slide", "slide", "mm"),
    ("uplift", "uplift", "uplift", "mm"),
    ("transverse_slide", "transverse slide", "slide, y", "mm"),
    ("out_of_plane_angle", "out-of-plane angle", "out of plane", "mrad"),
    ("yaw", "yaw", "yaw", "mrad"),
)
"""Other motions of a specimen than its rocking angle: variable, words, label of an axis, unit."""

BASE = (
    ("base_acceleration", "base acceleration", "base", "m/s²"),
    ("base_displacement", "base displacement", "base", "mm"),
    ("vertical_base_acceleration", "vertical base acceleration", "base, up", "m/s²"),
    ("transverse_base_acceleration", "transverse base acceleration", "base, y", "m/s²"),
)
"""Motions of the base, in the same form."""

MOST_SPANS = 12
"""Earthquake tests that are drawn side by side."""

SHADED = "nonlinear"
"""The model whose band is shaded on the overlay, if there are several."""


def record(test: Test, record: TestSummary, stored: Stored, block: Block) -> Picture | None:
    """Draw a test over time: angle, misfit, other motions, and the base motion if it drives; None without anything."""
    measured, predicted = measured_ratio(stored, block), predicted_ratios(stored, block)
    base = quantities(stored, BASE, block) if test.kind != "free-vibration" or driven_by(stored) == RECORDED else []
    if measured is None and not predicted and not base:
        return None
    figure = whole_record(
        measured,
        predicted,
        misfits=misfits(stored, measured, predicted),
        motions=quantities(stored, MOTIONS, block),
        base=base,
        impacts=stored.array("rocking", "impact_time"),
        peak=_peak(record, measured),
        until=_end(stored, measured, predicted),
        # Shades of several models on each other cannot be distinguished: those of the others are in `bands` alone.
        spreads=dict(sorted(spreads(stored, block).items(), key=lambda item: item[0] != SHADED)[:1]),
    )
    title = f"{test.id}: rocking angle, measured and predicted"
    return Picture(figure, f"record-{test.id}", title, seen(record, stored))


def bands(test: Test, stored: Stored, block: Block) -> Picture | None:
    """Draw the measured angle over what each model's own uncertainty leaves; None without an ensemble."""
    found = spreads(stored, block)
    if not found:
        return None
    said = [
        f"{model.capitalize()} model: {format_percent(spread.overturning_probability)} of its runs overturn."
        for model, spread in found.items()
    ]
    title = f"{test.id}: measured rocking angle over the spread of each model"
    return Picture(bands_over_time(measured_ratio(stored, block), found), f"bands-{test.id}", title, " ".join(said))


def span_panel(test: Test, stored: Stored, block: Block) -> SpanPanel:
    """Return what the figure of all Spans shows of one test."""
    measured, base = measured_ratio(stored, block), motion(stored, "base_acceleration", "m/s²")
    return SpanPanel(f"Span {test.span or 0.0}", measured, predicted_ratios(stored, block), base)


def spans(identity: str, title: str, description: str, panels: Sequence[SpanPanel]) -> Picture:
    """Draw earthquake tests of one motion side by side, in the order given; of many, some that are spread evenly."""
    if len(panels) <= MOST_SPANS:
        return Picture(spans_side_by_side(panels), identity, title, description)
    chosen = [panels[index] for index in np.linspace(0, len(panels) - 1, MOST_SPANS).round().astype(int)]
    note = f"{MOST_SPANS} of {len(panels)} tests are drawn, spread evenly; each is drawn whole on its own page."
    return Picture(spans_side_by_side(chosen), identity, title, description, note)


def seen(record: TestSummary, stored: Stored) -> str:
    """Say in words what a test's figure shows."""
    parts = []
    if stored.has("rocking", "rocking_angle"):
        parts.append(_said("Measured", record.outcome, record.peak_ratio, record.peak_time))
    for model, predicted in record.predicted.items():
        if stored.has("predict", "rocking_angle", model):
            time = predicted_peak_time(stored, model)
            parts.append(_said(f"{model.capitalize()} model", predicted.outcome, predicted.peak_ratio, time))
    return " ".join(parts) or "No rocking angle."


def _said(name: str, outcome: str | None, ratio: float | None, time: float | None) -> str:
    at = f" at {quantity(time, 's', 4)}"
    peak = f", largest |θ|/α {number(ratio)}{at}" if ratio is not None else at if outcome == "overturned" else ""
    return f"{name}: {outcome or 'no outcome'}{peak}."


def _peak(record: TestSummary, measured: Curve | None) -> Peak | None:
    if measured is None or record.peak_time is None:
        return None
    nearest = int(np.argmin(np.abs(measured.time - record.peak_time)))
    return Peak(record.peak_time, float(measured.values[nearest]))


def _end(stored: Stored, measured: Curve | None, predicted: Mapping[str, Curve]) -> float | None:
    """Return when all that rocks has overturned, s; None if something stands to the end."""
    falls = [stored.value("predict", "overturning_time", model) for model in predicted]
    if measured is not None:
        falls.append(stored.value("rocking", "overturning_time"))
    return None if not falls or np.isnan(falls).any() else max(falls)
