"""Ingest: raw files -> channels as recorded and in SI, with quality flags; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade import units
from colonnade.campaign import Campaign, Test
from colonnade.campaign.decision import Review
from colonnade.errors import StageError, UnitError
from colonnade.findings import Finding, note, serious
from colonnade.readers.recording import RecordedChannel, Recording, Window
from colonnade.signals import quality, timing
from colonnade.signals.parallel import side_by_side
from colonnade.stages.judging import (
    ChannelInstructions,
    Limits,
    channel_verdicts,
    clock_verdicts,
    judge_against_the_table,
    reviewed,
)
from colonnade.store.description import variable_name

Array = NDArray[np.float64]

RAW_FILE = "raw file"
"""Kind of what a reader warns of: damage, cells without a number, what it had to guess."""


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    files : dict
        How each recorder's file is read: format and options, which the reader has used.
    sampling_rates : dict
        Hz by recorder, where the file has no time column.
    review : Review
        What people decided about the test; its corrections are in the channels' factors, its trim in the window.
    """

    model_config = ConfigDict(frozen=True)

    files: dict[str, dict[str, Any]]
    sampling_rates: dict[str, float | None]
    channels: dict[str, ChannelInstructions]
    window: tuple[float, float] | None
    review: Review = Review()
    limits: Limits

    def wanted(self, recorder: str) -> Window | None:
        """Give the part of a recorder's file that the test is; None for all, as where channels have own clocks."""
        if self.window is None or any(
            channel.time is not None for channel in self.channels.values() if channel.recorder == recorder
        ):
            return None
        return Window(*self.window, self.sampling_rates.get(recorder))


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `ingest` reads for one test."""
    setup, settings, review = campaign.setups[test.setup], campaign.processing, campaign.review(test.id)
    return Instructions(
        files={name: recorder.file.model_dump() for name, recorder in setup.recorders.items()},
        sampling_rates={name: recorder.sampling_rate for name, recorder in setup.recorders.items()},
        channels={
            name: ChannelInstructions(
                **{key: getattr(channel, key) for key in ChannelInstructions.model_fields}
                | {"factor": channel.factor * review.factors.get(name, 1.0)}
            )
            for name, channel in campaign.channels(test).items()
        },
        window=review.within(test.window),
        review=review,
        limits=Limits(**{key: getattr(settings, key) for key in Limits.model_fields}),
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
    warnings = [Finding.of(told, RAW_FILE) for recording in recordings.values() for told in recording.warnings]
    stamps: dict[str, Array] = {}
    timed: dict[str, list[quality.Verdict]] = {}
    tracks: list[_Track] = []
    for name, channel in instructions.channels.items():
        if channel.recorder not in recordings:
            raise StageError(
                f'channel {name} is recorded by "{channel.recorder}", and the test names no file of it. Give '
                f'its `file` as a table: {{main = "…", {channel.recorder} = "…"}}.'
            )
        recording = recordings[channel.recorder]
        column = _column(recording, name, channel, instructions)
        told = _unit_warnings(recording, column, name, channel)
        time, values = _windowed(column, instructions.window)
        dimension = _dimension(stamps, time, name, channel)
        if dimension not in stamps:
            clock = timing.read_clock(time)
            if not np.isfinite(clock.interval):
                raise _too_short(name, time.size, instructions.window)
            stamps[dimension], timed[dimension] = time, clock_verdicts(time, clock, instructions.limits)
            told += _rounding(recording, clock, instructions)
        tracks.append(_Track(name, channel, column, dimension, values, told))
    judged = side_by_side(
        lambda track: _judged(track, stamps[track.dimension], timed[track.dimension], instructions), tracks
    )
    variables: dict[str, Any] = {}
    for described, found in judged:
        variables |= described
        warnings += found
    warnings += _of_clocks(tracks, timed)
    dataset = xr.Dataset(
        variables,
        coords={dimension: (dimension, time) for dimension, time in stamps.items()},
        attrs={"notes": "; ".join(_notes(recordings))},
    )
    dataset = judge_against_the_table(dataset, instructions.channels, warnings)
    dataset.attrs["warnings"] = warnings
    if instructions.review.told:
        dataset.attrs["review"] = list(instructions.review.told)
    return dataset


@dataclass(frozen=True)
class _Track:
    """One channel on its clock, with what there is to warn of before it is judged."""

    name: str
    channel: ChannelInstructions
    column: RecordedChannel
    dimension: str
    values: Array
    warnings: list[Finding]


def _judged(
    track: _Track, time: Array, timed: list[quality.Verdict], instructions: Instructions
) -> tuple[dict[str, Any], list[Finding]]:
    """Variables of a channel, and all that there is to warn of but for its clock's."""
    channel, values = track.channel, track.values
    physical = values * channel.factor
    physical += channel.offset
    verdicts = channel_verdicts(time, values, physical, channel, instructions.limits)
    flags, found = quality.combine([*timed, *verdicts], values.size)
    seen, decisions = quality.combine(reviewed(track.name, time, instructions.review), values.size)
    variable = variable_name(track.name)
    attributes = {
        "channel": track.name,
        "quantity": channel.quantity,
        "recorder": channel.recorder,
        "recorded_unit": channel.unit or track.column.unit or "",
        "column": track.column.heading,
        "quality_report": "; ".join(map(str, [*found, *decisions])),
    }
    variables = {
        variable: (track.dimension, physical, {key: value for key, value in attributes.items() if value}),
        f"{variable}_recorded": (track.dimension, values),
        f"{variable}_quality": (track.dimension, np.maximum(flags, seen) if decisions else flags),
    }
    own = [verdict.finding for verdict in verdicts if verdict.reason]
    return variables, [*track.warnings, *(replace(each, text=f"channel {track.name}: {each}.") for each in own)]


