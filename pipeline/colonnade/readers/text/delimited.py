"""Delimited text, as spreadsheets and most recorders export it; what is not given is sniffed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import find_clocks, given_clock
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import Head, from_head, head_of
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording, Window
from colonnade.readers.refused import foreign_format
from colonnade.readers.text.cells import WHITESPACE
from colonnade.readers.text.columns import past_midnight
from colonnade.readers.text.damage import mend
from colonnade.readers.text.delimited_header import DelimitedOptions, Header, read_header
from colonnade.readers.text.encoding import Text, pieces_of_text, text_of
from colonnade.readers.text.layout import HeaderClaims, Layout, declared_layout, read_block, series_of
from colonnade.readers.text.rows import Rows, Stretch, read_rows


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is text with rows of numbers, and not in a known format that is not read here."""
    if reason := foreign_format(head):
        return Recognition(False, reason, is_known=True)
    path = head.path
    try:
        header = read_header(text_of(path), DelimitedOptions())
    except ReadError as error:
        return Recognition(False, str(error).removeprefix(f"{path.name}: "))
    width, first = len(header.form.kinds), header.heading.first + 1
    return Recognition(True, f"text with rows of {width} numbers from line {first} on")


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
        If it is not text or has no rows of numbers, a column that the options name is missing, or it is not clear
        whether rows are samples of several channels or pieces of one series. If it is a strong-motion record in a
        format that is not read, unless the options say how many lines to skip.
    """
    if not options.skip_rows and (reason := foreign_format(head_of(path))):
        raise ReadError(f"{path.name}: {reason}")
    return read_text(text_of(path, options.encoding), options, window)


def read_text(text: Text, options: DelimitedOptions, window: Window | None = None) -> Recording:
    """Read delimited text, whatever it was made of; see `read`."""
    path = text.path
    header = read_header(text, options)
    stretch = None if window is None else _stretch(header, options, window)
    header, rows = _grouped(header, _rows(header, stretch), stretch, options)
    claims, form = header.claims, header.form
    is_whole = rows.skipped == 0 and rows.reaches_end and not text.ends_within_line

    def series() -> Array:
        return read_block(text, form.dialect, header.heading.first, claims.width)

    layout = options.given_layout(form.kinds)
    if layout is None and header.is_touching:
        layout = Layout("running", f"the header declares rows of {claims.fields} fields, and these touch")
    layout = layout or declared_layout(
        path,
        rows.columns,
        claims,
        series if is_whole else None,
        is_named=header.is_named,
        is_free=form.dialect.delimiter == WHITESPACE,
    )
    if layout.kind == "columns":
        return _recording(header, rows, options)
    recording = Recording(path, "delimited", (), notes=header.notes)
    return series_of(recording, series(), len(form.kinds), claims, layout)


def _rows(header: Header, stretch: Stretch | None) -> Rows:
    path, pieces = header.text.path, pieces_of_text(header.text, header.heading.first)
    rows = read_rows(path, pieces, header.form, stretch)
    if not rows.size:
        raise ReadError(
            f"{path.name}: none of its {rows.skipped} samples is within the test's window. Check the file's "
            "times and the test's `window`, which counts from the file's own zero."
        )
    return rows


def _grouped(header: Header, rows: Rows, stretch: Stretch | None, options: DelimitedOptions) -> tuple[Header, Rows]:
    """Read columns again as text whose numbers seem to have signs between thousands, until all of these have them."""
    signs = rows.grouped if options.thousands is None else {}
    while signs := {column: sign for column, sign in signs.items() if sign != options.decimal}:
        form = replace(header.form, grouped=signs)
        again = _rows(replace(header, form=form), stretch)
        kept = {column: sign for column, sign in again.grouped.items() if column in signs}
        if kept == signs:
            named = ", ".join(f'"{header.heading.headings[column]}"' for column in signs)
            note = f"{named}: whole numbers with a sign between thousands ({' '.join(sorted({*signs.values()}))})"
            return replace(header, form=form, notes=(*header.notes, note)), again
        signs = kept
    return header, rows


def _recording(header: Header, rows: Rows, options: DelimitedOptions) -> Recording:
    """Say what the rows mean."""
    path, heading, kinds = header.text.path, header.heading, header.form.kinds
    is_cut = rows.reaches_end and header.text.ends_within_line
    mended = mend(rows, heading.headings, is_cut=is_cut)
    columns = [
        past_midnight(column) if kind == "time" else column for column, kind in zip(mended.columns, kinds, strict=True)
    ]
    if not any(np.isfinite(column).any() for column in columns):
        raise ReadError(f"{path.name}: no cell from line {heading.first + 1} on holds a number.")
    each = zip(heading.names, heading.units, columns, heading.headings, kinds, strict=True)
    channels = tuple(
        RecordedChannel(name, unit, values, values if kind == "time" else None, head, kind == "time")
        for name, unit, values, head, kind in each
    )
    recording = _on_clocks(Recording(path, "delimited", channels, rows.start), options, header.claims)
    return replace(
        recording,
        notes=(*header.notes, *heading.notes, *recording.notes, *mended.notes),
        warnings=(*header.warnings, *heading.warnings, *recording.warnings, *mended.warnings),
    )


def _on_clocks(recording: Recording, options: DelimitedOptions, claims: HeaderClaims) -> Recording:
    """Give channels the clock that was given, else those found; a lone column has unit and interval of the header."""
    found = find_clocks(recording.channels)
    if options.time is not None:
        given = given_clock(recording, options.time, options.time_unit)
        others = found.columns - given.columns
        times = tuple((found if number in others else given).times[number] for number in range(len(given.times)))
        return replace(given, columns=found.columns | given.columns, times=times).applied(recording)
    if len(recording.channels) > 1 or found.columns:
        return found.applied(recording)
    (lone,) = recording.channels
    lone = replace(lone, unit=lone.unit or claims.unit, time=claims.times(lone.values.size), is_clock=False)
    return replace(recording, channels=(lone,), notes=(claims.clock_note,))


def _stretch(header: Header, options: DelimitedOptions, window: Window) -> Stretch | None:
    """Find the rows of a window; None, which is all of them, if the file has several clocks or timestamps."""
    if window.sampling_rate_hz is not None:
        return Stretch(window.low * window.sampling_rate_hz, window.high * window.sampling_rate_hz)
    head = _recording(header, _rows(header, Stretch(0.0, 0.0)), options)
    clocks = [number for number, channel in enumerate(head.channels) if channel.is_clock]
    if len(clocks) != 1 or header.form.kinds[clocks[0]] != "number":
        return None
    unit = options.time_unit or head.channels[clocks[0]].unit or "s"
    second = 1.0 / TIME_UNITS.get(unit.casefold(), 1.0)
    return Stretch(window.low * second, window.high * second, clocks[0])


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
