"""Names and units of columns: the lines that hold them, and `LVDT 1 [mm]` split in two."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

from colonnade.readers.text.cells import WHITESPACE, Dialect, kind_of, looks_like_numbers, quoted_cells
from colonnade.readers.text.sniffing import DELIMITERS

_BASE = (
    r"(?:[kKMGmµμun]|c|d)?(?:m|s|g|N|V|A|W|J|Hz|Pa|rad|bar|strain|eps|ε|m/m)|g's|gal|Gal|in|inch(?:es)?|ft|lbf?|kip|psi|ksi"
    r"|kg|t|m?l|min|h|hr|°|deg(?:rees?)?|°C|degC|K|%|‰|-|volts?|amps?|sec(?:onds?|s)?|Sek(?:unden)?|msec|ms|hertz"
    r"|met(?:er|re)s?|mm|newtons?|counts?|LSB|digits?|rpm|mil"
)
UNIT = re.compile(
    rf"(?:{_BASE})(?:(?:\^|\*\*)?-?[0-9²³])?(?:\s?[/·*. ]\s?(?:{_BASE})(?:(?:\^|\*\*)?-?[0-9²³])?)*\.?", re.IGNORECASE
)
BRACKETED = re.compile(r"(?P<name>.*?)(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))\s*")
BEFORE_PLOT = re.compile(r"(?P<name>.*?\w)\s*[\[(](?P<unit>[^\[\]()]*)[\])]\s*(?P<plot>-\s.*)")
"""`Time [s] - Plot 0`, as LabVIEW exports its graphs."""
SOLIDUS = re.compile(r"(?P<name>.*\w{2}.*?)(?:\s*/\s*|\s+in\s+)(?P<unit>\S+)")
LETTERED = re.compile(r"(.+?)\s*\([A-Z]\)\s*")
"""`LVDT (A)`, `Acc (V)`: the letter is a unit or a label."""
RULE = re.compile(r"[\s\-=_*+|;,.]*")


@dataclass(frozen=True)
class Heading:
    """
    What is above the samples.

    Attributes
    ----------
    first : int
        Index of the line of the first sample, from 0.
    headings, names : tuple of str
        As written, and without units; one a column.
    units : tuple of (str or None)
    notes, warnings : tuple of str
    """

    first: int
    headings: tuple[str, ...]
    names: tuple[str, ...]
    units: tuple[str | None, ...]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def names_most(self) -> bool:
        """Whether more than half of the columns have a name or a unit; a title above a table fills a cell only."""
        own = [
            head != f"column {number}" or unit is not None
            for number, (head, unit) in enumerate(zip(self.headings, self.units, strict=True), start=1)
        ]
        return 2 * sum(own) > len(own)


@dataclass(frozen=True)
class HeadingLines:
    """Lines of names and units, counted from 0, if there are any."""

    names: int | None
    units: int | None


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
    match = BRACKETED.fullmatch(heading)
    if match and (name := match["name"].rstrip()):
        square, round_ = match["square"], match["round"]
        if square is not None and not square.strip().isdigit():
            return name, square.strip() or None
        if round_ is not None and looks_like_unit(round_):
            return name, round_.strip()
    match = BEFORE_PLOT.fullmatch(heading)
    if match and looks_like_unit(match["unit"]):
        return f"{match['name']} {match['plot']}", match["unit"].strip()
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
    for sign in sorted(dialect.comments, key=len, reverse=True):
        if bare.startswith(sign) and dialect.delimiter != sign:
            bare = bare.lstrip(sign).strip(" ")
            break
    if RULE.fullmatch(bare) or bare == "":
        return None
    if columns == 1:
        return [bare.strip().strip('";,\t').strip()]
    for cells in _ways_to_cut(bare, dialect):
        while len(cells) > columns and cells[-1] == "":
            cells = cells[:-1]
        if len(cells) == columns:
            return [cell.strip().strip('"').strip() for cell in cells]
    return None


def _ways_to_cut(line: str, dialect: Dialect) -> Iterator[list[str]]:
    """Cut a line at the samples' delimiter, at wide gaps, then at other delimiters."""
    if dialect.delimiter == WHITESPACE:
        words = dialect.split(line)
        if not any(word.endswith((",", ":", ";")) for word in words):  # else a sentence, or names between commas
            yield words
    elif dialect.delimiter.isspace():
        yield dialect.split(line)
    else:
        yield quoted_cells(line, dialect.delimiter)
    yield re.split(r"\s{2,}|\t", line.strip())
    if dialect.delimiter.isspace() or dialect.delimiter not in line:
        yield from (quoted_cells(line, delimiter) for delimiter in DELIMITERS if delimiter != WHITESPACE)
    # Else it uses the samples' delimiter, only not as often: a line of the preamble, or a damaged one.


