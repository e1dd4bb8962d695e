"""Ingest: raw files -> channels as recorded and in SI, with quality flags; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade import units
from colonnade.campaign import Campaign, Test
from colonnade.errors import StageError, UnitError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.signals import quality, timing
from colonnade.store.variables import variable_name

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


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    files : dict
        How each recorder's file is read: format and options, which the reader has used.
    sampling_rates : dict
        Hz by recorder, where the file has no time column.
    """

    model_config = ConfigDict(frozen=True)

    files: dict[str, dict[str, Any]]
    sampling_rates: dict[str, float | None]
    channels: dict[str, ChannelInstructions]
    window: tuple[float, float] | None
    spike_threshold: float
    flat_duration: float
    gap: float
    jitter: float


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `ingest` reads for one test."""
    setup, settings = campaign.setups[test.setup], campaign.processing
    return Instructions(
        files={name: recorder.file.model_dump() for name, recorder in setup.recorders.items()},
        sampling_rates={name: recorder.sampling_rate for name, recorder in setup.recorders.items()},
        channels={
            name: ChannelInstructions(**{key: getattr(channel, key) for key in ChannelInstructions.model_fields})
            for name, channel in setup.channels.items()
        },
        window=test.window,
        spike_threshold=settings.spike_threshold,
        flat_duration=settings.flat_duration,
        gap=settings.gap,
        jitter=settings.jitter,
    )


def ingest(recordings: Mapping[str, Recording], instructions: Instructions) -> xr.Dataset:
    """
    Bring what was recorded into SI and judge it.

    Parameters
    ----------
    recordings : mapping of str to Recording
        The test's raw files by recorder.
    instructions : Instructions

    Returns
    -------
    recorded : xr.Dataset
        For each channel `<name>` (SI), `<name>_recorded` (as in the file) and `<name>_quality` (flags), on `elapsed`
        for the main recorder's clock and `elapsed_<...>` for others.

    Raises
    ------
    StageError
        If a recorder has no file, a channel no clock, or the window holds nothing.
    ReadError
        If a column is not in its file.
    """
    warnings = [warning for recording in recordings.values() for warning in recording.warnings]
    dataset = xr.Dataset(attrs={"notes": "; ".join(_notes(recordings))})
    clocks: dict[str, Array] = {}
    for name, channel in instructions.channels.items():
        if channel.recorder not in recordings:
            raise StageError(
                f'channel {name} is recorded by "{channel.recorder}", and the test names no file of it. Give '
                f'its `file` as a table: {{main = "…", {channel.recorder} = "…"}}.'
            )
        recording = recordings[channel.recorder]
        column = _column(recording, name, channel, instructions)
        warnings += _unit_warnings(recording, column, name, channel)
        time, values = _windowed(column, name, instructions)
        clock = _clock_name(clocks, time, name, channel)
        if clock not in clocks:
            clocks[clock] = time
            warnings += _rounding(recording, timing.read_clock(time), instructions)
        dataset = dataset.assign(_variables(name, channel, clock, time, values, column, instructions, warnings))
    dataset = dataset.assign_coords({clock: (clock, time) for clock, time in clocks.items()})
    dataset = _judge_against_the_table(dataset, instructions, warnings)
    dataset.attrs["warnings"] = warnings
    return dataset


def _notes(recordings: Mapping[str, Recording]) -> list[str]:
    return [f"{recording.path.name}: {note}" for recording in recordings.values() for note in recording.notes]


def _column(
    recording: Recording, name: str, channel: ChannelInstructions, instructions: Instructions
) -> RecordedChannel:
    if channel.time is not None:
        return recording.on_clock(channel.column, channel.time)
    column = recording.channel(channel.column)
    rate = instructions.sampling_rates.get(channel.recorder)
    if column.time is not None and rate is None:
        return column
    if rate is None:
        raise StageError(
            f"channel {name}: {recording.path.name} has no time column that I recognise, and the set-up gives no "
            'sampling rate. Add `sampling_rate = "200 Hz"` to the recorder, or name the column (`time`) in its `file`.'
        )
    return RecordedChannel(
        column.name, column.unit, column.values, np.arange(column.values.size) / rate, column.heading
    )


def _unit_warnings(recording: Recording, column: RecordedChannel, name: str, channel: ChannelInstructions) -> list[str]:
    if column.unit is None or channel.unit is None:
        return []
    try:
        agree = units.same_unit(column.unit, channel.unit)
    except UnitError:
        return []
    if agree:
        return []
    return [
        f'channel {name}: {recording.path.name} says "{column.unit}" for column "{column.heading}", the campaign file '
        f'says "{channel.unit}", which was taken. One of them is wrong.'
    ]


def _windowed(column: RecordedChannel, name: str, instructions: Instructions) -> tuple[Array, Array]:
    time = column.time if column.time is not None else np.empty(0)
    values = column.values
    if instructions.window is not None:
        low, high = instructions.window
        inside = (time >= low) & (time <= high)
        time, values = time[inside], values[inside]
    if time.size < 2 or not np.isfinite(timing.read_clock(time).interval):
        within = (
            ""
            if instructions.window is None
            else f" between {instructions.window[0]:g} and {instructions.window[1]:g} s"
        )
        raise StageError(
            f"channel {name} has {time.size} samples{within}; at least two at increasing times were expected. "
            "Look at the file's time column and at the test's `window`."
        )
    return time, values


def _rounding(recording: Recording, clock: timing.Clock, instructions: Instructions) -> list[str]:
    if clock.resolution <= instructions.jitter * clock.interval:
        return []
    return [
        f"{recording.path.name}: the times are rounded to {1e3 * clock.resolution:g} ms; an even clock of "
        f"{1 / clock.interval:.5g} Hz meets them all and is used."
    ]


def _clock_name(clocks: dict[str, Array], time: Array, name: str, channel: ChannelInstructions) -> str:
    """Name of the dimension: channels share one only where their times are the same."""
    base = "elapsed" if channel.recorder == "main" else f"elapsed_{variable_name(channel.recorder)}"
    if channel.time is not None:
        base = f"elapsed_{variable_name(name)}"
    known = clocks.get(base)
    if known is None or (known.size == time.size and np.array_equal(known, time, equal_nan=True)):
        return base
    return f"elapsed_{variable_name(name)}"


def _variables(
    name: str,
    channel: ChannelInstructions,
    clock: str,
    time: Array,
    values: Array,
    column: RecordedChannel,
    instructions: Instructions,
    warnings: list[str],
) -> dict[str, Any]:
    physical = values * channel.factor + channel.offset
    stamps = timing.read_clock(time)
    verdicts = [
        quality.check_missing(time, values),
        timing.check_order(time, stamps),
        timing.check_gaps(stamps, factor=instructions.gap),
        timing.check_jitter(stamps, share=instructions.jitter, factor=instructions.gap),
        quality.check_flat(time, values, duration=instructions.flat_duration),
        quality.check_spikes(time, values, threshold=instructions.spike_threshold),
    ]
    if channel.range_recorded is not None:
        verdicts.append(quality.check_clipping(time, values, full_scale=channel.range_recorded))
    elif channel.full_scale is not None:
        verdicts.append(quality.check_clipping(time, physical, full_scale=channel.full_scale))
    flags, reasons = quality.combine(verdicts, values.size)
    warnings += [f"channel {name}: {reason}." for reason in reasons]
    variable = variable_name(name)
    attributes = {
        "channel": name,
        "quantity": channel.quantity,
        "recorder": channel.recorder,
        "recorded_unit": channel.unit or column.unit or "",
        "column": column.heading,
        "quality_report": "; ".join(reasons),
    }
    return {
        variable: (clock, physical, {key: value for key, value in attributes.items() if value}),
        f"{variable}_recorded": (clock, values),
        f"{variable}_quality": (clock, flags),
    }


def _judge_against_the_table(dataset: xr.Dataset, instructions: Instructions, warnings: list[str]) -> xr.Dataset:
    """Flag accelerometers on the specimen that are practically dead beside those of the table along their axis."""
    accelerometers = {
        name: channel for name, channel in instructions.channels.items() if channel.quantity == "acceleration"
    }
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
            warnings.append(f"channel {name}: {verdict.reason}.")
            report = dataset[variable].attrs.get("quality_report", "")
            dataset[variable].attrs["quality_report"] = "; ".join(filter(None, (report, verdict.reason)))
    return dataset


def _same_axis(first: ChannelInstructions, second: ChannelInstructions) -> bool:
    if first.direction is None or second.direction is None:
        return False
    return bool(abs(np.dot(first.direction, second.direction)) > SAME_AXIS)
