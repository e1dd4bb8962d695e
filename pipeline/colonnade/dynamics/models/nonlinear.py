"""The nonlinear model: θ̈ = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)], by Taylor series to rounding."""

from __future__ import annotations

from colonnade.dynamics.models.model import Line
from colonnade.dynamics.models.plane import PlaneModel

NONLINEAR = PlaneModel(
    name="nonlinear",
    line=Line("#0b6bb0", (7.0, 1.6, 1.6, 1.6), 1.1),
    definition="θ̈ = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)], integrated with impacts located in time",
    reference="housner",
    is_default=True,
)