def find_heading(lines: list[str], start: int, first: int, dialect: Dialect, kinds: list[str]) -> HeadingLines:
    """
    Find the lines of names and units above the first sample.

    Parameters
    ----------
    lines : list of str
        Head of the file.
    start, first : int
        Index of the first line that may be looked at, and of the first sample.
    dialect : Dialect
    kinds : list of str
        What each column holds, by `cells.kind_of`.
    """
    fitting = _lines_of_cells(lines, start, first, dialect, kinds)
    if not fitting:
        return HeadingLines(None, None)
    index, cells = fitting[0]
    filled = [cell for cell in cells if cell]
    units = [cell for cell in filled if looks_like_unit(cell)]
    if len(fitting) == 2 and len(units) >= 0.6 * len(filled):
        return HeadingLines(fitting[1][0], index)
    # A single line of units: nobody calls two channels "mm", but two channels are in mm.
    repeated_or_bracketed = len(set(units)) < len(units) or all(cell.startswith(("[", "(")) for cell in units)
    if len(units) == len(filled) and repeated_or_bracketed:
        return HeadingLines(None, index)
    return HeadingLines(index, None)


def _lines_of_cells(
    lines: list[str], start: int, first: int, dialect: Dialect, kinds: list[str]
) -> list[tuple[int, list[str]]]:
    """Find up to two lines right above the first sample that have a cell a column, with some that is not a value."""
    fitting: list[tuple[int, list[str]]] = []
    looked_at = 0
    for index in range(first - 1, start - 1, -1):
        if dialect.is_blank(lines[index]) or RULE.fullmatch(lines[index]):
            continue
        looked_at += 1
        cells = heading_cells(lines[index], dialect, len(kinds)) if looked_at <= 2 else None
        if cells is None or not _says_something(cells, dialect, kinds):
            break
        fitting.append((index, cells))
    return fitting


def _says_something(cells: list[str], dialect: Dialect, kinds: list[str]) -> bool:
    """Whether some cell could not be a value of its column."""
    return any(
        kind_of(cell, dialect) == "text"
        for cell, kind in zip(cells, kinds, strict=True)
        if kind in ("number", "time", "empty")
    )


def describe_columns(lines: list[str], where: HeadingLines, first: int, dialect: Dialect, columns: int) -> Heading:
    """Take names and units from their lines; columns without a name are called by their number."""
    names_row = _row(lines, where.names, dialect, columns)
    units_row = _row(lines, where.units, dialect, columns)
    labels = _labels(names_row)
    parts = [(cell, None) if cell in labels else take_apart(cell) for cell in names_row]
    units: list[str | None] = []
    for cell, (_, unit) in zip(units_row, parts, strict=True):
        bare = re.sub(r"^[\[(](.*)[\])]$", r"\1", cell).strip()
        units.append(bare or unit)
    headings = tuple(cell or f"column {number}" for number, cell in enumerate(names_row, 1))
    names = tuple(name or f"column {number}" for number, (name, _) in enumerate(parts, 1))
    notes = _names_notes(where, headings, units)
    warnings = []
    numbers = sum(dialect.is_number(cell) for cell in names_row)
    if where.names is not None and 2 * numbers > columns:
        warnings.append(
            f"line {where.names + 1} is used for the names although {numbers} of its {columns} cells are numbers; set "
            "names_row = 0 if it is a sample"
        )
    notes.append(f"first sample on line {first + 1}")
    repeated = sorted(name for name, count in Counter(headings).items() if count > 1)
    if repeated:
        warnings.append(f'several columns are called "{repeated[0]}": give the number of the right one')
    return Heading(first, headings, names, tuple(units), tuple(notes), tuple(warnings))


def _labels(cells: list[str]) -> set[str]:
    """Find heads that tell columns of one name apart by a letter: in `Acc (V)` next to `Acc (H)` it is not a unit."""
    alike: defaultdict[str, set[str]] = defaultdict(set)
    for cell in cells:
        if match := LETTERED.fullmatch(cell):
            alike[match[1]].add(cell)
    return {cell for heads in alike.values() if len(heads) > 1 for cell in heads}


def _names_notes(where: HeadingLines, headings: tuple[str, ...], units: list[str | None]) -> list[str]:
    """Say which lines hold names and units."""
    columns = len(headings)
    if where.names is None:
        notes = [f'no names above the samples: columns are called "column 1" to "column {columns}"']
    elif columns > 1:
        notes = [f'names on line {where.names + 1} ("{headings[0]}", …)']
    else:
        notes = [f"name on line {where.names + 1}"]
    if where.units is not None:
        notes.append(f"units on line {where.units + 1}")
    elif any(units):
        notes.append(f'units in the names (as in "{next(h for h, u in zip(headings, units, strict=True) if u)}")')
    return notes


def unread_numbers(lines: list[str], where: HeadingLines, start: int, first: int, dialect: Dialect) -> list[str]:
    """Tell of lines right above the first sample that hold numbers too, but not one for each column."""
    taken = {where.names, where.units}
    skipped = []
    for index in range(first - 1, start - 1, -1):
        line = lines[index]
        if index in taken or dialect.is_comment(line) or not looks_like_numbers(line):
            break
        skipped.append(index + 1)
    if not skipped:
        return []
    places = f"lines {skipped[-1]} to {skipped[0]}" if len(skipped) > 1 else f"line {skipped[0]}"
    return [
        f"{places} above the first sample: numbers, but not one for each column; not read "
        f'("{lines[skipped[0] - 1].strip()[:50]}")'
    ]


def _row(lines: list[str], index: int | None, dialect: Dialect, columns: int) -> list[str]:
    if index is None:
        return [""] * columns
    cells = heading_cells(lines[index], dialect, columns)
    if cells is None:  # a line that was given, not found: whatever its number of cells
        cells = dialect.split(lines[index])
    return (cells + [""] * columns)[:columns]
