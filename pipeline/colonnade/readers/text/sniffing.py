"""How a text is written: delimiter, decimal sign, quotation marks, what each column holds, and the first sample."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain

from colonnade.readers.text.cells import SAMPLE_LINES, WHITESPACE, Dialect, is_sample, kind_of, looks_like_numbers

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
        Cells on most rows of numbers; 0 without a row of numbers.
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
        Not sniffed if they are given.
    """
    filled = [line for line in lines if line.strip() and not given.is_comment(line)]
    first, sample = filled[:SAMPLE_LINES], filled[-SAMPLE_LINES:]
    fits = [_fit(sample, dialect) for dialect in _candidates(sample, given, delimiter, decimal, thousands)]
    top = max((fit.score, fit.columns > 1) for fit in fits)
    # At rest, before numbers reach a thousand, their decimal sign is plainer.
    best = max(
        (fit for fit in fits if (fit.score, fit.columns > 1) == top), key=lambda fit: _fit(first, fit.dialect).score
    )
    if best.rows == 0:
        return Sniffed(best.dialect, 0)
    dialect = best.dialect
    numbers = [*filter(dialect.is_number, chain.from_iterable(map(dialect.split, sample)))]
    notes = [] if delimiter else [_delimiter_note(best, len(sample))]
    notes += [] if decimal else [_decimal_note(dialect, numbers)]
    warnings = () if delimiter or decimal else _two_readings(best, fits, sample, numbers)
    grouped = next((number for number in numbers if dialect.other_sign in number), None)
    if thousands is None and grouped is not None:
        dialect = replace(dialect, thousands=dialect.other_sign)
        notes.append(f'"{dialect.thousands}" between thousands (as in "{grouped}")')
    return Sniffed(dialect, best.columns, tuple(notes), warnings)


def _candidates(
    sample: list[str], given: Dialect, delimiter: str | None, decimal: str | None, thousands: str | None
) -> Iterator[Dialect]:
    """Dialects that the sample may be written in."""
    quoted = sum('"' in line for line in sample) > len(sample) / 2
    for candidate in DELIMITERS if delimiter is None else (delimiter,):
        if quoted and candidate == WHITESPACE and delimiter is None:
            continue
        padded = any(candidate + " " in line for line in sample)
        for sign in (".", ",") if decimal is None else (decimal,):
            if sign != candidate or quoted:
                yield replace(
                    given, delimiter=candidate, decimal=sign, thousands=thousands, quoted=quoted, padded=padded
                )


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
            is_half = len(digits) > 1 and digits[0] == "0" and digits.isdigit()
            # Nor is "1.012" surely a number where commas are the decimal signs.
            is_half |= kind == "number" and not dialect.is_number(cell)
            weight += 0.5 if is_half else 1.0
    return weight, filled


def _delimiter_note(best: _Fit, lines: int) -> str:
    if best.columns == 1:
        return "one column: no delimiter gives more numbers in the lines examined"
    delimiter = quote(best.dialect.delimiter)
    return f"delimiter {delimiter} ({best.columns} cells on {best.rows} of the {lines} lines examined)"


def _decimal_note(dialect: Dialect, numbers: list[str]) -> str:
    signed = next((number for number in numbers if dialect.decimal in number), None)
    why = " assumed: the numbers examined have none" if signed is None else f' (as in "{signed}")'
    return f'decimal sign "{dialect.decimal}"{why}'


def _two_readings(best: _Fit, fits: list[_Fit], sample: list[str], numbers: list[str]) -> tuple[str, ...]:
    """Warn of two columns of whole numbers that may be one column with decimal commas."""
    is_open = best.dialect.delimiter == "," and best.columns == 2
    if not is_open or any(best.dialect.decimal in number for number in numbers):
        return ()
    if not any(fit.columns == 1 and fit.score == best.score for fit in fits):
        return ()
    return (
        f'rows such as "{sample[-1].strip()}" are read as two columns of whole numbers; they could also be '
        'one column with decimal commas: then set decimal = ","',
    )


def quote(delimiter: str) -> str:
    """Show a delimiter in a message: `";"`, `tab`."""
    return DELIMITER_NAMES.get(delimiter, f'"{delimiter}"')


LOOK_AHEAD = 10
"""Lines after a candidate that have to look like samples too, at least in this share:"""
ALIKE = 0.7


def column_kinds(lines: list[str], dialect: Dialect, columns: int) -> list[str]:
    """
    Find what each column holds: `number`, `time` (date or time of day), `text` or `empty`.

    Parameters
    ----------
    lines : list of str
        Head of the file; its later part is looked at.
    dialect : Dialect
    columns : int
        Cells on most lines of numbers; a nameless empty last column, made by a delimiter at the end of each line, is
        among them.
    """
    counts: list[Counter[str]] = [Counter() for _ in range(columns)]
    for line in [line for line in lines if line.strip()][-SAMPLE_LINES:]:
        cells = dialect.split(line)
        if len(cells) != columns:
            continue
        kinds = [kind_of(cell, dialect) for cell in cells]
        if "number" in kinds:
            for count, kind in zip(counts, kinds, strict=True):
                count[kind] += 1
    return [_majority(count) for count in counts]


def _majority(count: Counter[str]) -> str:
    return (
        max(("number", "time", "text"), key=lambda kind: count[kind]) if count.total() > count["missing"] else "empty"
    )


def find_first_sample(lines: list[str], start: int, dialect: Dialect, kinds: list[str]) -> int | None:
    """
    Find the first line with a value for each column, after which most lines have one.

    Parameters
    ----------
    lines : list of str
        Head of the file.
    start : int
        Index of the first line that may be a sample.
    dialect : Dialect
    kinds : list of str
        From `column_kinds`.

    Returns
    -------
    index : int or None
        From 0; None if no line looks like a sample.
    """
    filled = [index for index in range(start, len(lines)) if not dialect.is_blank(lines[index])]
    for place, index in enumerate(filled):
        if is_sample(lines[index], dialect, kinds):
            following = [
                other for other in filled[place : place + LOOK_AHEAD + 1] if not dialect.is_comment(lines[other])
            ]
            alike = sum(_resembles_sample(lines[other], dialect, kinds) for other in following)
            if alike >= ALIKE * len(following):
                return index
    return None


def _resembles_sample(line: str, dialect: Dialect, kinds: list[str]) -> bool:
    """Whether a line could be a sample that is not quite as it should be."""
    if looks_like_numbers(line):
        return True
    cells = dialect.split(line)
    found = [kind_of(cell, dialect) for cell in cells]
    return len(cells) == len(kinds) and 2 * found.count("text") <= len(found) - found.count("missing")
