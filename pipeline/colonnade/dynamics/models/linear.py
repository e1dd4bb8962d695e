"""The linear model: θ̈ = p² (θ − α sgn θ − a/g), solved exactly between samples."""

from __future__ import annotations

from colonnade.dynamics.models.model import Line
from colonnade.dynamics.models.plane import PlaneModel

LINEAR = PlaneModel(
    name="linear",
    line=Line("#d1490f", (5.0, 1.6), 1.1),
    definition="θ̈ = p² (θ − α sgn θ − a/g), solved exactly between samples",
    reference="spanos",
    is_linearised=True,
    is_default=True,
)
