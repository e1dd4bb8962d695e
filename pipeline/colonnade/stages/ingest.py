"""Ingest: raw files -> channels as recorded and in SI, with quality flags; nothing is changed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, timedelta
from functools import cached_property
from typing import Any

import numpy as np

from colonnade import units
from colonnade.arrays import Array, Dataset, dataset
from colonnade.campaign import Campaign, Test
from colonnade.campaign.channel import RecordedAs
from colonnade.campaign.review import Review
from colonnade.campaign.settings import QualitySettings
from colonnade.errors import ReadError, StageError, count
from colonnade.findings import Finding, serious, warning
from colonnade.readers.clock import moment_after
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.heading import LETTERED
from colonnade.signals import quality, timing
from colonnade.signals.samples import side_by_side
from colonnade.store.description import variable_name
from colonnade.store.provenance import Inputs

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
        What people decided about the test; its trim is in the window.
    """

    files: dict[str, dict[str, Any]]
    sampling_rates: dict[str, float | None]
    channels: dict[str, RecordedAs]
    window: tuple[float, float] | None
    day: date | None = None
    review: Review = Review()
    settings: QualitySettings

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> IngestInputs:
        """Gather what `ingest` reads for one test."""
        setup, review = campaign.setups[test.setup], campaign.review(test.id)
        return cls(
            files={name: recorder.file.model_dump() for name, recorder in setup.recorders.items()},
            sampling_rates={name: recorder.sampling_rate for name, recorder in setup.recorders.items()},
            channels=dict[str, RecordedAs](campaign.channels(test)),
            window=review.within(test.window),
            day=test.date,
            review=review,
            settings=campaign.processing,
        )


def ingest(recordings: Mapping[str, Recording], inputs: IngestInputs) -> Dataset:
    """
    Convert what was recorded to SI and check it.

    Parameters
    ----------
    recordings : mapping of str to Recording
        The test's raw files by recorder.
    inputs : IngestInputs

    Returns
    -------
    recorded : Dataset
        For each channel `<name>` (SI), `<name>_recorded` (as in the file) and `<name>_quality` (flags), on `elapsed`
        for the main recorder's clock and `elapsed_<...>` for others.

    Raises
    ------
    StageError
        If a recorder has no file, a channel no clock, or the window holds nothing.
    ReadError
        If a column is not in its file.
    """
    warnings = [warning(RAW_FILE, each) for recording in recordings.values() for each in recording.warnings]
    begin = inputs.window[0] if inputs.window else 0.0
    warnings += contradictions(recordings, inputs.day, begin)
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
        warnings += unit_findings(recording, column, name, channel)
        time, values = column.time if column.time is not None else np.empty(0), column.values
        if inputs.window is not None:
            inside = (time >= inputs.window[0]) & (time <= inputs.window[1])
            time, values = time[inside], values[inside]
        dimension = dimension_of(stamps, time, name, channel)
        if dimension not in stamps:
            clock = timing.read_clock(time)
            if not np.isfinite(clock.interval):
                part = "" if inputs.window is None else f" between {inputs.window[0]:g} and {inputs.window[1]:g} s"
                raise StageError(
                    f"channel {name} has {count(time.size, 'sample')}{part}; at least two at increasing times were "
                    "expected. Check the file's time column and the test's `window`."
                )
            stamps[dimension], timed[dimension] = time, _clock_verdicts(time, clock, inputs.settings)
        factor = channel.factor * inputs.review.factors.get(name, 1.0)
        tracks.append(_Track(name, channel, column, dimension, values, factor))
    table = [track for track in tracks if track.channel.on == "table" and track.channel.quantity == "acceleration"]
    judged = side_by_side(
        lambda track: _judged(track, table, stamps[track.dimension], timed[track.dimension], inputs), tracks
    )
    warnings += [finding for _, found in judged for finding in found]
    for dimension, verdicts in timed.items():
        names = [track.name for track in tracks if track.dimension == dimension]
        warnings += _told(f"channel{'s' if len(names) > 1 else ''} {', '.join(names)}", verdicts)
    notes = [f"{recording.path.name}: {note}" for recording in recordings.values() for note in recording.notes]
    recorded = dataset(
        {name: variable for variables, _ in judged for name, variable in variables.items()},
        coords={dimension: (dimension, time) for dimension, time in stamps.items()},
        attrs={"notes": "; ".join(notes), "recorded_at": recorded_at(recordings, begin), "warnings": warnings},
    )
    if inputs.review.sentences:
        recorded.attrs["review"] = list(inputs.review.sentences)
    return recorded


