"""Delimited text, as spreadsheets and most recorders export it; what is not given is sniffed."""

from __future__ import annotations

import re
from datetime import datetime
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

from pydantic import AfterValidator, Field

from colonnade.errors import ReadError
from colonnade.readers.clock import ClockOptions, moment_of, with_clocks
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import Head, from_head, head_of
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.refused import foreign_format
from colonnade.readers.text.dialect import (
    COMMENT_SIGNS,
    MISSING,
    SAMPLE_LINES,
    WHITESPACE,
    Dialect,
    find_first_sample,
    sniff,
)
from colonnade.readers.text.encoding import ASSUMED, Text, TextOptions, looks_binary
from colonnade.readers.text.heading import Heading, find_heading, read_heading
from colonnade.readers.text.rows import RowForm, read_rows
from colonnade.readers.text.running import HeaderClaims, header_claims, read_series, why_running

GROUPED = re.compile(r"[-+]?[1-9]\d{0,2}(?:[.,]\d{3})+")
"""A number whose signs may be decimal signs or stand between thousands."""
SIGNED = re.compile(r"[-+]?(?:\d+(?:[.,]\d+)?|\d{1,3}(?:[.,]\d{3})+(?:[.,]\d*)?)")
"""A number, whatever its decimal sign and its mark between thousands."""

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


class Header(NamedTuple):
    """All that is known of a file before its samples are read."""

    form: RowForm
    first: int
    """Index of the line of the first sample."""
    heading: Heading
    claims: HeaderClaims
    """What the lines above the first sample say of the numbers."""
    start: datetime | None
    """Date and time of the first sample."""
    notes: tuple[str, ...]


def read_header(text: Text, options: DelimitedOptions) -> Header:
    """Find out from a text's head how it is written and what its columns are; ReadError without rows of numbers."""
    lines = text.head()
    if reason := looks_binary(lines):
        raise ReadError(f"{text.path.name}: {reason}; text with rows of numbers was expected.")
    start = max(options.skip_rows, options.names_row or 0, options.units_row or 0)
    given = Dialect(
        options.delimiter or ",",
        options.decimal or ".",
        options.thousands,
        comments=COMMENT_SIGNS if options.comment is None else (options.comment,),
        missing=MISSING.union(map(str.casefold, options.missing)),
    )
    sniffed = sniff(lines[start:], given, delimiter=options.delimiter, decimal=options.decimal)
    dialect, kinds = sniffed.dialect, sniffed.kinds
    first = find_first_sample(lines, start, dialect, kinds)
    if first is None:
        told = [f"{key} = {value!r}" for key, value in options.model_dump(exclude_defaults=True).items()]
        raise ReadError(
            f"{text.path.name}: no rows of numbers were found in the first {len(lines)} lines"
            f"{' with ' if told else ''}{', '.join(told)}; the first is {''.join(lines[:1])[:60]!r}."
        )
    signed = _signed(lines[first : first + SAMPLE_LINES], dialect, kinds)
    if signed and options.decimal is None and options.thousands is None:
        raise ReadError(
            f'{text.path.name}: a sign in "{signed}" may be the decimal sign or stand between thousands. Say in `file` '
            'which is which: decimal = "." alone, or decimal = "," and thousands = ".", or the reverse.'
        )
    given_rows = (options.names_row, options.units_row)
    found = find_heading(lines, options.skip_rows, first, dialect, kinds)
    names, units = (line if row is None else row - 1 for row, line in zip(given_rows, found, strict=True))
    if names == units:  # a line that is given as one is not found as the other
        names, units = (names, -1) if options.units_row is None else (-1, units)
    heading = read_heading(lines, (names, units), dialect, kinds)
    notes = [*sniffed.notes, *heading.notes, f"first sample on line {first + 1}"]
    if text.made is None:
        why = " assumed: it is not UTF-8" if text.encoding == ASSUMED else ""
        notes.insert(0, f"encoding {text.encoding}{why}")
    width = len(heading.names)
    stamp = next((cell for cell, kind in zip(dialect.split(lines[first]), kinds, strict=True) if kind == "time"), "")
    form = RowForm(dialect, kinds[:width], len(kinds) - width, exact=text.made is not None)
    return Header(form, first, heading, header_claims("\n".join(lines[:first])), moment_of(stamp), tuple(notes))


def _signed(lines: list[str], dialect: Dialect, kinds: tuple[str, ...]) -> str:
    """A cell of a column that would hold other numbers if its signs were read otherwise; empty without one."""
    rows = [cells for line in lines if len(cells := dialect.split(line)) == len(kinds)]
    is_open = all(GROUPED.fullmatch(cell) for cells in rows for cell in cells if dialect.decimal in cell)
    for column, kind in enumerate(kinds):
        found = [cells[column] for cells in rows]
        signed = [cell for cell in found if "." in cell or "," in cell]
        is_doubtful = kind == "text" or (is_open and len(signed) < len(found))
        if signed and is_doubtful and all(map(SIGNED.fullmatch, found)):
            return signed[0]
    return ""


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
    form, heading, claims, notes = header.form, header.heading, header.claims, header.notes
    columns, warnings = read_rows(text.pieces(header.first), form, heading.headings)
    own = None if any(heading.units) else claims.unit
    channels = [
        RecordedChannel(name, unit or own, values, values if kind == "time" else None, head, kind == "time")
        for head, name, unit, kind, values in zip(*heading[:3], form.kinds, columns, strict=False)
    ]
    reason = "as given" if options.layout == "running" else ""
    is_open = options.layout is None and options.time is None and options.names_row is None and not heading.is_named
    if is_open and {*form.kinds} <= {"number", "empty"}:
        reason = why_running(text.path, columns, claims, is_free=form.dialect.delimiter == WHITESPACE)
    if reason:
        channels = [RecordedChannel("column 1", claims.unit, read_series(text, form.dialect, header.first))]
        notes, warnings = (*notes, f"numbers run on from row to row: {reason}"), []
    recording = Recording(text.path, "delimited", tuple(channels), header.start, notes, tuple(warnings))
    step = {"header.dt": claims.step} if claims.step else {}
    return with_clocks(recording, options.time, options.time_unit, step)


FORMAT = Format(
    name="delimited",
    summary="Delimited text: CSV, TSV, columns between spaces; with or without names, units and preamble.",
    suffixes=(".csv", ".txt", ".tsv", ".dat", ".asc"),
    options=DelimitedOptions,
    recognise=recognise,
    read=read,
    in_process=True,
)
