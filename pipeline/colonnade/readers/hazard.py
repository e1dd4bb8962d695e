"""The hazard of a site: annual rates at which levels of a measure of intensity are exceeded."""

from __future__ import annotations

from math import isfinite
from pathlib import Path

import numpy as np

from colonnade import units
from colonnade.assessment.hazard import Hazard, hazard_curve
from colonnade.assessment.measures import measure_of
from colonnade.errors import ReadError, UnitError, quoted
from colonnade.readers.small_table import SmallTable, read_table


def read_hazard(path: Path, measure: str) -> Hazard:
    """
    Read a hazard curve.

    Parameters
    ----------
    path : Path
        CSV with two columns: the measure with its unit, and the annual rate; `pgv [m/s], rate [1/year]`.
    measure : str
        Id of the measure that it has to be of, such as "sa(0.5 s)".

    Raises
    ------
    ReadError
        If it is of another measure or dimension, a value is not a positive number, intensities do not rise, or rates
        do.
    """
    table = read_table(path, "a hazard curve")
    known = measure_of(measure)
    heads = ", ".join(head.name if head.unit is None else f"{head.name} [{head.unit}]" for head in table.heads)
    wrong = f"{table.name}: its heads are {quoted(heads)}; "
    wrong += f'"{known.id} [{known.unit}], rate [1/year]" was expected.'
    if len(table.heads) != 2:
        raise ReadError(wrong)
    intensity, rate = table.heads
    if _same(intensity.name) != _same(known.id):
        raise ReadError(
            f"{table.name}: the hazard is given for {quoted(intensity.name)} and the fragility for "
            f"{quoted(known.id)}. A hazard curve of the same measure was expected."
        )
    try:
        found = units.resolve(intensity.unit or "1")
    except UnitError as error:
        raise ReadError(f"{table.name}: {error}") from None
    is_rate = _same(rate.name) in ("rate", "rate(1/year)") and rate.unit in (None, "1/year")
    if not is_rate or found.si_unit != units.resolve(known.unit).si_unit:
        raise ReadError(wrong)
    values = np.array([_number(table, line, cell) for line, cells in table.rows for cell in cells]).reshape(-1, 2)
    try:
        return hazard_curve(values[:, 0] * found.factor, values[:, 1])
    except ValueError as error:
        raise ReadError(f"{table.name}: {error}") from None


def _number(table: SmallTable, line: int, cell: str) -> float:
    try:
        value = float(cell.replace(",", ".") if table.has_decimal_comma else cell)
    except ValueError:
        value = 0.0
    if not (isfinite(value) and value > 0.0):
        raise ReadError(f"{table.name}, line {line}: {quoted(cell)} is not a positive number.")
    return value


def _same(text: str) -> str:
    return "".join(text.casefold().split())
