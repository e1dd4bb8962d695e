"""Damaged rows of a text file: how they are read, and what is reported."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.readers.text.rows import Fault, Row, Rows, filled_length

SHOWN = 50
"""Characters of a line that a message quotes."""

SHORTEST_ENDING = 3
"""Rows at the end that lack last cells, from which on these columns count as shorter."""

LEFT_OUT: dict[Fault, str] = {
    "comment": "left out as a comment",
    "text": "left out: text without a number",
    "cut": "left out: the file ends here, before all {} cells",
}
BLANKED: dict[Fault, str] = {
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
    Take out of the columns, which are changed, blank lines and what is wrong with their rows.

    A line without any number, with text, is left out, as is a last line that was cut off. A row with too many or too
    few cells counts as missing, because a value may be in its neighbour's column; unless all rows to the end lack
    last cells: then these columns are shorter.
    """
    faulty = [row for row in rows.odd if row.fault is not None]
    notes: list[str] = []
    warnings: list[str] = []
    last = rows.line + rows.blank.size - 1
    if rows.is_cut and faulty and (faulty[-1].line, faulty[-1].fault) == (last, "short"):
        faulty[-1] = faulty[-1]._replace(fault="cut")
    left_out = rows.blank | _marked(rows, faulty, LEFT_OUT)
    short = {row.line: row for row in faulty if row.fault == "short"}
    kept = (rows.line + np.flatnonzero(~left_out))[::-1].tolist() if short else []
    ending = [*takewhile(short.__contains__, kept)]
    if len(ending) < SHORTEST_ENDING:
        ending = []
    faulty = [row for row in faulty if row.line not in ending]
    blanked = _marked(rows, faulty, BLANKED)
    if ending:
        notes.append(
            f"from line {ending[-1]} on there are {len(short[ending[-1]].cells)} cells: "
            "the last columns are shorter than the others"
        )
    for fault, said in (LEFT_OUT | BLANKED).items():
        if found := [row for row in faulty if row.fault == fault]:
            (notes if fault == "comment" else warnings).append(_listed(found, said.format(len(headings))))
    warnings += _missing(rows, left_out | blanked, headings)
    if rows.is_cut and rows.form.by_instrument and not (left_out | blanked)[-1]:  # its program ends every line
        warnings.append(f"the file ends within line {last}: its last number counts as missing")
        rows.columns[-1][-1] = np.nan
    elif rows.is_cut and not left_out[-1]:
        notes.append(f"the last line, {last}, has no line end; its last number is taken as complete")
    for column in rows.columns:
        column[blanked] = np.nan
    whole = [column[~left_out] if left_out.any() else column for column in rows.columns]
    return Mended(whole, notes, warnings)


def _marked(rows: Rows, faulty: list[Row], wanted: dict[Fault, str]) -> Mask:
    """Which lines have one of these faults."""
    marked = np.zeros(rows.blank.size, dtype=bool)
    marked[[row.line - rows.line for row in faulty if row.fault in wanted]] = True
    return marked


def _missing(rows: Rows, damaged: Mask, headings: Sequence[str]) -> list[str]:
    """Say for each column of numbers how many cells hold none, and where the first of them is."""
    known = {row.line: row for row in rows.odd}
    groups: dict[tuple[int, int], list[int]] = {}
    for number, column in enumerate(rows.columns):
        absent = np.isnan(column) & ~damaged
        if rows.form.ragged:
            absent[filled_length(column) :] = False
        count = int(absent.sum())
        if count and (rows.form.kinds[number] == "number" or count < column.size - damaged.sum()):
            groups.setdefault((rows.line + int(np.argmax(absent)), count), []).append(number)
    messages = []
    for (line, count), numbers in sorted(groups.items()):
        cell = "".join(known[line].cells[numbers[0] : numbers[0] + 1])
        names = ", ".join(f'"{headings[number]}"' for number in numbers[:3])
        more = f" and {len(numbers) - 3} more columns" if len(numbers) > 3 else ""
        text = f'"{_shown(cell)}"' if cell else "nothing"
        cells = "1 cell holds no number" if count == 1 else f"{count} cells hold no number"
        where = "on" if count == 1 else "first on"
        messages.append(f"{names}{more}: {cells} ({where} line {line}: {text}){' each' if more else ''}; missing")
    return messages


def _listed(rows: list[Row], what: str) -> str:
    lines = ", ".join(str(row.line) for row in rows[:5])
    more = f" and {len(rows) - 5} more" if len(rows) > 5 else ""
    return f'line{"s" if len(rows) > 1 else ""} {lines}{more}: {what} ("{_shown(rows[0].text)}")'


def _shown(text: str) -> str:
    plain = "".join(character if character.isprintable() else " " for character in text.strip())
    return plain if len(plain) <= SHOWN else plain[:SHOWN] + "…"
