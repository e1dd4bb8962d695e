"""Ingest: raw files -> channels as recorded and in SI, with quality flags; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.review import Review
from colonnade.campaign.settings import QualitySettings
from colonnade.errors import StageError
from colonnade.findings import Finding, Severity
from colonnade.readers.recording import RecordedChannel, Recording, Window
from colonnade.signals import quality, timing
from colonnade.signals.samples import side_by_side
from colonnade.stages.ingesting import columns
from colonnade.stages.ingesting.columns import (
    ChannelInputs,
    channel_verdicts,
    clock_verdicts,
    dimension_of,
    find_column,
    flag_dead_on_specimen,
    reviewed,
    rounding,
    too_short,
    unit_findings,
    within,
)
from colonnade.stages.parts.inputs import Inputs
from colonnade.store.description import variable_name

if TYPE_CHECKING:
    import xarray as xr

RAW_FILE = "raw file"
"""Kind of what a reader warns of: damage, cells without a number, what it had to guess."""


class IngestInputs(Inputs):
    """
    What `ingest` reads of the campaign.

    Attributes
    ----------
    files : dict
        How each recorder's file is read: format and options, which the reader has used.
    sampling_rates : dict
        Hz by recorder, where the file has no time column.
    day : date or None
        The day of the test.
    review : Review
        What people decided about the test; its corrections are in the channels' factors, its trim in the window.
    """

    files: dict[str, dict[str, Any]]
    sampling_rates: dict[str, float | None]
    channels: dict[str, ChannelInputs]
    window: tuple[float, float] | None
    day: date | None = None
    review: Review = Review()
    settings: QualitySettings

    def wanted(self, recorder: str) -> Window | None:
        """Give the part of a recorder's file that the test is; None for all, as for channels with their own clocks."""
        if self.window is None or any(
            channel.time is not None for channel in self.channels.values() if channel.recorder == recorder
        ):
            return None
        return Window(*self.window, self.sampling_rates.get(recorder))

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> IngestInputs:
        """Gather what `ingest` reads for one test."""
        setup, review = campaign.setups[test.setup], campaign.review(test.id)
        return cls(
            files={name: recorder.file.model_dump() for name, recorder in setup.recorders.items()},
            sampling_rates={name: recorder.sampling_rate for name, recorder in setup.recorders.items()},
            channels={
                name: ChannelInputs(
                    **{key: getattr(channel, key) for key in ChannelInputs.model_fields}
                    | {"factor": channel.factor * review.factors.get(name, 1.0)}
                )
                for name, channel in campaign.channels(test).items()
            },
            window=review.within(test.window),
            day=test.date,
            review=review,
            settings=campaign.processing,
        )


def ingest(recordings: Mapping[str, Recording], inputs: IngestInputs) -> xr.Dataset:
    """
    Convert what was recorded to SI and check it.

    Parameters
    ----------
    recordings : mapping of str to Recording
        The test's raw files by recorder.
    inputs : IngestInputs

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
    import xarray as xr

    warnings = [Finding.of(each, RAW_FILE) for recording in recordings.values() for each in recording.warnings]
    begin = inputs.window[0] if inputs.window else 0.0
    warnings += columns.contradictions(recordings, inputs.day, begin)
    stamps: dict[str, Array] = {}
    timed: dict[str, list[quality.Verdict]] = {}
    tracks: list[_Track] = []
    for name, channel in inputs.channels.items():
        if channel.recorder not in recordings:
            raise StageError(
                f'channel {name} is recorded by "{channel.recorder}", but the test has no file from that recorder. '
                f'Give its `file` as a table: {{main = "…", {channel.recorder} = "…"}}.'
            )
        recording = recordings[channel.recorder]
        column = find_column(recording, name, channel, inputs.sampling_rates.get(channel.recorder))
        findings = unit_findings(recording, column, name, channel)
        time, values = within(column, inputs.window)
        dimension = dimension_of(stamps, time, name, channel)
        if dimension not in stamps:
            clock = timing.read_clock(time)
            if not np.isfinite(clock.interval):
                raise too_short(name, time.size, inputs.window)
            stamps[dimension], timed[dimension] = time, clock_verdicts(time, clock, inputs.settings)
            findings += rounding(recording, clock, inputs.settings.jitter)
        tracks.append(_Track(name, channel, column, dimension, values, findings))
    judged = side_by_side(lambda track: _judged(track, stamps[track.dimension], timed[track.dimension], inputs), tracks)
    variables: dict[str, Any] = {}
    for described, found in judged:
        variables |= described
        warnings += found
    warnings += _of_clocks(tracks, timed)
    dataset = xr.Dataset(
        variables,
        coords={dimension: (dimension, time) for dimension, time in stamps.items()},
        attrs={"notes": "; ".join(_notes(recordings)), "recorded_at": columns.recorded_at(recordings, begin)},
    )
    dataset = flag_dead_on_specimen(dataset, inputs.channels, warnings)
    dataset.attrs["warnings"] = warnings
    if inputs.review.sentences:
        dataset.attrs["review"] = list(inputs.review.sentences)
    return dataset


@dataclass(frozen=True)
class _Track:
    """One channel on its clock, with the findings before its quality is checked."""

    name: str
    channel: ChannelInputs
    column: RecordedChannel
    dimension: str
    values: Array
    warnings: list[Finding]


def _judged(
    track: _Track, time: Array, timed: list[quality.Verdict], inputs: IngestInputs
) -> tuple[dict[str, Any], list[Finding]]:
    """Variables of a channel, and all its findings but those of its clock."""
    channel, values = track.channel, track.values
    physical = values * channel.factor
    physical += channel.offset
    verdicts = channel_verdicts(time, values, physical, channel, inputs.settings)
    flags, found = quality.combine([*timed, *verdicts], values.size)
    seen, decisions = quality.combine(reviewed(track.name, time, inputs.review), values.size)
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
    """Findings about a clock, once for all channels on it."""
    found = []
    for dimension, verdicts in timed.items():
        timed_so = [track for track in tracks if track.dimension == dimension]
        names = ", ".join(track.name for track in timed_so)
        whose = f"channel{'s' if len(timed_so) > 1 else ''} {names}"
        for verdict in verdicts:
            if not verdict.reason:
                continue
            finding = replace(verdict.finding, text=f"{whose}: {verdict.reason}.")
            telling = [track for track in timed_so if track.channel.on == "specimen"] or timed_so
            is_lost = any(timing.loses_motion(track.values, verdict.where) for track in telling)
            if verdict.flag == quality.Flag.FAIL and is_lost:
                why = "They are left out, and the largest readings may be among them: repair the time column."
                finding = replace(finding, text=f"{finding} {why}", severity=Severity.SERIOUS)
            found.append(finding)
    return found


def _notes(recordings: Mapping[str, Recording]) -> list[str]:
    return [f"{recording.path.name}: {note}" for recording in recordings.values() for note in recording.notes]
