"""Delimited text, as spreadsheets and most recorders export it; what is not given is sniffed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from colonnade.errors import ReadError
from colonnade.readers.clock import ClockOptions, with_clocks
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import Head, from_head, head_of
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.refused import foreign_format
from colonnade.readers.text.damage import mend
from colonnade.readers.text.dialect import COMMENT_SIGNS, WHITESPACE, Dialect, column_kinds, find_first_sample, sniff
from colonnade.readers.text.encoding import Text, TextOptions, looks_binary
from colonnade.readers.text.heading import Heading, Lines, find_heading, read_heading, unread_numbers
from colonnade.readers.text.rows import RowForm, Rows, read_rows
from colonnade.readers.text.running import HeaderClaims, header_claims, read_series, series_of, why_running

NEAR_THOUSAND = 900
"""From here on a whole number may be the last one without a mark between thousands."""

DELIMITER_WORDS = {"comma": ",", "semicolon": ";", "tab": "\t", "\\t": "\t", "pipe": "|", "space": " ", "spaces": " "}


def _delimiter(text: str) -> str:
    character = DELIMITER_WORDS.get(text.casefold(), text)
    if len(character) != 1 or character.isalnum() or character in '"+-.\r\n':
        raise ValueError('one character was expected, such as ";" or ",", or "tab" or "spaces"')
    return character


class TableOptions(ClockOptions):
    """What can be said about a table; all of it is found if it is not given."""

    names_row: int | None = Field(
        default=None, ge=0, description="Row or line with the columns' names, from 1; 0 if they have no names."
    )
    units_row: int | None = Field(
        default=None, ge=0, description="Row or line with the columns' units, from 1; 0 if there are none."
    )
    layout: Literal["columns", "running"] | None = Field(
        default=None,
        description='"columns" if each column is a channel, "running" if numbers run on from row to row.',
    )

    @property
    def lines_to_pass(self) -> int:
        """Lines at the top of the file that cannot be samples."""
        return max(self.names_row or 0, self.units_row or 0)

    def heading_lines(self, found: Lines) -> Lines:
        """Lines of names and units: as given, else as found; a line that is given as one is not found as the other."""
        names, units = found
        if self.names_row is not None:
            names = self.names_row - 1 if self.names_row else None
            units = None if units == self.names_row - 1 else units
        if self.units_row is not None:
            units = self.units_row - 1 if self.units_row else None
            names = None if self.names_row is None and names == self.units_row - 1 else names
        return names, units


class DelimitedOptions(TextOptions, TableOptions):
    """What can be said about a delimited text file; all of it is sniffed if it is not given."""

    delimiter: Annotated[str, AfterValidator(_delimiter)] | None = Field(
        default=None, description='Between the cells of a row: one character, "tab", or "spaces" for any run of spaces.'
    )
    decimal: Literal[".", ","] | None = Field(default=None, description="Decimal sign.")
    thousands: Literal[".", ",", " ", "'"] | None = Field(
        default=None, description="Separator between groups of three digits."
    )
    skip_rows: int = Field(default=0, ge=0, description="Number of lines to skip at the top of the file.")
    comment: str | None = Field(default=None, min_length=1, description="What starts a line that is not a sample.")
    missing: tuple[str, ...] = Field(default=(), description='Texts that stand for a missing value, such as "-999".')

    @model_validator(mode="after")
    def _signs_differ(self) -> Self:
        if self.decimal is not None and self.decimal == self.thousands:
            raise ValueError(f'decimal and thousands are both "{self.decimal}"')
        return self


@dataclass(frozen=True)
class Header:
    """
    All that is known of a file before its samples are read.

    Attributes
    ----------
    text : Text
    form : RowForm
        How its rows are written.
    first : int
        Index of the line of the first sample, from 0.
    heading : Heading
    claims : HeaderClaims
        What the lines above the first sample say of the numbers.
    notes, warnings : tuple of str
    """

    text: Text
    form: RowForm
    first: int
    heading: Heading
    claims: HeaderClaims
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def read_header(text: Text, options: DelimitedOptions) -> Header:
    """Find out from a text's head how it is written and what its columns are; ReadError without rows of numbers."""
    lines = text.head()
    if not any(line.strip() for line in lines):
        raise ReadError(f"{text.path.name}: the file is empty; rows of numbers were expected.")
    if reason := looks_binary(lines):
        raise ReadError(f"{text.path.name}: {reason}; text with rows of numbers was expected.")
    start = max(options.skip_rows, options.lines_to_pass)
    given = Dialect(
        options.delimiter or ",",
        options.decimal or ".",
        options.thousands,
        comments=COMMENT_SIGNS if options.comment is None else (options.comment,),
        missing=frozenset(map(str.casefold, options.missing)),
    )
    dialect, columns, notes, warnings = sniff(
        lines[start:], given, delimiter=options.delimiter, decimal=options.decimal
    )
    kinds = column_kinds(lines[start:], dialect, columns)
    first = find_first_sample(lines, start, dialect, kinds) if columns else None
    if first is None:
        told = [f"{key} = {value!r}" for key, value in options.model_dump(exclude_defaults=True).items()]
        raise ReadError(
            f"{text.path.name}: no rows of numbers were found in the first {len(lines)} lines"
            f"{' with ' if told else ''}{', '.join(told)}; the first is {lines[0][:60]!r}."
        )
    where = options.heading_lines(find_heading(lines, options.skip_rows, first, dialect, kinds))
    heading = read_heading(lines, where, dialect, kinds, is_given=options.names_row is not None)
    texts = ", ".join(f'"{head}"' for head, kind in zip(heading.headings, kinds, strict=False) if kind == "text")
    encoding = text.encoding
    return Header(
        text,
        RowForm(dialect, kinds[: len(heading.names)], len(kinds) - len(heading.names), exact=text.made is not None),
        first,
        heading,
        header_claims("\n".join(lines[:first])),
        (
            *((f"encoding {encoding.name} ({encoding.evidence})",) if encoding.evidence else ()),
            *((f"text, not numbers, in {texts}",) if texts else ()),
            *notes,
        ),
        (*warnings, *unread_numbers(lines, where, start, first, dialect)),
    )


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is text with rows of numbers, and not in a known format that is not read here."""
    if reason := foreign_format(head):
        return Recognition(False, reason, is_known=True)
    try:
        header = read_header(Text.of(head.path), DelimitedOptions())
    except ReadError as error:
        return Recognition(False, str(error).removeprefix(f"{head.path.name}: "))
    width = len(header.heading.names)
    return Recognition(True, f"text with rows of {width} numbers from line {header.first + 1} on")


def read(path: Path, options: DelimitedOptions) -> Recording:
    """
    Read a delimited text file.

    Raises
    ------
    ReadError
        If it is not text or has no rows of numbers, a column that the options name is missing, or it is not clear
        whether rows are samples of several channels or pieces of one series. If it is a strong-motion record in a
        format that is not read, unless the options say how many lines to skip.
    """
    if not options.skip_rows and (reason := foreign_format(head_of(path))):
        raise ReadError(f"{path.name}: {reason}")
    return read_text(Text.of(path, options.encoding), options)


def read_text(text: Text, options: DelimitedOptions) -> Recording:
    """Read delimited text, whatever it was made of; see `read`."""
    header = read_header(text, options)
    rows = read_rows(text.pieces(header.first), header.form)
    is_open = options.layout is None and options.time is None and not header.heading.is_named
    reason = "as given" if options.layout == "running" else ""
    if is_open and set(header.form.kinds) == {"number"}:
        is_free = header.form.dialect.delimiter == WHITESPACE
        reason = why_running(text.path, rows.columns, header.claims, is_free=is_free)
    if not reason:
        return _recording(header, rows, options)
    series = read_series(text, header.form.dialect, header.first)
    recording = Recording(text.path, "delimited", (), notes=header.notes)
    return series_of(recording, series, len(header.heading.names), header.claims, reason)


def _recording(header: Header, rows: Rows, options: DelimitedOptions) -> Recording:
    """Say what the rows mean."""
    path, heading, kinds = header.text.path, header.heading, header.form.kinds
    mended = mend(rows, heading.headings)
    channels = []
    for head, name, unit, kind, values in zip(*heading[:3], kinds, mended.columns, strict=True):
        is_clock = kind == "time"
        channels.append(RecordedChannel(name, unit, values, values if is_clock else None, head, is_clock))
    recording = Recording(path, "delimited", tuple(channels), rows.start)
    found = with_clocks(recording, options.time, options.time_unit)
    if len(channels) == 1 and not found.channels[0].is_clock:  # a lone column has unit and interval of the header
        claimed = header.claims.channel(channels[0].values)
        lone = replace(channels[0], unit=channels[0].unit or claimed.unit, time=claimed.time, is_clock=False)
        found = replace(recording, channels=(lone,), notes=(header.claims.clock_note,))
    return replace(
        found,
        notes=(
            *(*header.notes, *heading.notes, f"first sample on line {header.first + 1}"),
            *(*found.notes, *mended.notes),
        ),
        warnings=(*header.warnings, *found.warnings, *mended.warnings, *_divided(recording, header, options)),
    )


def _divided(recording: Recording, header: Header, options: DelimitedOptions) -> Iterator[str]:
    """Doubt columns that go from whole numbers just below 1000 to just above 1: as with a mark between thousands."""
    if options.decimal is not None or options.thousands is not None:
        return
    for channel in recording.channels:
        size = np.abs(channel.values)
        high, low = (size >= NEAR_THOUSAND) & (size < 1000), (size >= 1) & (size < 1.1)
        if high.any() and ((high[1:] & low[:-1]) | (low[1:] & high[:-1])).any() and not (size[high] % 1).any():
            sign = header.form.dialect.decimal
            yield (
                f'"{channel.heading}" goes from just below 1000 to just above 1: "{sign}" was read as a decimal sign; '
                f'if it stands between thousands, set thousands = "{sign}"'
            )


FORMAT = Format(
    name="delimited",
    summary="Delimited text: CSV, TSV, columns between spaces; with or without names, units and preamble.",
    suffixes=(".csv", ".txt", ".tsv", ".dat", ".asc"),
    options=DelimitedOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
