"""Which line of a text file holds the first sample, and what each column holds."""

from __future__ import annotations

from collections import Counter

from colonnade.readers.text.lines.cells import SAMPLE_LINES, Dialect, is_sample, kind_of, looks_like_numbers

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
