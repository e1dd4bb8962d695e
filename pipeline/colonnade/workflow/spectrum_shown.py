"""What `spectrum` prints of a spectrum: its rows for people, and its record for programs."""

from __future__ import annotations

from math import isfinite, pi
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.measures import measure_of
from colonnade.dynamics.pulses import pulse_of
from colonnade.units.text import NOTHING, acceleration, number, quantity, ratio
from colonnade.workflow.real_column import FoundColumn
from colonnade.workflow.spectrum import Overturning, Rocking

ROCKING_HEADS = ("α", "2π/p", "p", "outcome", "largest |θ|/α", "largest |θ'|")
OVERTURNING_HEADS = ("Ω", "frequency", "lower limit A", "acceleration", "upper limit A", "acceleration", "islands")
MEASURE_HEADS = ("measure", "symbol", "value", "why not")

Row = tuple[str, ...]


def verdict(found: Rocking | Overturning) -> str:
    """Say in a sentence what the motion, or the least of the pulses, does to the column."""
    if isinstance(found, Rocking):
        peak, model = found.history.peak_ratio, found.history.model
        rocks = "does not rock" if not peak else f"rocks to |θ|/α = {ratio(peak)} and stands"
        return f"The column {'overturns' if found.history.outcome == 'overturned' else rocks} ({model} model)."
    spectrum = found.spectrum
    by = f"({spectrum.model} model)"
    if not np.isfinite(spectrum.lower).any():
        return f"No {spectrum.pulse} pulse up to A = {spectrum.options['largest']:g} overturns the column {by}."
    least = int(np.nanargmin(spectrum.lower))
    level = float(spectrum.lower[least])
    return (
        f"The least {spectrum.pulse} pulse that overturns the column has A = {number(level)}, "
        f"{acceleration(level * found.column.block.uplift_acceleration)}, at Ω = "
        f"{number(float(spectrum.frequency_ratio[least]))} {by}."
    )


def column_fields(column: FoundColumn) -> list[tuple[str, str]]:
    """Write what the column is."""
    negative, positive = column.restitution
    e = f"{negative:.4g}" if negative == positive else f"{negative:.4g} | {positive:.4g}"
    return [
        ("column", column.name),
        ("critical angle α", quantity(column.block.critical_angle, "rad", 4)),
        ("p", quantity(column.block.p, "rad/s", 4)),
        ("uplift from", acceleration(column.block.uplift_acceleration)),
        ("restitution e", f"{e} ({column.real[1]})"),
    ]


def rocking_rows(found: Rocking) -> list[Row]:
    """Write the spectrum, a row for each slenderness and size."""
    spectrum = found.spectrum
    return [
        (
            quantity(angle, "rad", 4),
            quantity(period, "s"),
            quantity(2 * pi / period, "rad/s"),
            *_ended(
                float(spectrum.peak_ratio[row, column]),
                bool(spectrum.overturned[row, column]),
                float(spectrum.peak_velocity_ratio[row, column]) * 2 * pi / period,
            ),
        )
        for row, angle in enumerate(spectrum.critical_angle.tolist())
        for column, period in enumerate(spectrum.period.tolist())
    ]


def _ended(peak: float, fell: bool, fastest: float) -> Row:
    outcome = "overturned" if fell else "rocking" if peak > 0.0 else "no-rocking"
    return outcome, ratio(peak), quantity(fastest, "rad/s")


def motion_fields(found: Rocking) -> list[tuple[str, str]]:
    """Write what the motion is."""
    measures = found.measures
    return [
        ("motion", f"{found.source}; {found.motion.duration:.4g} s in steps of {found.motion.dt:.4g} s"),
        ("drift", f"the velocity drifts by {measures.drift:.2g} of its peak; {measures.largest_drift:g} is allowed"),
    ]


def measure_rows(found: Rocking) -> list[Row]:
    """Write the measures of the motion."""
    rows: list[Row] = []
    for name, value in found.measures.values.items():
        each = measure_of(name)
        shown = acceleration(value) if each.dimension == "acceleration" else _value(value, each.unit)
        rows.append((each.name, each.symbol, shown, found.measures.reasons.get(name, "").partition(":")[0]))
    return rows


def _value(value: float, unit: str) -> str:
    return f"{number(value)} {unit}".rstrip() if isfinite(value) else NOTHING


def pulse_fields(found: Overturning) -> list[tuple[str, str]]:
    """Write what the pulse is, and what its limits are."""
    spectrum, kind = found.spectrum, pulse_of(found.spectrum.pulse)
    options = spectrum.options
    shape = f"; γ = {options['cycles']:g}, ν = {options['phase']:.3g} rad" if "cycles" in options else ""
    return [
        ("pulse", f"{kind.name}: {kind.definition}, φ = ω t{shape} ({kind.source})"),
        ("limits", f"of intervals at least {options['width']:g} wide in A, up to A = {options['largest']:g}"),
    ]


def overturning_rows(found: Overturning) -> list[Row]:
    """Write the spectrum, a row for each frequency."""
    spectrum, block = found.spectrum, found.column.block
    islands = spectrum.islands
    rows: list[Row] = []
    for omega, lower, upper in zip(spectrum.frequency_ratio, spectrum.lower, spectrum.upper, strict=True):
        here = int((islands[:, 0] == omega).sum())
        limits = [
            text
            for limit in (float(lower), float(upper))
            for text in (number(limit, 5), acceleration(limit * block.uplift_acceleration))
        ]
        rows.append((number(float(omega)), quantity(float(omega) * block.p / (2 * pi), "Hz"), *limits, str(here)))
    return rows


def record_of(found: Rocking | Overturning) -> dict[str, Any]:
    """Give a spectrum for programs: SI, null for what there is not."""
    block = found.column.block
    column = {
        "name": found.column.name,
        "critical_angle": block.critical_angle,
        "p": block.p,
        "uplift_acceleration": block.uplift_acceleration,
        "restitution": list(found.column.restitution),
        "restitution_source": found.column.real[1],
    }
    if isinstance(found, Overturning):
        spectrum = found.spectrum
        edges = np.column_stack([spectrum.interval_frequency_ratio, spectrum.interval_start, spectrum.interval_end])
        return {
            "column": column,
            "pulse": spectrum.pulse,
            "model": spectrum.model,
            "options": spectrum.options,
            "frequency_ratio": _plain(spectrum.frequency_ratio),
            "lower": _plain(spectrum.lower),
            "upper": _plain(spectrum.upper),
            "intervals": edges.tolist(),
        }
    history, measures = found.history, found.measures
    return {
        "column": column,
        "motion": found.source,
        "interval": found.motion.dt,
        "duration": found.motion.duration,
        "model": found.spectrum.model,
        "outcome": history.outcome,
        "peak_ratio": history.peak_ratio,
        "period": _plain(found.spectrum.period),
        "critical_angle": _plain(found.spectrum.critical_angle),
        "spectrum_peak_ratio": [_plain(row) for row in found.spectrum.peak_ratio],
        "spectrum_overturned": found.spectrum.overturned.tolist(),
        "drift": measures.drift,
        "largest_drift": measures.largest_drift,
        "measures": {
            name: {
                "value": value if isfinite(value) else None,
                "unit": measure_of(name).unit,
                "definition": measure_of(name).definition,
                "source": measure_of(name).source,
                "filter": measure_of(name).filter,
                "reason": measures.reasons.get(name, ""),
            }
            for name, value in measures.values.items()
        },
    }


def _plain(values: Array) -> list[float | None]:
    return [value if isfinite(value) else None for value in values.tolist()]
