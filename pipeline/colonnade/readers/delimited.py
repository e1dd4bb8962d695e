"""Delimited text, as spreadsheets and most recorders export it; what is not said about a file is sniffed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.announced import Announced, announced
from colonnade.readers.cells import WHITESPACE
from colonnade.readers.clock import Clocks, even_times, find_clocks, in_seconds
from colonnade.readers.damage import Damage, Source, find_damage, report_missing, unfinished_number
from colonnade.readers.delimited_header import DelimitedOptions, Header, read_header
from colonnade.readers.recording import TIME_UNITS, Array, RecordedChannel, Recording, Window
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.row_layout import Verdict, judge
from colonnade.readers.running_block import fixed_fields, read_block, series_of, undecided
from colonnade.readers.samples import Samples, Stretch, read_samples
from colonnade.readers.strong_motion import foreign_format
from colonnade.readers.text_encoding import ends_within_line
from colonnade.readers.timestamps import past_midnight


def recognise(path: Path) -> Recognition:
    """Say whether a file is text with rows of numbers, and not a strong-motion record in a network's own format."""
    if reason := foreign_format(path):
        return Recognition(False, reason, is_known=True)
    try:
        header = read_header(path, DelimitedOptions())
    except ReadError as error:
        return Recognition(False, str(error).removeprefix(f"{path.name}: "))
    first = header.source.first + 1
    return Recognition(True, f"text with rows of {len(header.source.headings)} numbers from line {first} on")


def read(path: Path, options: DelimitedOptions, window: Window | None = None) -> Recording:
    """
    Read a delimited text file.

    Parameters
    ----------
    path : Path
    options : DelimitedOptions
    window : Window, optional
        What is wanted of it; some samples on either side may come along. Default: all.

    Raises
    ------
    ReadError
        If it is not text or has no rows of numbers, a column that the options name is not there, or it cannot be told
        whether rows are samples of several channels or pieces of one series. If it is a strong-motion record in a
        format that is not read, unless the options say how many lines to skip.
    """
    if not options.skip_rows and (reason := foreign_format(path)):
        raise ReadError(f"{path.name}: {reason}")
    header = read_header(path, options)
    stretch = None if window is None else _stretch(header, options, window)
    samples = _samples(header, options, stretch)
    verdict = _layout(header, samples, options)
    if verdict.layout == "columns":
        return _recording(header, samples, options)
    told, source = announced(header.above), header.source
    recording = Recording(path, "delimited", (), notes=header.notes)
    return series_of(recording, read_block(source, told.width), len(source.headings), told, verdict)


def _layout(header: Header, samples: Samples, options: DelimitedOptions) -> Verdict:
    """Decide whether columns are channels: as given, by what they hold, else by the evidence."""
    source = header.source
    if options.layout is not None:
        return Verdict(options.layout, ("as given",))
    if options.time is not None or any(kind in ("time", "text") for kind in source.kinds):
        return Verdict("columns")
    is_whole = samples.skipped == 0 and samples.reaches_end and not ends_within_line(source.path)
    is_free = source.dialect.delimiter == WHITESPACE
    told, columns, named = announced(header.above), samples.columns, header.named
    if told.fields and told.width and told.fields != len(columns):
        # Fields of fixed width may touch, and are not told apart by blanks then.
        fields = fixed_fields(source, told.fields, told.width)
        columns, named = (columns, named) if fields is None else (fields, "")
    verdict = judge(columns, told, named=named, is_free=is_free, is_whole=is_whole)
    if verdict.layout is None:
        raise ReadError(undecided(source.path, len(source.headings), verdict))
    return verdict


