"""Figures of the project: each function takes histories or peaks and returns a matplotlib Figure."""

from __future__ import annotations

from colonnade.figures.bands import Spread, bands_over_time
from colonnade.figures.curve import Curve, envelope
from colonnade.figures.measured_map import measured_map
from colonnade.figures.peaks import PeakSeries, peak_decay
from colonnade.figures.record import Peak, Quantity, whole_record
from colonnade.figures.spans import SpanPanel, spans_side_by_side
from colonnade.figures.stability_map import stability_map
from colonnade.figures.svg import to_svg

__all__ = [
    "Curve",
    "Peak",
    "PeakSeries",
    "Quantity",
    "SpanPanel",
    "Spread",
    "bands_over_time",
    "envelope",
    "measured_map",
    "peak_decay",
    "spans_side_by_side",
    "stability_map",
    "to_svg",
    "whole_record",
]
