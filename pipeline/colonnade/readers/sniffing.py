"""Finding out how the numbers of a text file are written: delimiter, decimal sign, quotation marks."""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, replace

from colonnade.readers.cells import SAMPLE_LINES, WHITESPACE, Dialect, kind_of

DELIMITERS = (";", "\t", "|", ",", WHITESPACE)
DELIMITER_NAMES = {"\t": "tab", WHITESPACE: "spaces"}


@dataclass(frozen=True)
class Sniffed:
    """
    A dialect with its evidence.

    Attributes
    ----------
    dialect : Dialect
    columns : int
        Cells on most rows of numbers; 0 where there is no row of numbers.
    notes, warnings : tuple of str
    """

    dialect: Dialect
    columns: int
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Fit:
    """How well a dialect explains the sample: the share of lines that are rows of numbers, of numbers in these."""

    dialect: Dialect
    columns: int
    rows: int
    score: float


def sniff(
    lines: list[str], given: Dialect, *, delimiter: str | None, decimal: str | None, thousands: str | None
) -> Sniffed:
    """
    Find the dialect that makes most cells numbers and gives most lines the same number of cells.

    Parameters
    ----------
    lines : list of str
        The head of the file; its later part is looked at, as there the samples are surest.
    given : Dialect
        What is known otherwise: encoding, comment signs, missing values.
    delimiter, decimal, thousands : str or None
        Where they were given, they are not sniffed.
    """
    sample = [line for line in lines if line.strip() and not given.is_comment(line)][-SAMPLE_LINES:]
    quoted = sum('"' in line for line in sample) > len(sample) / 2
    fits = []
    for candidate in DELIMITERS if delimiter is None else (delimiter,):
        if quoted and candidate == WHITESPACE and delimiter is None:
            continue
        for sign in (".", ",") if decimal is None else (decimal,):
            if sign == candidate and not quoted:
                continue
            padded = any(candidate + " " in line for line in sample)
            dialect = replace(
                given, delimiter=candidate, decimal=sign, thousands=thousands, quoted=quoted, padded=padded
            )
            fits.append(_fit(sample, dialect))
    best = max(fits, key=lambda fit: (fit.score, fit.columns > 1))
    if best.rows == 0:
        return Sniffed(best.dialect, 0)
    return _with_evidence(best, fits, sample, delimiter, decimal, thousands)


def _fit(sample: list[str], dialect: Dialect) -> _Fit:
    counts: Counter[int] = Counter()
    numbers: defaultdict[int, float] = defaultdict(float)
    for line in sample:
        cells = dialect.split(line)
        weight, filled = _weigh(cells, dialect)
        if weight > 0 and weight >= filled / 2:
            counts[len(cells)] += 1
            numbers[len(cells)] += weight / filled
    if not counts:
        return _Fit(dialect, 0, 0, 0.0)
    columns, rows = max(counts.items(), key=lambda item: (item[1], item[0]))
    return _Fit(dialect, columns, rows, round(rows / len(sample) * numbers[columns] / rows, 3))


def _weigh(cells: list[str], dialect: Dialect) -> tuple[float, int]:
    """Weight of the numbers among cells, and the number of cells that hold something."""
    weight, filled = 0.0, 0
    for cell in cells:
        kind = kind_of(cell, dialect)
        filled += kind != "missing"
        if kind in ("number", "time"):
            # "05" is hardly a whole number; rather the decimals of "1,05" cut at the comma.
            digits = cell.lstrip("+-")
            weight += 0.5 if len(digits) > 1 and digits[0] == "0" and digits.isdigit() else 1.0
    return weight, filled


def _with_evidence(
    best: _Fit, fits: list[_Fit], sample: list[str], delimiter: str | None, decimal: str | None, thousands: str | None
) -> Sniffed:
    notes, warnings = [], []
    dialect = best.dialect
    cells = [cell for line in sample for cell in dialect.split(line) if dialect.is_number(cell)]
    rows = f"{best.columns} cells on {best.rows} of the {len(sample)} lines looked at"
    if delimiter is None and best.columns == 1:
        notes.append("one column: no delimiter makes more numbers of the lines looked at")
    elif delimiter is None:
        notes.append(f"delimiter {quote(dialect.delimiter)} ({rows})")
    signed = [cell for cell in cells if dialect.decimal in cell]
    if decimal is None and signed:
        notes.append(f'decimal sign "{dialect.decimal}" (as in "{signed[0]}")')
    elif decimal is None:
        notes.append(f'decimal sign "{dialect.decimal}" assumed: the numbers looked at have none')
    other = "," if dialect.decimal == "." else "."
    grouped = [cell for cell in cells if other in cell]
    if thousands is None and grouped:
        dialect = replace(dialect, thousands=other)
        notes.append(f'"{other}" between thousands (as in "{grouped[0]}")')
    if delimiter is None and decimal is None and dialect.delimiter == "," and best.columns == 2 and not signed:
        rival = any(fit.columns == 1 and fit.score == best.score for fit in fits)
        if rival:
            warnings.append(
                f'rows such as "{sample[-1].strip()}" are read as two columns of whole numbers; they could also be '
                'one column with decimal commas: then set decimal = ","'
            )
    return Sniffed(dialect, best.columns, tuple(notes), tuple(warnings))


def quote(delimiter: str) -> str:
    """Show a delimiter in a message: `";"`, `tab`."""
    return DELIMITER_NAMES.get(delimiter, f'"{delimiter}"')
