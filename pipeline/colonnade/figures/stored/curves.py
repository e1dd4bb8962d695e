"""Curves of a test's stored results, over the critical angle of the block."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.figures.histories import Spread
from colonnade.figures.panels.curve import Curve
from colonnade.figures.record import Quantity
from colonnade.signals.filters import displacement
from colonnade.store.records.stored import Stored
from colonnade.units import from_si


def measured_ratio(stored: Stored, block: Block, *, as_recorded: bool = False) -> Curve | None:
    """Return the measured θ/α about the zero of the predictions, or as recorded; None if it was not measured."""
    return _ratio(stored, block, "rocking", as_recorded=as_recorded)


def true_angle(stored: Stored, measured: Array) -> Array:
    """Return a measured angle about the zero of the predictions, with the gain that a free vibration shows, rad."""
    offset, gain = (stored.value("compare", name) for name in ("zero_offset", "angle_gain"))
    return (measured - float(np.nan_to_num(offset))) / float(np.nan_to_num(gain, nan=1.0))


def predicted_ratios(stored: Stored, block: Block) -> dict[str, Curve]:
    """Return the predicted θ/α by model."""
    curves = {model: _ratio(stored, block, "predict", model) for model in stored.models("predict")}
    return {model: curve for model, curve in curves.items() if curve is not None}


def spreads(stored: Stored, block: Block) -> dict[str, Spread]:
    """Return the ensembles' bands of θ/α by model."""
    found = {}
    for model in stored.models("ensemble"):
        time, levels, angles = (
            stored.array("ensemble", name, model) for name in ("elapsed", "quantile", "rocking_angle_band")
        )
        overturning, horizon = (
            stored.value("ensemble", name, model) for name in ("overturning_probability", "horizon")
        )
        found[model] = Spread(time, levels, angles / block.critical_angle_at(angles), overturning, horizon)
    return found


def misfits(stored: Stored, measured: Curve | None, predicted: Mapping[str, Curve]) -> dict[str, Curve]:
    """Return predicted minus measured θ/α as far as the two are compared, by model."""
    found = {}
    for model, curve in predicted.items():
        until = stored.compared("compared_until", model)
        if measured is not None and curve.values.shape == measured.values.shape and np.isfinite(until):
            within = curve.time <= until
            found[model] = Curve(curve.time[within], (curve.values - measured.values)[within])
    return found


def quantities(stored: Stored, wanted: Sequence[tuple[str, str, str, str]], block: Block) -> list[Quantity]:
    """Return those motions that were measured; wanted are variable, words, label and unit."""
    found = []
    for name, _, label, unit in wanted:
        curve = motion(stored, name, unit)
        if curve is not None and np.isfinite(curve.values).any():
            uplift = block.uplift_acceleration if name == "base_acceleration" else None
            found.append(Quantity(f"{label}\n({unit})", curve, uplift, "g tan α"))
    return found


def motion(stored: Stored, name: str, unit: str) -> Curve | None:
    """Return a measured motion over time in a unit, None if it was not measured."""
    values = stored.array("rocking", name)
    if not (values.ndim == 1 and values.size):
        return None
    return Curve(stored.array("rocking", "elapsed"), from_si(1.0, unit) * values)


def base_displacement(stored: Stored) -> tuple[Curve | None, str]:
    """Return the displacement of the base over time, m, and where it is from; None if its motion was not recorded."""
    recorded, acceleration = motion(stored, "base_displacement", "m"), motion(stored, "base_acceleration", "m/s²")
    if recorded is not None and np.isfinite(recorded.values).any():
        return recorded, "recorded displacement"
    if acceleration is not None:
        return acceleration._replace(values=displacement(*acceleration)), "recorded acceleration integrated twice"
    return None, "not recorded, drawn at rest"


def _ratio(
    stored: Stored, block: Block, stage: str, model: str | None = None, *, as_recorded: bool = True
) -> Curve | None:
    if not stored.has(stage, "rocking_angle", model):
        return None
    time, angle = stored.array(stage, "elapsed", model), stored.array(stage, "rocking_angle", model)
    angle = angle if as_recorded else true_angle(stored, angle)
    # An overturned test ends where it overturns: what a frame or a floor does to it then is no rocking.
    fall = stored.value(stage, "overturning_time", model)
    ended = time.size if np.isnan(fall) else int(np.searchsorted(time, fall)) + 1
    angle = np.where(np.arange(time.size) < ended, angle, np.nan)
    return Curve(time, angle / block.critical_angle_at(angle))