def _of_clocks(tracks: list[_Track], timed: Mapping[str, list[quality.Verdict]]) -> list[Finding]:
    """What the checks of a clock found, once for all channels on it."""
    found = []
    for dimension, verdicts in timed.items():
        names = [track.name for track in tracks if track.dimension == dimension]
        told = f"channel{'s' if len(names) > 1 else ''} {', '.join(names)}"
        found += [replace(verdict.finding, text=f"{told}: {verdict.reason}.") for verdict in verdicts if verdict.reason]
    return found


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


def _unit_warnings(
    recording: Recording, column: RecordedChannel, name: str, channel: ChannelInstructions
) -> list[Finding]:
    if column.unit is None or channel.unit is None:
        return []
    try:
        agree = units.same_unit(column.unit, channel.unit)
    except UnitError:
        return []
    if agree:
        return []
    return [
        serious(
            "unit",
            f'channel {name}: {recording.path.name} says "{column.unit}" for column "{column.heading}", the campaign '
            f'file says "{channel.unit}", which was taken. One of them is wrong.',
        )
    ]


def _windowed(column: RecordedChannel, window: tuple[float, float] | None) -> tuple[Array, Array]:
    """Times and values of a channel that belong to the test."""
    time = column.time if column.time is not None else np.empty(0)
    if window is None:
        return time, column.values
    inside = (time >= window[0]) & (time <= window[1])
    return time[inside], column.values[inside]


def _too_short(name: str, size: int, window: tuple[float, float] | None) -> StageError:
    within = "" if window is None else f" between {window[0]:g} and {window[1]:g} s"
    return StageError(
        f"channel {name} has {size} samples{within}; at least two at increasing times were expected. "
        "Look at the file's time column and at the test's `window`."
    )


def _rounding(recording: Recording, clock: timing.Clock, instructions: Instructions) -> list[Finding]:
    if not clock.resolution > instructions.limits.jitter * clock.interval:
        return []
    return [
        note(
            "rounded times",
            f"{recording.path.name}: the times are rounded to {1e3 * clock.resolution:g} ms; an even clock of "
            f"{1 / clock.interval:.5g} Hz meets them all and is used.",
        )
    ]


def _dimension(known: Mapping[str, Array], time: Array, name: str, channel: ChannelInstructions) -> str:
    """Name of the channel's dimension: two share one only where their times are the same."""
    own = f"elapsed_{variable_name(name)}"
    wanted = "elapsed" if channel.recorder == "main" else f"elapsed_{variable_name(channel.recorder)}"
    for candidate in (own,) if channel.time is not None else (wanted, own):
        taken = known.get(candidate)
        if taken is None or (taken.size == time.size and np.array_equal(taken, time, equal_nan=True)):
            return candidate
    return f"{own}_{len(known)}"
