"""The layout of a delimited text and the names of its columns, found in its head before samples are read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from colonnade.errors import ReadError
from colonnade.readers.format import Options
from colonnade.readers.recording import TimeUnit
from colonnade.readers.text.cells import COMMENT_SIGNS, MISSING, WHITESPACE, Dialect
from colonnade.readers.text.encoding import Text, TextOptions, head_lines, looks_binary
from colonnade.readers.text.heading import Heading, HeadingLines, describe_columns, find_heading, unread_numbers
from colonnade.readers.text.layout import HeaderClaims, Layout, header_claims, touching_fields
from colonnade.readers.text.rows import RowForm
from colonnade.readers.text.sniffing import column_kinds, find_first_sample, sniff

DELIMITER_WORDS = {"comma": ",", "semicolon": ";", "tab": "\t", "\\t": "\t", "pipe": "|", "space": " ", "spaces": " "}


def _delimiter(text: str) -> str:
    character = DELIMITER_WORDS.get(text.casefold(), text)
    if len(character) != 1 or character.isalnum() or character in '"+-.\r\n':
        raise ValueError('one character was expected, such as ";" or ",", or "tab" or "spaces"')
    return character


class TableOptions(Options):
    """What can be said about a table; all of it is found if it is not given."""

    names_row: int | None = Field(
        default=None, ge=0, description="Row or line with the columns' names, from 1; 0 if they have no names."
    )
    units_row: int | None = Field(
        default=None, ge=0, description="Row or line with the columns' units, from 1; 0 if there are none."
    )
    time: str | int | None = Field(default=None, description="Name or number, from 1, of the column that is the clock.")
    time_unit: TimeUnit | None = Field(default=None, description="Unit of that column.")
    layout: Literal["columns", "running"] | None = Field(
        default=None,
        description='"columns" if each column is a channel, "running" if numbers run on from row to row.',
    )

    @model_validator(mode="after")
    def _unit_has_column(self) -> Self:
        if self.time_unit is not None and self.time is None:
            raise ValueError("time_unit needs `time`: the column it belongs to")
        return self

    def given_layout(self, kinds: Sequence[str]) -> Layout | None:
        """What the rows are, as given or as columns that are not all numbers have to be; None if neither says it."""
        if self.layout is not None:
            return Layout(self.layout, "as given")
        return Layout("columns") if self.time is not None or set(kinds) != {"number"} else None

    def heading_lines(self, found: HeadingLines) -> HeadingLines:
        """Lines of names and units: as given, else as found; a line that is given as one is not found as the other."""
        names, units = found.names, found.units
        if self.names_row is not None:
            names = self.names_row - 1 if self.names_row else None
            units = None if units == self.names_row - 1 else units
        if self.units_row is not None:
            units = self.units_row - 1 if self.units_row else None
            names = None if self.names_row is None and names == self.units_row - 1 else names
        return HeadingLines(names, units)


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

    @property
    def lines_to_pass(self) -> int:
        """Lines at the top of the file that cannot be samples."""
        return max(self.skip_rows, self.names_row or 0, self.units_row or 0)

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
    heading : Heading
    is_touching : bool
        Whether fields of a width that is declared touch, so that blanks do not separate them.
    is_named : bool
        Whether names or units are above the columns, and not words that may be a sentence.
    claims : HeaderClaims
        What the lines above the first sample say of the numbers.
    notes, warnings : tuple of str
    """

    text: Text
    form: RowForm
    heading: Heading
    is_touching: bool
    is_named: bool
    claims: HeaderClaims
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def read_header(text: Text, options: DelimitedOptions) -> Header:
    """
    Find out how a text is written and what its columns are called, from its head.

    Raises
    ------
    ReadError
        If it is empty, not text, or has no rows of numbers.
    """
    lines = _head(text, options)
    encoding = text.encoding
    start = options.lines_to_pass
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
    dialect = sniffed.dialect
    kinds = column_kinds(lines[start:], dialect, sniffed.columns)
    first = find_first_sample(lines, start, dialect, kinds) if sniffed.columns else None
    if first is None:
        raise ReadError(
            f"{text.path.name}: no rows of numbers were found in the first {len(lines)} lines{_as_given(options)}; the "
            f"first is {lines[0][:60]!r}."
        )
    where = options.heading_lines(find_heading(lines, options.skip_rows, first, dialect, kinds))
    width = _named_width(lines, where, dialect, kinds)
    heading = describe_columns(lines, where, first, dialect, width)
    texts = ", ".join(f'"{head}"' for head, kind in zip(heading.headings, kinds, strict=False) if kind == "text")
    notes: tuple[str, ...] = (f"encoding {encoding.name} ({encoding.evidence})",) if encoding.evidence else ()
    notes += (f"text, not numbers, in {texts}",) if texts else ()
    claims = header_claims("\n".join(lines[:first]))
    return Header(
        text,
        RowForm(dialect, tuple(kinds[:width]), len(kinds) - width, exact=text.made is not None),
        heading,
        touching_fields(lines, first, len(kinds), dialect, claims),
        _is_named(lines, where, heading, dialect, options),
        claims,
        notes + sniffed.notes,
        (*sniffed.warnings, *unread_numbers(lines, where, start, first, dialect)),
    )


def _head(text: Text, options: DelimitedOptions) -> list[str]:
    """Read the first lines of a text."""
    path = text.path
    try:
        lines, _ = head_lines(text, wanted=options.lines_to_pass + 200)
    except UnicodeError as error:
        raise ReadError(f"{path.name}: it is not {text.encoding.name} text ({error}).") from error
    if not any(line.strip() for line in lines):
        raise ReadError(f"{path.name}: the file is empty; rows of numbers were expected.")
    if reason := looks_binary(lines):
        raise ReadError(f"{path.name}: {reason}; text with rows of numbers was expected.")
    return lines


def _is_named(
    lines: list[str], where: HeadingLines, heading: Heading, dialect: Dialect, options: DelimitedOptions
) -> bool:
    """Say whether names are above the columns; between single blanks they may be the words of a sentence."""
    if not heading.names_most:
        return False
    if where.units is not None or where.names is None or options.names_row is not None:
        return True
    words = lines[where.names].split()
    between_blanks = dialect.delimiter == WHITESPACE and lines[where.names].strip() == " ".join(words)
    return not between_blanks or len(words) <= 2


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
