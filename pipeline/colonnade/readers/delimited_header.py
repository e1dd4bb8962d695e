"""How a delimited text is written and what its columns are called, found in its head before samples are read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from colonnade.errors import ReadError
from colonnade.readers.cells import COMMENT_SIGNS, MISSING, WHITESPACE, Dialect
from colonnade.readers.damage import Source
from colonnade.readers.first_sample import column_kinds, find_first_sample
from colonnade.readers.heading import Heading, HeadingLines, describe_columns, find_heading, unread_numbers
from colonnade.readers.row_layout import Named
from colonnade.readers.sniffing import sniff
from colonnade.readers.text_encoding import (
    Encoding,
    detect_encoding,
    head_lines,
    known_encoding,
    looks_binary,
)
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
    layout: Literal["columns", "running"] | None = Field(
        default=None,
        description='"columns" where each column is a channel, "running" where numbers run on from row to row.',
    )

    @model_validator(mode="after")
    def _signs_differ(self) -> Self:
        if self.decimal is not None and self.decimal == self.thousands:
            raise ValueError(f'decimal and thousands are both "{self.decimal}"')
        if self.time_unit is not None and self.time is None:
            raise ValueError("time_unit needs `time`: the column it belongs to")
        return self


@dataclass(frozen=True)
class Header:
    """
    All that is known of a file before its samples are read.

    Attributes
    ----------
    source : Source
    heading : Heading
    named : str
        Whether names or units stand above the columns, or words that may be a sentence.
    above : str
        The lines above the first sample.
    notes, warnings : tuple of str
    """

    source: Source
    heading: Heading
    named: Named
    above: str
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


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
    return Header(
        source,
        heading,
        _named(lines, where, heading, sniffed.dialect, options),
        "\n".join(lines[:first]),
        notes + sniffed.notes,
        (*sniffed.warnings, *unread),
    )


def _named(
    lines: list[str], where: HeadingLines, heading: Heading, dialect: Dialect, options: DelimitedOptions
) -> Named:
    """Say whether names stand above the columns; between single blanks they may be the words of a sentence."""
    if not heading.names_most:
        return ""
    if where.units is not None or where.names is None or options.names_row is not None:
        return "names"
    words = lines[where.names].split()
    between_blanks = dialect.delimiter == WHITESPACE and lines[where.names].strip() == " ".join(words)
    return "words" if between_blanks and len(words) > 2 else "names"


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
