"""What each picture of a page shows, as a table that the page's script writes as CSV."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np

from colonnade.figures.files.output import Picture, to_csv
from colonnade.figures.files.table import Table, table_of
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
        table = table_of(picture.figure)
        if sum(map(len, table.values())) <= LONG:
            found[picture.identity] = to_csv(picture.figure)
        else:
            samples, columns = samples.with_more(partial(_columns, table))
            if columns is not None:
                found[picture.identity] = {"heads": list(table), "columns": columns}
    return samples, found


def of_page(address: str, pictures: Iterable[Picture]) -> str:
    """Return the script with the data of a page that has no histories: the tables of its pictures."""
    samples, tables = tables_of(pictures, Samples())
    return script(address, samples, tables=tables)


def _columns(table: Table, samples: Samples) -> list[Any]:
    return [_column(column, samples) for column in table.values()]


def _column(column: Sequence[float] | Sequence[str], samples: Samples) -> Any:
    if len(column) and isinstance(column[0], str):
        return list(column)
    values = np.asarray(column, dtype=np.float64)
    if values.size > 1 and (np.diff(values) > 0).all():
        return {"clock": samples.clock(values)}
    return {"series": samples.add(values)}
