"""Delimited text, as spreadsheets and most recorders export it; what is not said about a file is sniffed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from colonnade.errors import ReadError
from colonnade.readers.cells import COMMENT_SIGNS, MISSING, Dialect
from colonnade.readers.clock import Clocks, find_clocks, in_seconds
from colonnade.readers.damage import Damage, Source, find_damage, report_missing, unfinished_number
from colonnade.readers.first_sample import column_kinds, find_first_sample
from colonnade.readers.heading import Heading, HeadingLines, describe_columns, find_heading, unread_numbers
from colonnade.readers.recording import TIME_UNITS, Array, RecordedChannel, Recording, Window
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.samples import Samples, Stretch, read_samples
from colonnade.readers.sniffing import sniff
from colonnade.readers.text_encoding import (
    Encoding,
    detect_encoding,
    ends_within_line,
    head_lines,
    known_encoding,
    looks_binary,
)
from colonnade.readers.timestamps import past_midnight
from colonnade.readers.values import TimeUnit

DELIMITER_WORDS = {"comma": ",", "semicolon": ";", "tab": "\t", "\\t": "\t", "pipe": "|", "space": " ", "spaces": " "}


def _delimiter(text: str) -> str:
    character = DELIMITER_WORDS.get(text.casefold(), text)
    if len(character) != 1 or character.isalnum() or character in '"+-.\r\n':
        raise ValueError('one character was expected, such as ";" or ",", or "tab" or "spaces"')
    return character


class DelimitedOptions(BaseModel):
    """What can be said about a delimited text file; all of it is sniffed where it is not said."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    delimiter: Annotated[str, AfterValidator(_delimiter)] | None = Field(
        default=None, description='Between the cells of a row: one character, "tab", or "spaces" for any run of spaces.'
    )
    decimal: Literal[".", ","] | None = Field(default=None, description="Decimal sign.")
    thousands: Literal[".", ",", " ", "'"] | None = Field(
        default=None, description="Sign between groups of three digits."
    )
    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        default=None, description='Of the text, such as "utf-8", "utf-16", "latin-1".'
    )
    skip_rows: int = Field(default=0, ge=0, description="Lines at the top of the file that are not looked at.")
    names_row: int | None = Field(
        default=None, ge=0, description="Line with the columns' names, from 1; 0 where there is none."
    )
    units_row: int | None = Field(
        default=None, ge=0, description="Line with the columns' units, from 1; 0 where there is none."
    )
    time: str | int | None = Field(default=None, description="Name or number, from 1, of the column that is the clock.")
    time_unit: TimeUnit | None = Field(default=None, description="Unit of that column.")
    comment: str | None = Field(default=None, min_length=1, description="What starts a line that is not a sample.")
    missing: tuple[str, ...] = Field(default=(), description='Texts that stand for a missing value, such as "-999".')

    @model_validator(mode="after")
    def _signs_differ(self) -> Self:
        if self.decimal is not None and self.decimal == self.thousands:
            raise ValueError(f'decimal and thousands are both "{self.decimal}"')
        if self.time_unit is not None and self.time is None:
            raise ValueError("time_unit needs `time`: the column it belongs to")
        return self


@dataclass(frozen=True)
class Header:
    """All that is known of a file before its samples are read."""

    source: Source
    heading: Heading
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def recognise(path: Path) -> Recognition:
    """Say whether a file is text with rows of numbers."""
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
        If it is not text or has no rows of numbers, or a column that the options name is not there.
    """
    header = read_header(path, options)
    stretch = None if window is None else _stretch(header, options, window)
    return _recording(header, _samples(header, options, stretch), options)


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


def read_header(path: Path, options: DelimitedOptions) -> Header:
    """
    Find out how a file is written and what its columns are called, from its head.

    Raises
    ------
    ReadError
        If it is empty, not text, or has no rows of numbers.
    """
    encoding = Encoding(options.encoding, "") if options.encoding else detect_encoding(path)
    start = max(options.skip_rows, options.names_row or 0, options.units_row or 0)
    try:
        lines, _ = head_lines(path, encoding.name, wanted=start + 200)
    except UnicodeError as error:
        raise ReadError(f"{path.name}: it is not text in {encoding.name} ({error}).") from error
    if not any(line.strip() for line in lines):
        raise ReadError(f"{path.name}: the file is empty; rows of numbers were expected.")
    if reason := looks_binary(lines):
        raise ReadError(f"{path.name}: {reason}; text with rows of numbers was expected.")
    given = Dialect(
        encoding.name,
        delimiter=options.delimiter or ",",
        decimal=options.decimal or ".",
        comments=COMMENT_SIGNS if options.comment is None else (options.comment,),
        missing=MISSING | {text.casefold() for text in options.missing},
    )
    sniffed = sniff(
        lines[start:], given, delimiter=options.delimiter, decimal=options.decimal, thousands=options.thousands
    )
    kinds = column_kinds(lines[start:], sniffed.dialect, sniffed.columns)
    first = find_first_sample(lines, start, sniffed.dialect, kinds) if sniffed.columns else None
    if first is None:
        raise ReadError(
            f"{path.name}: no rows of numbers were found in the {len(lines)} lines looked at"
            f"{_as_given(options)}; the first is {lines[0][:60]!r}."
        )
    where = _heading_lines(lines, first, sniffed.dialect, kinds, options)
    width = _named_width(lines, where, sniffed.dialect, kinds)
    heading = describe_columns(lines, where, first, sniffed.dialect, width)
    source = Source(path, sniffed.dialect, first, heading.headings, tuple(kinds[:width]), len(kinds) - width)
    notes: tuple[str, ...] = (f"encoding {encoding.name} ({encoding.evidence})",) if encoding.evidence else ()
    text_columns = [f'"{head}"' for head, kind in zip(heading.headings, source.kinds, strict=True) if kind == "text"]
    if text_columns:
        notes += (f"text, not numbers, in {', '.join(text_columns)}",)
    unread = unread_numbers(lines, where, start, first, sniffed.dialect)
    return Header(source, heading, notes + sniffed.notes, (*sniffed.warnings, *unread))


def _heading_lines(
    lines: list[str], first: int, dialect: Dialect, kinds: list[str], options: DelimitedOptions
) -> HeadingLines:
    """Lines of names and units: as given, else as found."""
    found = find_heading(lines, options.skip_rows, first, dialect, kinds)
    names = found.names if options.names_row is None else options.names_row - 1
    units = found.units if options.units_row is None else options.units_row - 1
    if options.names_row is not None and options.units_row is None and units == names:
        units = None
    if options.units_row is not None and options.names_row is None and names == units:
        names = None
    return HeadingLines(
        names if names is not None and names >= 0 else None, units if units is not None and units >= 0 else None
    )


def _named_width(lines: list[str], where: HeadingLines, dialect: Dialect, kinds: list[str]) -> int:
    """Count the columns without the empty ones at the end that have no name either."""
    heading = describe_columns(lines, where, 0, dialect, len(kinds))
    width = len(kinds)
    while width > 1 and kinds[width - 1] == "empty" and heading.headings[width - 1] == f"column {width}":
        width -= 1
    return width


def _as_given(options: DelimitedOptions) -> str:
    """Remind of the options that the sniffing had to keep to."""
    told = [f"{key} = {value!r}" for key, value in options.model_dump(exclude_defaults=True).items()]
    return f" with {', '.join(told)}" if told else ""


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
    read_window=read,
)
