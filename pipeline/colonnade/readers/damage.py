"""Rows of a text file that are not as they should be, and what becomes of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from colonnade.readers.body import sample_lines
from colonnade.readers.cells import Dialect, decimals_of, kind_of, looks_like_numbers
from colonnade.readers.first_sample import is_sample
from colonnade.readers.samples import Array, Samples

Fault = Literal["comment", "text", "cut", "struck out", "long", "short"]

SHOWN = 50
"""Characters of a line that a message quotes."""

SHORTEST_ENDING = 3
"""Rows at the end that lack the same last cells, from which on these columns are taken to be shorter."""


TAIL = 200
"""Rows at the end that show whether numbers are written with a fixed number of decimals."""


@dataclass(frozen=True)
class Source:
    """
    Where the samples stand in a file.

    Attributes
    ----------
    path : Path
    dialect : Dialect
    first : int
        Index of the line of the first sample, from 0.
    headings, kinds : tuple of str
        Name of each column and what it holds.
    trailing : int
        Nameless empty cells after these columns on every line, made by delimiters at its end.
    skipped : int
        Rows of the file that are not part of the table, at its start.
    is_cut : bool
        Whether the table ends with the file, and that within a line.
    """

    path: Path
    dialect: Dialect
    first: int
    headings: tuple[str, ...]
    kinds: tuple[str, ...]
    trailing: int = 0
    skipped: int = 0
    is_cut: bool = False

    def rows(self, wanted: NDArray[np.int64]) -> Iterator[Row]:
        """Find rows, given in rising order, in the file."""
        remaining = iter(wanted.tolist())
        sought = next(remaining, None)
        if sought is None:
            return
        for row, (line, text) in enumerate(sample_lines(self.path, self.dialect, self.first), -self.skipped):
            if row == sought:
                yield Row(row, line, text, self.dialect.split(text))
                sought = next(remaining, None)
                if sought is None:
                    return


@dataclass(frozen=True)
class Row:
    """A row of the table, from 0, with its line in the file, from 1."""

    row: int
    line: int
    text: str
    cells: list[str]


@dataclass(frozen=True)
class Damage:
    """
    What is wrong with a table.

    Attributes
    ----------
    left_out, blanked : ndarray of int
        Rows that are no samples, and samples of which no value can be told to its column.
    notes, warnings : tuple of str
    """

    left_out: NDArray[np.int64]
    blanked: NDArray[np.int64]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def find_damage(samples: Samples, source: Source) -> Damage:
    """
    Judge the doubtful rows.

    A line without any number, with text, is left out, as is a last line that was cut off. A row with too many or too
    few cells counts as missing, because a value may stand in its neighbour's column; unless all rows to the end lack
    last cells: then these columns are shorter.
    """
    size = samples.columns[0].size
    wanted = np.union1d(samples.doubtful, [size - 1]) if source.is_cut else samples.doubtful
    faults: dict[Fault, list[Row]] = {fault: [] for fault in get_args(Fault)}
    for row in source.rows(wanted):
        fault = _fault(row, samples.columns, source, is_cut=source.is_cut and row.row == size - 1)
        if fault is not None:
            faults[fault].append(row)
    notes, warnings = [], []
    gone = sum(len(faults[fault]) for fault in ("comment", "text", "cut"))
    ending = _ending(faults["short"], size - gone)
    if ending:
        faults["short"] = faults["short"][: -len(ending)]
        notes.append(
            f"from line {ending[0].line} on there are {len(ending[0].cells)} cells: "
            "the last columns are shorter than the others"
        )
    if faults["comment"]:
        notes.append(_told(faults["comment"], "left out as a comment"))
    width = len(source.headings)
    for fault, told in (
        ("text", "left out: text and no number"),
        ("cut", f"left out: the file ends here, before all {width} cells"),
        ("struck out", "counted as missing: a comment sign in front"),
        ("long", f"counted as missing: more than {width} cells"),
        ("short", f"counted as missing: fewer than {width} cells"),
    ):
        if faults[fault]:  # type: ignore[index]
            warnings.append(_told(faults[fault], told))  # type: ignore[index]
    return Damage(
        _indices(faults["comment"] + faults["text"] + faults["cut"]),
        _indices(faults["struck out"] + faults["long"] + faults["short"]),
        tuple(notes),
        tuple(warnings),
    )


def _fault(row: Row, columns: list[Array], source: Source, *, is_cut: bool) -> Fault | None:
    width, dialect = len(source.headings), source.dialect
    if dialect.is_comment(row.text):
        bare = row.text.lstrip().lstrip("".join(dialect.comments))
        return "struck out" if is_sample(bare, dialect, [*source.kinds, *["empty"] * source.trailing]) else "comment"
    if all(np.isnan(column[row.row]) for column in columns) and not looks_like_numbers(row.text):
        # Cells that are empty or say "missing", without any other text, are a sample nevertheless.
        return "text" if any(kind_of(cell, dialect) == "text" for cell in row.cells) else None
    if len(row.cells) > width + source.trailing or any(row.cells[width:]):
        return "long"
    if len(row.cells) < width + source.trailing:
        if is_cut:
            # Only the delimiter at the very end may be lacking.
            return "cut" if len(row.cells) < width or row.cells[-1] == "" else None
        return "short"
    return None


def _ending(short: list[Row], size: int) -> list[Row]:
    """Rows that lack ever more last cells up to the end of the table, whose last column therefore just ends earlier."""
    ending: list[Row] = []
    for row in reversed(short):
        follows = (
            row.row == ending[-1].row - 1 and len(row.cells) >= len(ending[-1].cells) if ending else row.row >= size - 1
        )
        if not follows:
            break
        ending.append(row)
    return ending[::-1] if len(ending) >= SHORTEST_ENDING else []


def unfinished_number(samples: Samples, source: Source) -> tuple[bool, str]:
    """
    Judge the last number of a file whose last line has no line end.

    Returns
    -------
    cut : bool
        Whether it has fewer decimals than all of the numbers above it, which have equally many.
    message : str
        Empty where the file ends with a line end or within an earlier cell.
    """
    if not source.is_cut:
        return False, ""
    size, width = samples.columns[0].size, len(source.headings)
    *above, last = source.rows(np.arange(max(size - TAIL, 0), size))
    if len(last.cells) != width or source.kinds[-1] != "number":
        return False, ""
    found = decimals_of(last.cells[-1], source.dialect.decimal)
    usual = {decimals_of(row.cells[-1], source.dialect.decimal) for row in above if len(row.cells) == width}
    if len(above) == TAIL - 1 and len(usual) == 1 and found < min(usual):
        return True, (
            f'the file ends within a number: "{last.cells[-1]}" on line {last.line} has {found} decimals where all '
            f"others have {min(usual)}; it counts as missing"
        )
    return False, f"the last line, {last.line}, has no line end; its last number is taken as complete"


def report_missing(columns: list[Array], source: Source, damage: Damage) -> list[str]:
    """Tell for each column of numbers how many cells hold none, and where the first of them stands."""
    known = np.ones(columns[0].size, dtype=bool)
    known[damage.left_out] = False
    known[damage.blanked] = False
    groups: dict[tuple[int, int], list[int]] = {}
    for number, (column, kind) in enumerate(zip(columns, source.kinds, strict=True)):
        absent = np.isnan(column) & known
        count = int(absent.sum())
        if count and (kind != "text" or count < known.sum()):
            groups.setdefault((int(np.argmax(absent)), count), []).append(number)
    found = {row.row: row for row in source.rows(np.unique([first for first, _ in groups]).astype(np.int64))}
    messages = []
    for (first, count), numbers in sorted(groups.items()):
        row = found[first]
        cell = row.cells[numbers[0]] if numbers[0] < len(row.cells) else ""
        names = ", ".join(f'"{source.headings[number]}"' for number in numbers[:3])
        more = f" and {len(numbers) - 3} more columns" if len(numbers) > 3 else ""
        text = f'"{_shown(cell)}"' if cell else "nothing"
        cells = "1 cell holds no number" if count == 1 else f"{count} cells hold no number"
        where = "on" if count == 1 else "first on"
        messages.append(f"{names}{more}: {cells} ({where} line {row.line}: {text}){' each' if more else ''}; missing")
    return messages


def _told(rows: list[Row], what: str) -> str:
    lines = ", ".join(str(row.line) for row in rows[:5])
    more = f" and {len(rows) - 5} more" if len(rows) > 5 else ""
    return f'line{"s" if len(rows) > 1 else ""} {lines}{more}: {what} ("{_shown(rows[0].text)}")'


def _shown(text: str) -> str:
    plain = "".join(character if character.isprintable() else " " for character in text.strip())
    return plain if len(plain) <= SHOWN else plain[:SHOWN] + "…"


def _indices(rows: list[Row]) -> NDArray[np.int64]:
    return np.array(sorted(row.row for row in rows), dtype=np.int64)
