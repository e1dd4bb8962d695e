"""What each picture of a page shows, as a table that the page's script writes as CSV."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.figures.files.output import Picture, as_csv
from colonnade.figures.files.table import Columns, columns_of
from colonnade.report.interactive.panels import Samples, script

LONG = 2000
"""Cells up to which a table is CSV text; the columns of a longer one are packed with the samples of the page."""


def tables_of(pictures: Iterable[Picture], samples: Samples) -> tuple[Samples, dict[str, Any]]:
    """
    Give the table of each picture by its id: CSV text, or headings with columns. One that is too long has none.

    A column is a list of words, or names a series or, if it rises throughout, a clock of the samples, which are
    returned with those of the tables.
    """
    found: dict[str, Any] = {}
    for picture in pictures:
        table = columns_of(picture.figure)
        if sum(map(len, table.values())) <= LONG:
            found[picture.identity] = as_csv(table)
        else:
            samples, columns = samples.with_more(partial(_columns, table))
            if columns is not None:
                found[picture.identity] = {"heads": list(table), "columns": columns}
    return samples, found


def of_page(address: str, pictures: Iterable[Picture]) -> str:
    """Return the script with the data of a page that has no histories: the tables of its pictures."""
    samples, tables = tables_of(pictures, Samples())
    return script(address, samples, tables=tables)


def _columns(table: Columns, samples: Samples) -> list[Any]:
    return [_column(column, samples) for column in table.values()]


def _column(column: Array | list[str], samples: Samples) -> Any:
    if isinstance(column, list):
        return column
    column = np.asarray(column, dtype=np.float64)
    if column.size > 1 and (column[1:] > column[:-1]).all():
        return {"clock": samples.clock(column)}
    return {"series": samples.add(column)}
