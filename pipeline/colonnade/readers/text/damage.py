"""Damaged rows of a text file: how they are read, and what is reported."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.readers.text.cells import decimals_of
from colonnade.readers.text.rows import TAIL, Fault, Row, RowForm, Rows, filled_length

SHOWN = 50
"""Characters of a line that a message quotes."""

SHORTEST_ENDING = 3
"""Rows at the end that lack the same last cells, from which on these columns count as shorter."""


@dataclass(frozen=True)
class Mended:
    """
    Columns of numbers that can be trusted to be their columns'.

    Attributes
    ----------
    columns : list of ndarray, shape (n,)
        Without the rows that are not samples; NaN where a value may belong to another column.
    notes, warnings : tuple of str
    """

    columns: list[Array]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def mend(rows: Rows, headings: Sequence[str], *, is_cut: bool = False) -> Mended:
    """
    Take out of the columns what is wrong with their rows.

    A line without any number, with text, is left out, as is a last line that was cut off. A row with too many or too
    few cells counts as missing, because a value may be in its neighbour's column; unless all rows to the end lack
    last cells: then these columns are shorter.

    Parameters
    ----------
    rows : Rows
        Their columns are changed.
    headings : sequence of str
        Of the columns.
    is_cut : bool
        Whether the rows end with the file, and that within a line.
    """
    tail, form = rows.tail() if is_cut else [], rows.form
    faults = {fault: list(found) for fault, found in rows.faults.items()}
    if tail:
        _take_cut_line(faults, rows)
    gone = sum(len(faults.get(fault, ())) for fault in ("comment", "text", "cut"))
    ending = _ending(faults.get("short", []), rows.size - gone)
    faults["short"] = faults.get("short", [])[: -len(ending) or None]
    left_out = _marked(faults, rows.size, "comment", "text", "cut")
    blanked = _marked(faults, rows.size, "struck out", "long", "short")
    notes, warnings = _reported(faults, ending, len(headings))
    number_cut, message = _unfinished_number(tail, form) if tail else (False, "")
    absent = _report_missing(rows, [*ending, *tail[-1:]], left_out | blanked, headings)
    if number_cut:
        rows.columns[-1][-1] = np.nan
    columns = []
    for column in rows.columns:
        column[blanked] = np.nan
        columns.append(column[~left_out] if left_out.any() else column)
    said = (message,) if message else ()
    return Mended(
        columns,
        (*notes, *(() if number_cut else said)),
        (*warnings, *(said if number_cut else ()), *absent),
    )


def _take_cut_line(faults: dict[Fault, list[Row]], rows: Rows) -> None:
    """Judge the last line, which has no line end: only the delimiter at the very end of it may be lacking."""
    short = faults.get("short", [])
    if short and short[-1].row == rows.size - 1:
        last = short.pop()
        if len(last.cells) < len(rows.form.kinds) or last.cells[-1] == "":
            faults["cut"] = [last]


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


def _reported(faults: dict[Fault, list[Row]], ending: list[Row], width: int) -> tuple[list[str], list[str]]:
    """Notes and warnings of faults."""
    notes = []
    if ending:
        notes.append(
            f"from line {ending[0].line} on there are {len(ending[0].cells)} cells: "
            "the last columns are shorter than the others"
        )
    if found := faults.get("comment"):
        notes.append(_listed(found, "left out as a comment"))
    what: dict[Fault, str] = {
        "text": "left out: text without a number",
        "cut": f"left out: the file ends here, before all {width} cells",
        "struck out": "counted as missing: a comment sign in front",
        "long": f"counted as missing: more than {width} cells",
        "short": f"counted as missing: fewer than {width} cells",
    }
    return notes, [_listed(faults[fault], said) for fault, said in what.items() if faults.get(fault)]


def _unfinished_number(tail: list[Row], form: RowForm) -> tuple[bool, str]:
    """
    Judge the last number of a file whose last line has no line end.

    Returns
    -------
    cut : bool
        Whether it has fewer decimals than all of the numbers above it, which have equally many.
    message : str
        Empty if the file ends within an earlier cell.
    """
    width, decimal = len(form.kinds), form.dialect.decimal
    *above, last = tail
    # A spreadsheet leaves out zeros at the end; an instrument does not.
    above = above[-1:] if form.by_instrument else above
    enough = form.by_instrument or len(above) == TAIL - 1
    others = "the one above has" if form.by_instrument else "all others have"
    if len(last.cells) != width or form.kinds[-1] != "number":
        return False, ""
    found = decimals_of(last.cells[width - 1], decimal)
    usual = {decimals_of(row.cells[width - 1], decimal) for row in above if width <= len(row.cells)}
    if enough and len(usual) == 1 and found < min(usual):
        return True, (
            f'the file ends within a number: "{last.cells[width - 1]}" on line {last.line} has {found} decimals where '
            f"{others} {min(usual)}; it counts as missing"
        )
    return False, f"the last line, {last.line}, has no line end; its last number is taken as complete"


def _report_missing(rows: Rows, others: list[Row], damaged: Mask, headings: Sequence[str]) -> list[str]:
    """Say for each column of numbers how many cells hold none, and where the first of them is."""
    groups: dict[tuple[int, int], list[int]] = {}
    for number, (column, kind) in enumerate(zip(rows.columns, rows.form.kinds, strict=True)):
        absent = np.isnan(column) & ~damaged
        if rows.form.ragged:
            absent[filled_length(column) :] = False
        count = int(absent.sum())
        if count and (kind != "text" or count < rows.size - damaged.sum()):
            groups.setdefault((int(np.argmax(absent)), count), []).append(number)
    known = rows.without_number | {row.row: row for row in others}
    messages = []
    for (first, count), numbers in sorted(groups.items()):
        row = known[first]
        cell = row.cells[numbers[0]] if numbers[0] < len(row.cells) else ""
        names = ", ".join(f'"{headings[number]}"' for number in numbers[:3])
        more = f" and {len(numbers) - 3} more columns" if len(numbers) > 3 else ""
        text = f'"{_shown(cell)}"' if cell else "nothing"
        cells = "1 cell holds no number" if count == 1 else f"{count} cells hold no number"
        where = "on" if count == 1 else "first on"
        messages.append(f"{names}{more}: {cells} ({where} line {row.line}: {text}){' each' if more else ''}; missing")
    return messages


def _marked(faults: dict[Fault, list[Row]], size: int, *wanted: Fault) -> Mask:
    """Which rows have one of these faults."""
    marked = np.zeros(size, dtype=bool)
    marked[[row.row for fault in wanted for row in faults.get(fault, ())]] = True
    return marked


def _listed(rows: list[Row], what: str) -> str:
    lines = ", ".join(str(row.line) for row in rows[:5])
    more = f" and {len(rows) - 5} more" if len(rows) > 5 else ""
    return f'line{"s" if len(rows) > 1 else ""} {lines}{more}: {what} ("{_shown(rows[0].text)}")'


def _shown(text: str) -> str:
    plain = "".join(character if character.isprintable() else " " for character in text.strip())
    return plain if len(plain) <= SHOWN else plain[:SHOWN] + "…"