@dataclass(frozen=True)
class _Track:
    """One channel on its clock: its values as in the file, and what they are multiplied by."""

    name: str
    channel: RecordedAs
    column: RecordedChannel
    dimension: str
    values: Array
    factor: float

    @cached_property
    def physical(self) -> Array:
        """Values in SI, made by the thread that judges them first."""
        physical = self.values * self.factor
        if self.channel.offset:
            physical += self.channel.offset
        return physical


def _judged(
    track: _Track, table: Sequence[_Track], time: Array, timed: list[quality.Verdict], inputs: IngestInputs
) -> tuple[dict[str, Any], list[Finding]]:
    """Variables of a channel, and all its findings but those of its clock."""
    channel, values, physical = track.channel, track.values, track.physical
    verdicts = channel_verdicts(time, values, physical, channel, inputs.settings)
    if channel.on == "specimen" and channel.quantity == "acceleration":
        axis = np.array(channel.direction or NO_AXIS)
        along = [other.physical for other in table if abs(axis @ (other.channel.direction or NO_AXIS)) > SAME_AXIS]
        if along:
            verdicts.append(quality.check_dead(physical, max(along, key=np.nanstd), share=DEAD_SHARE))
    flags, found = quality.combine([*timed, *verdicts, *reviewed(track.name, time, inputs.review)], values.size)
    variable = variable_name(track.name)
    attributes = {
        "channel": track.name,
        "quantity": channel.quantity,
        "recorder": channel.recorder,
        "recorded_unit": channel.unit or track.column.unit or "",
        "column": track.column.heading,
        "quality_report": "; ".join(map(str, found)),
    }
    variables = {
        variable: (track.dimension, physical, {key: value for key, value in attributes.items() if value}),
        f"{variable}_recorded": (track.dimension, values),
        f"{variable}_quality": (track.dimension, flags),
    }
    return variables, _told(f"channel {track.name}", verdicts)


def _told(whose: str, verdicts: Sequence[quality.Verdict]) -> list[Finding]:
    """Findings of verdicts that are not good."""
    return [replace(each.finding, text=f"{whose}: {each.reason}.") for each in verdicts if each.reason]


DEAD_SHARE = 0.08
"""An accelerometer on the specimen that moves less than this share of the table's is practically dead."""

NO_AXIS = (0.0, 0.0, 0.0)

SAME_AXIS = 0.9
"""Smallest product of two directions with which they are compared."""


def _clock_verdicts(stamps: Array, clock: timing.Clock, settings: QualitySettings) -> list[quality.Verdict]:
    """Check the times of a file, of shape (n,), s; `clock` is read from them."""
    if clock.is_exact and settings.jitter > 4 * timing.EXACT:
        return []
    steps = timing.check_steps(clock, share=settings.jitter, factor=settings.gap)
    return [timing.check_order(stamps, clock), *steps]


def channel_verdicts(
    stamps: Array, values: Array, physical: Array, channel: RecordedAs, settings: QualitySettings
) -> list[quality.Verdict]:
    """Check one channel alone: its times (s), its values as in the file and in SI."""
    found = [
        quality.check_missing(stamps, values),
        quality.check_flat(stamps, values, duration=settings.flat_duration),
        quality.check_spikes(stamps, values, threshold=settings.spike_threshold),
    ]
    if channel.range_recorded is not None:
        found.append(quality.check_clipping(stamps, values, full_scale=channel.range_recorded))
    elif channel.full_scale is not None:
        found.append(quality.check_clipping(stamps, physical, full_scale=channel.full_scale))
    sees_rotation = channel.on == "specimen" and channel.quantity in ("displacement", "angle")
    if sees_rotation:
        found.append(quality.check_torn(stamps, values))
    # Nothing but a saturated channel holds an acceleration; a specimen holds a place only for long.
    is_acceleration = channel.on == "table" and channel.quantity == "acceleration"
    if (sees_rotation or is_acceleration) and not any(
        verdict.reason and verdict.finding.kind == "end of the range" for verdict in found
    ):
        longest = settings.flat_duration if sees_rotation else np.inf
        found.append(quality.check_rails(stamps, values, longest=longest))
    return found