def _recording(header: Header, samples: Samples, options: DelimitedOptions) -> Recording:
    """Tell what the samples mean."""
    path = header.source.path
    is_cut = samples.reaches_end and ends_within_line(path)
    source = replace(header.source, skipped=samples.skipped, is_cut=is_cut)
    damage = find_damage(samples, source)
    number_cut, message = unfinished_number(samples, source)
    absent = report_missing(samples.columns, source, damage)
    columns = _mended(samples, source, damage, number_cut)
    heading = header.heading
    channels = tuple(
        RecordedChannel(name, unit, values, heading=head)
        for name, unit, values, head in zip(heading.names, heading.units, columns, heading.headings, strict=True)
    )
    recording = Recording(path, "delimited", channels, samples.start)
    clocks = _clocks(recording, source, options)
    if len(channels) == 1 and not clocks.columns:
        channels, clocks = _as_announced(channels[0], announced(header.above))
    return replace(
        recording,
        channels=tuple(
            replace(channel, time=time, is_clock=number in clocks.columns)
            for number, (channel, time) in enumerate(zip(channels, clocks.times, strict=True))
        ),
        notes=(
            *header.notes,
            *heading.notes,
            *clocks.notes,
            *damage.notes,
            *([message] if message and not number_cut else []),
        ),
        warnings=(
            *header.warnings,
            *heading.warnings,
            *clocks.warnings,
            *damage.warnings,
            *([message] if number_cut else []),
            *absent,
        ),
    )


def _as_announced(series: RecordedChannel, told: Announced) -> tuple[tuple[RecordedChannel, ...], Clocks]:
    """Take unit and interval of a single series from the lines above it, where it has none of its own."""
    time = None if told.step is None else even_times(series.values.size, told.step)
    note = "no clock" if told.step is None else f"clock: {told.step:g} s, as the header says"
    return (replace(series, unit=series.unit or told.unit),), Clocks(frozenset(), (time,), (note,), ())


def _samples(header: Header, options: DelimitedOptions, stretch: Stretch | None) -> Samples:
    source = header.source
    return read_samples(
        source.path, source.dialect, source.first, source.kinds, source.trailing, options.missing, stretch
    )


def _stretch(header: Header, options: DelimitedOptions, window: Window) -> Stretch | None:
    """Find the rows of a window; None, which is all of them, where the file has several clocks or timestamps."""
    if window.sampling_rate_hz is not None:
        return Stretch(window.low * window.sampling_rate_hz, window.high * window.sampling_rate_hz)
    head = _recording(header, _samples(header, options, Stretch(0.0, 0.0)), options)
    clocks = [number for number, channel in enumerate(head.channels) if channel.is_clock]
    if len(clocks) != 1 or header.source.kinds[clocks[0]] != "number":
        return None
    unit = options.time_unit or head.channels[clocks[0]].unit or "s"
    second = 1.0 / TIME_UNITS.get(unit.casefold(), 1.0)
    return Stretch(window.low * second, window.high * second, clocks[0])


def _mended(samples: Samples, source: Source, damage: Damage, number_cut: bool) -> list[Array]:
    """Columns without what is no sample, and with NaN where a value cannot be trusted to be its column's."""
    if number_cut:
        samples.columns[-1][-1] = np.nan
    mended = []
    for column, kind in zip(samples.columns, source.kinds, strict=True):
        column[damage.blanked] = np.nan
        kept = np.delete(column, damage.left_out) if damage.left_out.size else column
        mended.append(past_midnight(kept) if kind == "time" else kept)
    if not any(np.isfinite(column).any() for column in mended):
        raise ReadError(f"{source.path.name}: no cell from line {source.first + 1} on holds a number.")
    return mended


def _clocks(recording: Recording, source: Source, options: DelimitedOptions) -> Clocks:
    """Times of the channels: by the column that was given, else by those found."""
    if options.time is None:
        return find_clocks(recording.channels, source.kinds)
    clock = recording.channel(options.time)
    if not np.isfinite(clock.values).any():
        raise ReadError(
            f'{recording.path.name}: column "{clock.heading}" holds no number, so it cannot be the clock. '
            "Name a column of times, or leave `time` out."
        )
    index = next(number for number, channel in enumerate(recording.channels) if channel is clock)
    if source.kinds[index] == "time":
        time, how = clock.values, "timestamps"
    else:
        time, how = in_seconds(clock, options.time_unit or clock.unit)
    found = find_clocks(recording.channels, source.kinds)
    times = tuple(own if number in found.columns else time for number, own in enumerate(found.times))
    times = (*times[:index], time, *times[index + 1 :])
    return Clocks(found.columns | {index}, times, (f'clock: "{clock.heading}", as given ({how})',), ())


FORMAT = Format(
    name="delimited",
    summary="Delimited text: CSV, TSV, columns between spaces; with or without names, units and preamble.",
    suffixes=(".csv", ".txt", ".tsv", ".dat", ".asc"),
    options=DelimitedOptions,
    recognise=recognise,
    read=read,
    in_process=True,
    read_window=read,
)
