"""Names and units of columns: the lines that hold them, and `LVDT 1 [mm]` split in two."""

from __future__ import annotations

import re
from itertools import islice
from typing import NamedTuple

from colonnade.readers.text.dialect import DELIMITERS, WHITESPACE, Dialect, kind_of, quoted_cells

_BASE = (
    r"(?:[kKMGmµμun]|c|d)?(?:m|s|g|N|V|A|W|J|Hz|Pa|rad|bar|strain|eps|ε|m/m)|g's|gal|Gal|in|inch(?:es)?|ft|lbf?|kip|psi|ksi"
    r"|kg|t|m?l|min|h|hr|°|deg(?:rees?)?|°C|degC|K|%|‰|-|volts?|amps?|sec(?:onds?|s)?|Sek(?:unden)?|msec|ms|hertz"
    r"|met(?:er|re)s?|mm|newtons?|counts?|LSB|digits?|rpm|mil"
)
UNIT = re.compile(
    rf"(?:{_BASE})(?:(?:\^|\*\*)?-?[0-9²³])?(?:\s?[/·*. ]\s?(?:{_BASE})(?:(?:\^|\*\*)?-?[0-9²³])?)*\.?", re.IGNORECASE
)
BRACKETED = re.compile(r"(?P<name>.*?)(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))\s*(?P<plot>-\s.*)?")
"""`LVDT 1 [mm]`, `Accel (g)`, and `Time [s] - Plot 0`, as LabVIEW exports its graphs."""
SOLIDUS = re.compile(r"(?P<name>.*\w{2}.*?)(?:\s*/\s*|\s+in\s+)(?P<unit>\S+)")
LONGEST_HEADING = 200
"""Characters of a heading; a line of a damaged file may have far more."""
LETTERED = re.compile(r"(.+?)\s*\([A-Z]\)\s*")
"""`LVDT (A)`, `Acc (V)`: the letter is a unit or a label."""
RULE = re.compile(r"[\s\-=_*+|;,.]*")


class Heading(NamedTuple):
    """What is above the samples: heads of columns as written, and taken apart."""

    headings: tuple[str, ...]
    names: tuple[str, ...]
    units: tuple[str | None, ...]
    is_named: bool
    """Whether names or units are above most columns, and not words that may be a sentence."""
    notes: tuple[str, ...]


Lines = tuple[int, int]
"""Indices of the lines of names and of units; -1 if there is none."""


def read_heading(lines: list[str], where: Lines, dialect: Dialect, kinds: tuple[str, ...]) -> Heading:
    """
    Take names and units from the lines `where` they are; columns without a name are called by their number.

    An empty column at the end without a name is left out.
    """
    names_row, units_row = (_row(lines, index, dialect, len(kinds)) for index in where)
    width = len(kinds)
    while width > 1 and kinds[width - 1] == "empty" and not names_row[width - 1]:
        width -= 1
    parts = [take_apart(cell) for cell in names_row[:width]]
    bare = [re.sub(r"^[\[(](.*)[\])]$", r"\1", cell).strip() for cell in units_row[:width]]
    units = tuple(own or unit for own, (_, unit) in zip(bare, parts, strict=True))
    headings = tuple(cell or f"column {number}" for number, cell in enumerate(names_row[:width], 1))
    names = tuple(name or f"column {number}" for number, (name, _) in enumerate(parts, 1))
    found = zip(("names", "units"), where, (names_row, units_row), strict=True)
    notes = tuple(f'{what} on line {index + 1} ("{row[0]}", …)' for what, index, row in found if index >= 0)
    # A title above a table fills a cell only; words between single blanks may be a sentence.
    is_named = 2 * sum(bool(name or unit) for name, unit in zip(names_row, units, strict=False)) > width
    if is_named and where[0] >= 0 > where[1] and dialect.delimiter == WHITESPACE:
        words = lines[where[0]].split()
        is_named = len(words) <= 2 or lines[where[0]].strip() != " ".join(words)
    return Heading(headings, names, units, is_named, notes)


