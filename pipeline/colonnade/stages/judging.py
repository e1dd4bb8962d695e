"""Judging: each channel's quality by itself, beside the table's, and by the people who reviewed it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign.decision import Review
from colonnade.findings import Finding
from colonnade.signals import quality, timing
from colonnade.store.description import variable_name

Array = NDArray[np.float64]

DEAD_SHARE = 0.08
"""An accelerometer on the specimen that moves less than this share of the table's is practically dead."""

SAME_AXIS = 0.9
"""Smallest product of two directions with which they are compared."""


class ChannelInstructions(BaseModel):
    """One channel: where it is in the file, how it becomes SI, its range, what it is on and its direction."""

    model_config = ConfigDict(frozen=True)

    column: str | int
    recorder: str
    time: str | int | None
    quantity: str
    unit: str | None
    factor: float
    offset: float
    full_scale: float | None
    range_recorded: float | None
    on: str | None
    direction: tuple[float, float, float] | None


class Limits(BaseModel):
    """Settings of the quality checks; see `processing` for what each does."""

    model_config = ConfigDict(frozen=True)

    spike_threshold: float
    flat_duration: float
    gap: float
    jitter: float


def clock_verdicts(stamps: Array, clock: timing.Clock, limits: Limits) -> list[quality.Verdict]:
    """Judge the times of a file, of shape (n,), s; `clock` is what they say."""
    return [
        timing.check_order(stamps, clock),
        timing.check_gaps(clock, factor=limits.gap),
        timing.check_jitter(clock, share=limits.jitter, factor=limits.gap),
    ]


def channel_verdicts(
    stamps: Array, values: Array, physical: Array, channel: ChannelInstructions, limits: Limits
) -> list[quality.Verdict]:
    """
    Judge one channel by itself.

    Parameters
    ----------
    stamps, values, physical : ndarray, shape (n,)
        Times as in the file, s; values as in the file and in SI.
    channel : ChannelInstructions
    limits : Limits
    """
    found = [
        quality.check_missing(stamps, values),
        quality.check_flat(stamps, values, duration=limits.flat_duration),
        quality.check_spikes(stamps, values, threshold=limits.spike_threshold),
    ]
    if channel.range_recorded is not None:
        found.append(quality.check_clipping(stamps, values, full_scale=channel.range_recorded))
    elif channel.full_scale is not None:
        found.append(quality.check_clipping(stamps, physical, full_scale=channel.full_scale))
    return found


def reviewed(name: str, time: Array, review: Review) -> list[quality.Verdict]:
    """Verdicts of the people who looked at a channel."""
    found = []
    for flagged in review.flags:
        if flagged.channel == name:
            low, high = flagged.window or (-np.inf, np.inf)
            inside = np.ones(time.shape, bool) if flagged.window is None else (time >= low) & (time <= high)
            found.append(quality.Verdict(quality.Flag[flagged.flag.upper()], inside, flagged.reason))
    return found


def judge_against_the_table(
    dataset: xr.Dataset, channels: Mapping[str, ChannelInstructions], warnings: list[Finding]
) -> xr.Dataset:
    """Flag accelerometers on the specimen that are practically dead beside those of the table along their axis."""
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


def _same_axis(first: ChannelInstructions, second: ChannelInstructions) -> bool:
    if first.direction is None or second.direction is None:
        return False
    return bool(abs(np.dot(first.direction, second.direction)) > SAME_AXIS)
