"""A channel in the report: what was recorded, its verdicts, and how it was conditioned."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any

from colonnade.signals.quality import FEW_SPIKES
from colonnade.store.records.stored import Samples, Stored
from colonnade.units import CHANNEL_UNITS
from colonnade.units.text import NOTHING, number, percent, quantity, with_minus

_NOTHING_LEFT = 1e-6
"""Residuals smaller than this, over the noise, mean that there are no more transducers than motions."""

FLAGS = {2: "not evaluated", 3: "suspect", 4: "failed", 9: "missing"}
"""Meanings of the quality flags but "good"."""


ChannelRow = dict[str, str | bool]
"""A channel in words, by the names that the templates use; whether few samples are flagged, and whether it is good."""


def of_test(stored: Stored) -> tuple[ChannelRow, ...]:
    """Put every channel of a test into words."""
    to_noise, to_reading = (stored.by("transducer", "rocking", f"residual_to_{what}") for what in ("noise", "reading"))
    return tuple(
        _row(name, given, stored.samples.get(name)) | {"residual": _residual(to_noise.get(name), to_reading.get(name))}
        for name, given in stored.channels.items()
    )


def _row(name: str, given: Mapping[str, Any], samples: Samples | None) -> ChannelRow:
    kind = str(given.get("quantity", ""))
    unit = CHANNEL_UNITS.get(kind)

    def value(key: str, digits: int) -> str:
        amount = _number(given, key)
        return quantity(amount, unit, digits) if unit else number(amount, digits)

    column, recorded_unit = str(given.get("column", "")), str(given.get("recorded_unit", ""))
    flagged, quality = NOTHING if samples is None else _flagged(samples), str(given.get("quality_report", ""))
    return {
        "name": name,
        "column": f"{column} ({recorded_unit})" if recorded_unit and recorded_unit not in column else column,
        "quantity": kind.replace("_", " "),
        "recorded": "" if samples is None else f"{samples.count} at {quantity(samples.rate, 'Hz', 4)}",
        "flagged": flagged,
        "few_flagged": samples is None or sum(samples.flagged.values()) <= FEW_SPIKES * samples.count,
        "quality": quality or "good",
        "is_good": flagged == NOTHING and not quality,
        "zero": value("zero", 4),
        "zero_window": str(given.get("zero_window", "")) or NOTHING,
        "noise": value("noise", 2),
        "cutoff": quantity(_number(given, "cutoff_hz"), "Hz"),
        "clock": _clock(given),
    }


def _flagged(samples: Samples) -> str:
    parts = (f"{percent(flagged / samples.count)} {FLAGS.get(flag, flag)}" for flag, flagged in samples.flagged.items())
    return ", ".join(parts) or NOTHING


def _residual(to_noise: float | None, to_reading: float | None) -> str:
    """Write the residual of a transducer's reading after the fit of the motion, over its noise and over the reading."""
    if to_noise is None or not isfinite(to_noise):
        return NOTHING
    if to_noise < _NOTHING_LEFT:
        return "no redundancy"
    text = f"{number(to_noise, 2)} × noise"
    if to_reading is None or not isfinite(to_reading):
        return text
    return f"{text}, {percent(to_reading)} of the reading"


def _clock(given: Mapping[str, Any]) -> str:
    """Write how late a channel's clock is, and how fast, each with its standard error."""
    offset, drift = _number(given, "clock_offset"), _number(given, "clock_rate_ppm")
    parts = []
    if offset:
        parts.append(with_minus(f"{1e3 * offset:.2f} ms") + _error(given, "clock_offset_standard_error", 1e3, 2, "ms"))
    if drift:
        parts.append(with_minus(f"{drift:.1f} ppm") + _error(given, "clock_rate_standard_error_ppm", 1, 1, "ppm"))
    return ", ".join(parts) or NOTHING


def _error(given: Mapping[str, Any], key: str, factor: float, digits: int, unit: str) -> str:
    error = _number(given, key)
    return f" ± {factor * error:.{digits}f} {unit}" if error else ""


def _number(given: Mapping[str, Any], key: str) -> float | None:
    value = given.get(key)
    if value is None or isinstance(value, str) or not isfinite(float(value)):
        return None
    return float(value)
