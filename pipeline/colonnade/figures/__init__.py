"""Figures: each function takes data and returns a matplotlib Figure."""

from __future__ import annotations

from colonnade.figures.files.output import to_csv, to_png, to_svg
from colonnade.figures.files.table import table_of
from colonnade.figures.histories import Spread, bands_over_time
from colonnade.figures.maps.measured_map import measured_map
from colonnade.figures.maps.response_orders import response_orders
from colonnade.figures.maps.stability_map import stability_map
from colonnade.figures.panels.curve import Curve, envelope
from colonnade.figures.record import Peak, Quantity, SpanPanel, spans_side_by_side, whole_record
from colonnade.figures.restitution.estimators import EstimateGroup, EstimateRow, estimators_side_by_side
from colonnade.figures.restitution.history import Region, fitted_history, joint_region
from colonnade.figures.restitution.impacts import ImpactSeries, Level, impact_restitution
from colonnade.figures.restitution.peaks import PeakSeries, peak_decay

__all__ = [
    "Curve",
    "EstimateGroup",
    "EstimateRow",
    "ImpactSeries",
    "Level",
    "Peak",
    "PeakSeries",
    "Quantity",
    "Region",
    "SpanPanel",
    "Spread",
    "bands_over_time",
    "envelope",
    "estimators_side_by_side",
    "fitted_history",
    "impact_restitution",
    "joint_region",
    "measured_map",
    "peak_decay",
    "response_orders",
    "spans_side_by_side",
    "stability_map",
    "table_of",
    "to_csv",
    "to_png",
    "to_svg",
    "whole_record",
]
