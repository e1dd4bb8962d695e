"""Damaged rows of a text file: how they are read, and what is reported."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.readers.text.rows import TAIL, Fault, Row, Rows, filled_length

SHOWN = 50
"""Characters of a line that a message quotes."""

SHORTEST_ENDING = 3
"""Rows at the end that lack the same last cells, from which on these columns count as shorter."""

LEFT_OUT: dict[Fault, str] = {
    "comment": "left out as a comment",
    "text": "left out: text without a number",
    "cut": "left out: the file ends here, before all {} cells",
}
BLANKED: dict[Fault, str] = {
    "struck out": "counted as missing: a comment sign in front",
    "long": "counted as missing: more than {} cells",
    "short": "counted as missing: fewer than {} cells",
}


class Mended(NamedTuple):
    """Columns of numbers that can be trusted to be their columns'; NaN where a value may belong to another column."""

    columns: list[Array]
    notes: list[str]
    warnings: list[str]


def mend(rows: Rows, headings: Sequence[str]) -> Mended:
    """
    Take out of the columns, which are changed, what is wrong with their rows.

    A line without any number, with text, is left out, as is a last line that was cut off. A row with too many or too
    few cells counts as missing, because a value may be in its neighbour's column; unless all rows to the end lack
    last cells: then these columns are shorter.
    """
    width = len(headings)
    faulty = [row for row in rows.odd if row.fault is not None]
    # Of a last line without its end only the delimiter at the very end may be lacking.
    if rows.tail and faulty and (last := faulty[-1]).fault == "short" and last.row == rows.size - 1:
        is_cut = len(last.cells) < width or last.cells[-1] == ""
        faulty[-1:] = [last._replace(fault="cut")] if is_cut else []
    left_out = _marked(rows, faulty, LEFT_OUT)
    short = [row for row in faulty if row.fault == "short"]
    ending = _ending(short, rows.size - int(left_out.sum()))
    faulty = [row for row in faulty if row not in ending]
    blanked = _marked(rows, faulty, BLANKED)
    notes: list[str] = []
    warnings: list[str] = []
    if ending:
        notes.append(
            f"from line {ending[0].line} on there are {len(ending[0].cells)} cells: "
            "the last columns are shorter than the others"
        )
    for fault, said in (LEFT_OUT | BLANKED).items():
        if found := [row for row in faulty if row.fault == fault]:
            (notes if fault == "comment" else warnings).append(_listed(found, said.format(width)))
    unfinished, told = _unfinished_number(rows, width)
    absent = _missing(rows, [*rows.odd, *ending, *rows.tail[-1:]], left_out | blanked, headings)
    if unfinished:
        rows.columns[-1][-1] = np.nan
    (warnings if unfinished else notes).extend(told)
    for column in rows.columns:
        column[blanked] = np.nan
    whole = [column[~left_out] if left_out.any() else column for column in rows.columns]
    return Mended(whole, notes, warnings + absent)


def _marked(rows: Rows, faulty: list[Row], wanted: dict[Fault, str]) -> Mask:
    """Which rows have one of these faults."""
    marked = np.zeros(rows.size, dtype=bool)
    marked[[row.row for row in faulty if row.fault in wanted]] = True
    return marked


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


def _unfinished_number(rows: Rows, width: int) -> tuple[bool, list[str]]:
    """Say whether a last line without its end has fewer decimals than all numbers above it, and what is to be said."""
    if not rows.tail or len(rows.tail[-1].cells) != width or rows.form.kinds[width - 1] != "number":
        return False, []
    cells = [row.cells[width - 1] for row in rows.tail if len(row.cells) >= width]
    *above, found = (len(cell.partition(rows.form.dialect.decimal)[2]) for cell in cells)
    line = rows.tail[-1].line
    # A spreadsheet leaves out zeros at the end; an instrument does not.
    if (rows.form.by_instrument or len(rows.tail) == TAIL) and len({*above}) == 1 and found < above[0]:
        said = f'the file ends within a number: "{cells[-1]}" on line {line} has {found} decimals where all others have'
        return True, [f"{said} {above[0]}; it counts as missing"]
    return False, [f"the last line, {line}, has no line end; its last number is taken as complete"]


def _missing(rows: Rows, looked_at: list[Row], damaged: Mask, headings: Sequence[str]) -> list[str]:
    """Say for each column of numbers how many cells hold none, and where the first of them is."""
    known = {row.row: row for row in looked_at}
    groups: dict[tuple[int, int], list[int]] = {}
    for number, column in enumerate(rows.columns):
        absent = np.isnan(column) & ~damaged
        if rows.form.ragged:
            absent[filled_length(column) :] = False
        count = int(absent.sum())
        if count and (rows.form.kinds[number] != "text" or count < rows.size - damaged.sum()):
            groups.setdefault((int(np.argmax(absent)), count), []).append(number)
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


def _listed(rows: list[Row], what: str) -> str:
    lines = ", ".join(str(row.line) for row in rows[:5])
    more = f" and {len(rows) - 5} more" if len(rows) > 5 else ""
    return f'line{"s" if len(rows) > 1 else ""} {lines}{more}: {what} ("{_shown(rows[0].text)}")'


def _shown(text: str) -> str:
    plain = "".join(character if character.isprintable() else " " for character in text.strip())
    return plain if len(plain) <= SHOWN else plain[:SHOWN] + "…"