def reviewed(name: str, time: Array, review: Review) -> list[quality.Verdict]:
    """Verdicts of the people who reviewed a channel."""
    found = []
    for flagged in review.flags:
        if flagged.channel == name:
            low, high = flagged.window or (-np.inf, np.inf)
            inside = np.ones(time.shape, bool) if flagged.window is None else (time >= low) & (time <= high)
            found.append(quality.Verdict(quality.Flag[flagged.flag.upper()], inside, Finding(flagged.reason)))
    return found


def find_column(recording: Recording, name: str, channel: RecordedAs, rate: float | None) -> RecordedChannel:
    """Find the column of a channel, with its times; `rate` is that of the recorder, Hz, if its file has no clock."""
    try:
        if channel.time is not None:
            return recording.on_clock(channel.column, channel.time)
        column = recording.channel(channel.column)
    except ReadError as error:
        raise ReadError(f"channel {name}: {error}") from error
    if rate is not None:
        return replace(column, time=np.arange(column.values.size) / rate)
    if column.time is None:
        raise StageError(
            f"channel {name}: {recording.path.name} has no recognised time column, and the set-up "
            'gives no sampling rate. Add `sampling_rate = "200 Hz"` to the recorder, or name the '
            "column (`time`) in its `file`."
        )
    return column


def unit_findings(recording: Recording, column: RecordedChannel, name: str, channel: RecordedAs) -> list[Finding]:
    """Report a unit of the file that is not the one of the campaign file."""
    if column.unit is None or channel.unit is None or units.same_unit(column.unit, channel.unit):
        return []
    if LETTERED.fullmatch(column.heading) and column.unit in ("V", "A") and channel.gain is None:
        return []  # a label
    own = units.find_unit(column.unit)
    if channel.gain is not None and (own is None or own.si_unit in ("1", "count")):
        return []  # the recorder's own, such as counts, which only names what unit and gain explain
    text = (
        f'channel {name}: {recording.path.name} says "{column.unit}" for column "{column.heading}", the campaign file '
        f'says "{channel.unit}", which was used. One of them is wrong.'
    )
    return [serious("unit", text)]


def dimension_of(known: Mapping[str, Array], time: Array, name: str, channel: RecordedAs) -> str:
    """Name of the channel's dimension: two channels share one only if their times are the same."""
    own = f"elapsed_{variable_name(name)}"
    wanted = "elapsed" if channel.recorder == "main" else f"elapsed_{variable_name(channel.recorder)}"
    for candidate in (own,) if channel.time is not None else (wanted, own):
        taken = known.get(candidate)
        if taken is None or (taken.size == time.size and np.array_equal(taken, time, equal_nan=True)):
            return candidate
    return f"{own}_{len(known)}"


def recorded_at(recordings: Mapping[str, Recording], begin: float = 0.0) -> str:
    """Write when a test that begins so late in its files (s) was recorded, by the first that says so, or nothing."""
    starts = (moment_after(recording.start, begin) for recording in recordings.values())
    return next((_written(start) for start in starts if start is not None), "")


def contradictions(recordings: Mapping[str, Recording], day: date | None, begin: float = 0.0) -> list[Finding]:
    """Warn of each file whose day is not that of the campaign file; `begin` as of `recorded_at`."""
    found = []
    for recording in recordings.values():
        start = moment_after(recording.start, begin)
        if day is None or start is None:
            continue
        # A file in UTC does not say in which zone the laboratory's clocks are.
        if abs((start.date() - day).days) > (start.utcoffset() == timedelta(0)):
            text = (
                f"{recording.path.name} was recorded on {start.date()} by its own clock ({_written(start)}), but the "
                f"campaign file gives the date {day}. Correct the date, or check that this is the file of the test and "
                "that the recorder's clock was right."
            )
            found.append(warning("date", text))
    return found


def _written(start: datetime) -> str:
    text = start.isoformat(" ", "milliseconds" if start.microsecond else "seconds")
    return text if start.tzinfo is not None else f"{text}, no time zone recorded"
