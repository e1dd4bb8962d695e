"""Figures of the project: each function takes histories or peaks and returns a matplotlib Figure."""

from __future__ import annotations

from colonnade.figures.curve import Curve, envelope
from colonnade.figures.histories import history_with_base, rocking_history
from colonnade.figures.peaks import PeakSeries, peak_decay
from colonnade.figures.spans import SpanPanel, spans_together
from colonnade.figures.svg import to_svg

__all__ = [
    "Curve",
    "PeakSeries",
    "SpanPanel",
    "envelope",
    "history_with_base",
    "peak_decay",
    "rocking_history",
    "spans_together",
    "to_svg",
]
