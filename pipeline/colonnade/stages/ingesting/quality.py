"""Quality of each channel: alone, compared with the table's channels, and as reviewed by people."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array, Vector
from colonnade.campaign.review import Review
from colonnade.campaign.settings import QualitySettings
from colonnade.findings import Finding
from colonnade.signals import quality, timing
from colonnade.signals.quality import check_rails
from colonnade.stages.parts.inputs import Inputs
from colonnade.store.description import variable_name

if TYPE_CHECKING:
    import xarray as xr

DEAD_SHARE = 0.08
"""An accelerometer on the specimen that moves less than this share of the table's is practically dead."""

SAME_AXIS = 0.9
"""Smallest product of two directions with which they are compared."""


class ChannelInputs(Inputs):
    """One channel: where it is in the file, how it becomes SI, its range, what it is on and its direction."""

    column: str | int
    recorder: str
    time: str | int | None
    quantity: str
    unit: str | None
    gain: str | None
    factor: float
    offset: float
    full_scale: float | None
    range_recorded: float | None
    on: str | None
    direction: Vector | None


def clock_verdicts(stamps: Array, clock: timing.Clock, settings: QualitySettings) -> list[quality.Verdict]:
    """Check the times of a file, of shape (n,), s; `clock` is read from them."""
    if clock.is_exact and settings.jitter > 4 * timing.EXACT:
        return []
    return [
        timing.check_order(stamps, clock),
        timing.check_gaps(clock, factor=settings.gap),
        timing.check_jitter(clock, share=settings.jitter, factor=settings.gap),
    ]


def channel_verdicts(
    stamps: Array, values: Array, physical: Array, channel: ChannelInputs, settings: QualitySettings
) -> list[quality.Verdict]:
    """
    Check one channel alone.

    Parameters
    ----------
    stamps, values, physical : ndarray, shape (n,)
        Times as in the file, s; values as in the file and in SI.
    channel : ChannelInputs
    settings : QualitySettings
    """
    found = [
        quality.check_missing(stamps, values),
        quality.check_flat(stamps, values, duration=settings.flat_duration),
        quality.check_spikes(stamps, values, threshold=settings.spike_threshold),
    ]
    if channel.range_recorded is not None:
        found.append(quality.check_clipping(stamps, values, full_scale=channel.range_recorded))
    elif channel.full_scale is not None:
        found.append(quality.check_clipping(stamps, physical, full_scale=channel.full_scale))
    # A table and a specimen hold a place, and nothing but a saturated channel an acceleration.
    is_acceleration = channel.on == "table" and channel.quantity == "acceleration"
    if is_acceleration and not any(verdict.kind == "end of the range" for verdict in found):
        found.append(check_rails(stamps, values))
    return found


def reviewed(name: str, time: Array, review: Review) -> list[quality.Verdict]:
    """Verdicts of the people who reviewed a channel."""
    found = []
    for flagged in review.flags:
        if flagged.channel == name:
            low, high = flagged.window or (-np.inf, np.inf)
            inside = np.ones(time.shape, bool) if flagged.window is None else (time >= low) & (time <= high)
            found.append(quality.Verdict(quality.Flag[flagged.flag.upper()], inside, flagged.reason))
    return found


def flag_dead_on_specimen(
    dataset: xr.Dataset, channels: Mapping[str, ChannelInputs], warnings: list[Finding]
) -> xr.Dataset:
    """Flag accelerometers on the specimen that are practically dead compared with the table along their axis."""
    accelerometers = {name: channel for name, channel in channels.items() if channel.quantity == "acceleration"}
    for name, channel in accelerometers.items():
        references = [
            dataset[variable_name(other)].to_numpy()
            for other, table in accelerometers.items()
            if table.on == "table" and _same_axis(channel, table)
        ]
        if channel.on != "specimen" or not references:
            continue
        variable = variable_name(name)
        reference = max(references, key=np.nanstd)
        verdict = quality.check_dead(dataset[variable].to_numpy(), reference, share=DEAD_SHARE)
        if verdict.reason:
            flags = dataset[f"{variable}_quality"]
            dataset[f"{variable}_quality"] = (flags.dims, np.maximum(flags.to_numpy(), np.int8(verdict.flag)))
            warnings.append(replace(verdict.finding, text=f"channel {name}: {verdict.reason}."))
            report = dataset[variable].attrs.get("quality_report", "")
            dataset[variable].attrs["quality_report"] = "; ".join(filter(None, (report, verdict.reason)))
    return dataset


def _same_axis(first: ChannelInputs, second: ChannelInputs) -> bool:
    if first.direction is None or second.direction is None:
        return False
    return bool(abs(np.dot(first.direction, second.direction)) > SAME_AXIS)
