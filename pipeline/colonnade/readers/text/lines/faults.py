"""The expected form of the rows of a text, and what is wrong with other rows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from colonnade.readers.text.lines.cells import Dialect, is_sample, kind_of, looks_like_numbers

Fault = Literal["comment", "text", "cut", "struck out", "long", "short"]


@dataclass(frozen=True)
class RowForm:
    """
    How rows are written, and what they hold.

    Attributes
    ----------
    dialect : Dialect
    kinds : tuple of str
        What each column holds, by `cells.kind_of`.
    trailing : int
        Nameless empty cells after these columns on every line, made by delimiters at its end.
    remark : bool
        Whether a row may have a further cell, which is not looked at.
    by_instrument : bool
        Whether an instrument's own program wrote them: each row is a sample in its place, whatever it holds, and may
        end in empty cells.
    ragged : bool
        Whether columns may end before the last row, as those of channels with fewer samples.
    exact : bool
        Whether numbers are read to their last digit, which takes three times as long.
    grouped : dict of int to str
        Columns of whole numbers with a sign between their thousands.
    """

    dialect: Dialect
    kinds: tuple[str, ...]
    trailing: int = 0
    remark: bool = False
    by_instrument: bool = False
    ragged: bool = False
    exact: bool = False
    grouped: Mapping[int, str] = field(default_factory=dict)

    def dialect_of(self, column: int) -> Dialect:
        """How the numbers of a column are written."""
        sign = self.grouped.get(column)
        return self.dialect if sign is None else replace(self.dialect, decimal=".,".replace(sign, ""), thousands=sign)

    @property
    def cells(self) -> int:
        """Cells that a row has at least, the empty ones at its end among them."""
        return len(self.kinds) + self.trailing

    @property
    def most_cells(self) -> int:
        """Cells that a row has at most."""
        return self.cells + self.remark


@dataclass(frozen=True)
class Row:
    """A row, by its number among the columns' values from 0, with its line in the file from 1."""

    row: int
    line: int
    text: str
    cells: list[str]


def fault_of(row: Row, form: RowForm, *, has_number: bool) -> Fault | None:
    """Name what is wrong with a row; None if it is a sample, though perhaps without some of its numbers."""
    dialect = form.dialect
    if not form.by_instrument:
        if dialect.is_comment(row.text):
            bare = row.text.lstrip().lstrip("".join(dialect.comments))
            return "struck out" if is_sample(bare, dialect, [*form.kinds, *["empty"] * form.trailing]) else "comment"
        if not has_number and not looks_like_numbers(row.text):
            # Cells that are empty or say "missing", without any other text, are a sample nevertheless.
            return "text" if any(kind_of(cell, dialect) == "text" for cell in row.cells) else None
    beyond = row.cells[len(form.kinds) + form.remark :]
    if any(beyond) or (len(row.cells) > form.most_cells and not form.by_instrument):
        return "long"
    return "short" if len(row.cells) < form.cells else None