def find_heading(lines: list[str], start: int, first: int, dialect: Dialect, kinds: tuple[str, ...]) -> Lines:
    """Find the lines of names and units between the index `start` and that of the first sample."""
    above = (n for n in range(first - 1, start - 1, -1) if not RULE.fullmatch(lines[n]))
    fitting: list[tuple[int, list[str]]] = []
    for index in islice(above, 2):
        cells = heading_cells(lines[index], dialect, len(kinds))
        # Some cell has to be one that could not be a value of its column.
        if cells is None or not any(
            kind_of(cell, dialect) == "text" for cell, kind in zip(cells, kinds, strict=True) if kind != "text"
        ):
            break
        fitting.append((index, [cell for cell in cells if cell]))
    if not fitting:
        return -1, -1
    index, filled = fitting[0]
    units = [cell for cell in filled if looks_like_unit(cell)]
    if len(fitting) == 2 and len(units) >= 0.6 * len(filled):
        return fitting[1][0], index
    # Nobody calls two channels "mm", but two channels are in mm.
    return (-1, index) if len(units) == len(filled) > len(set(units)) else (index, -1)


def looks_like_unit(text: str) -> bool:
    """
    Whether a text is a unit of measurement, by its spelling.

    Examples
    --------
    >>> [looks_like_unit(text) for text in ("mm", "g's", "m/s²", "Volts", "LVDT 1", "top")]
    [True, True, True, True, False, False]
    """
    return UNIT.fullmatch(text.strip().strip("[]()")) is not None


def take_apart(heading: str) -> tuple[str, str | None]:
    """
    Separate a column's name from its unit.

    Examples
    --------
    >>> take_apart("LVDT 1 [mm]"), take_apart("Time (s)"), take_apart("Kraft / kN"), take_apart("Accel (top)")
    (('LVDT 1', 'mm'), ('Time', 's'), ('Kraft', 'kN'), ('Accel (top)', None))
    >>> take_apart("Time [s] - Plot 0")
    ('Time - Plot 0', 's')
    """
    if len(heading) > LONGEST_HEADING:
        return heading, None
    match = BRACKETED.fullmatch(heading)
    if match and (name := match["name"].rstrip()):
        square, plot = match["square"], match["plot"]
        unit = (match["round"] if square is None else square).strip()
        if looks_like_unit(unit) or (square is not None and plot is None and not unit.isdigit()):
            return f"{name} {plot}" if plot else name, unit or None
    match = SOLIDUS.fullmatch(heading)
    if match and looks_like_unit(match["unit"]):
        return match["name"], match["unit"]
    return heading, None


def heading_cells(line: str, dialect: Dialect, columns: int) -> list[str] | None:
    """
    Cut a line of names or units into one cell a column, or give None if it does not fit.

    A line above the samples may use another delimiter than these, a comment sign before it, or one delimiter more.
    """
    bare = line.strip("\r\n ")
    sign = next((sign for sign in dialect.comments if bare.startswith(sign) and sign != dialect.delimiter), "")
    bare = bare.lstrip(sign).strip(" ") if sign else bare
    if columns == 1:
        return None if RULE.fullmatch(bare) else [bare.strip(' ";,\t')]
    ways = [re.split(r"\s{2,}|\t", bare.strip())]
    if dialect.delimiter.isspace() or dialect.delimiter not in bare:
        ways += [quoted_cells(bare, delimiter) for delimiter in DELIMITERS if delimiter != WHITESPACE]
    # Else it uses the samples' delimiter, only not as often: a line of the preamble, or a damaged one.
    if dialect.delimiter != WHITESPACE:
        ways.insert(0, quoted_cells(bare, dialect.delimiter))
    elif not re.search(r"[,:;](?:\s|$)", bare):  # else a sentence, or names between commas
        ways.insert(0, bare.split())
    for cells in ways:
        while len(cells) > columns and cells[-1] == "":
            cells.pop()
        if len(cells) == columns:
            return [cell.strip().strip('"').strip() for cell in cells]
    return None


def _row(lines: list[str], index: int, dialect: Dialect, columns: int) -> list[str]:
    """Cells of a line of names or units; one that was given, not found, may have any number."""
    cells = [] if index < 0 else heading_cells(lines[index], dialect, columns) or dialect.split(lines[index])
    return (cells + [""] * columns)[:columns]
