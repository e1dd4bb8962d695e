"""The laboratory's own test log, CSV or Excel: one row a test, the campaign file's keys as column heads."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from colonnade.campaign.channel import MAIN
from colonnade.campaign.test import Test
from colonnade.errors import ReadError, nearest, quoted
from colonnade.findings import Finding, note
from colonnade.readers.files import irregular

EXCEL_SUFFIXES = (".xlsx", ".xlsm", ".xls", ".ods")
_LARGEST_BYTES = 10_000_000
_MOST_COLUMNS = 1000


@dataclass(frozen=True)
class Log:
    """
    A test log as tables of the campaign file.

    Attributes
    ----------
    name : str
        The file's name.
    tests : tuple of dict
        As they would stand in campaign.toml.
    rows : tuple of int
        Row of each in the file, from 1.
    problems : tuple of str
    warnings : tuple of Finding
        Finished paragraphs.
    """

    name: str = ""
    tests: tuple[dict[str, Any], ...] = ()
    rows: tuple[int, ...] = ()
    problems: tuple[str, ...] = ()
    warnings: tuple[Finding, ...] = ()


def read_log(path: Path) -> Log:
    """
    Read a test log.

    Parameters
    ----------
    path : Path
        CSV (comma, semicolon or tab) or Excel; of a workbook the first sheet.

    Returns
    -------
    log : Log
        Empty cells are keys not given. A column that is not a key is left out with a warning, but refused where its
        name is nearly that of a key. `file.daq2` is the file of recorder daq2.

    Raises
    ------
    ValueError
        If the file is missing or cannot be read as a table; the message is a finished sentence.
    """
    cells, decimal_comma = _cells(path)
    heads_row = next((index for index, row in enumerate(cells) if any(map(_filled, row))), None)
    if heads_row is None:
        raise ValueError(f"{path.name} is empty. A row of column heads was expected: {', '.join(Test.purposes())}.")
    heads = [head.strip() for head in cells[heads_row]]
    problems, warnings = _judge(heads, path.name, heads_row + 1)
    tests, rows = [], []
    for index, row in enumerate(cells[heads_row + 1 :], start=heads_row + 2):
        if not any(map(_filled, row)):
            continue
        surplus = [cell for cell in row[len(heads) :] if _filled(cell)]
        if surplus:
            first = quoted(surplus[0])
            problems.append(
                f"{path.name}, row {index}: more cells than the {len(heads)} column heads ({first}). "
                "Put a cell that holds the separator in quotes."
            )
        tests.append(_test(dict(zip(heads, row, strict=False)), decimal_comma))
        rows.append(index)
    return Log(path.name, tuple(tests), tuple(rows), tuple(problems), tuple(warnings))


def _cells(path: Path) -> tuple[list[list[str]], bool]:
    """Rows of cells, and whether a comma between digits is a decimal sign."""
    if kind := irregular(path):
        raise ValueError(f"{path.name} is {kind}. A test log was expected: a CSV file or a workbook.")
    if path.suffix.lower() == ".xlsb":
        raise ValueError(f"{path.name} is a workbook in Excel's binary form. Save it as .xlsx, or as CSV.")
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise ValueError(f"{path.name} is too large for a test log. Is it a raw file?")
        if path.suffix.lower() in EXCEL_SUFFIXES:
            return _workbook(path), True
        raw = path.read_bytes()
    except FileNotFoundError:
        there = [entry.name for entry in path.parent.iterdir()] if path.parent.is_dir() else []
        raise ValueError(f'Test log "{path.name}" not found in {path.parent}.{nearest(path.name, there)}') from None
    except OSError as error:
        raise ValueError(f"The test log {path.name} cannot be read ({error.strerror or error}).") from None
    text = _decoded(raw)
    first = next((line for line in text.splitlines() if line.strip()), "")
    delimiter = max(";\t,", key=first.count)
    try:
        return list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)), delimiter != ","
    except csv.Error as error:
        raise ValueError(f"{path.name} is not a table of text ({error}).") from None


def _decoded(raw: bytes) -> str:
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        return raw.decode("utf-16", errors="replace")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("cp1252", errors="replace")


def _workbook(path: Path) -> list[list[str]]:
    from colonnade.readers.binary.excel import cells_of_first_sheet

    try:
        rows = cells_of_first_sheet(path)
    except ReadError as error:
        raise ValueError(str(error)) from None
    widest = max(map(len, rows), default=0)
    if widest > _MOST_COLUMNS:
        raise ValueError(f"{path.name} has {widest} columns, too many for a test log. Delete its stray cells.")
    return rows


def _judge(heads: Sequence[str], name: str, row: int) -> tuple[list[str], list[Finding]]:
    problems: list[str] = []
    warnings: list[Finding] = []
    keys = Test.purposes()
    for head in dict.fromkeys(head for head in heads if head and heads.count(head) > 1):
        problems.append(f"{name}, row {row}: duplicate column head {quoted(head)}. Each key may have only one column.")
    for head in dict.fromkeys(head for head in heads if head):
        if head in keys or head.startswith("file."):
            continue
        if get_close_matches(head.casefold(), keys, n=1, cutoff=0.75):
            problems.append(f"{name}, row {row}: unknown key {quoted(head)}.{nearest(head, keys)}")
        else:
            warnings.append(
                note("unused column", f"{name}: column {quoted(head)} is not a key of a test; it is ignored.")
            )
    return problems, warnings


def _test(cells: dict[str, str], decimal_comma: bool) -> dict[str, Any]:
    keys = Test.purposes()
    filled = {head: cell for head, cell in cells.items() if _filled(cell)}
    test = {head: _value(head, cell, decimal_comma) for head, cell in filled.items() if head in keys}
    files = {head.removeprefix("file."): cell for head, cell in filled.items() if head.startswith("file.")}
    if files:
        test["file"] = ({MAIN: test["file"]} if "file" in test else {}) | files
    return test


def _value(key: str, cell: str, decimal_comma: bool) -> Any:
    text, form = cell.strip(), Test.forms()[key]
    if decimal_comma and (form.is_number or form.dimension or form.is_interval):
        text = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", text)
    if form.is_number:
        try:
            return float(text)
        except ValueError:
            return text
    if form.is_interval:
        parts = [part.strip() for part in re.split(r"[;,…]|\.\.\.|\bto\b", text.strip("[]")) if part.strip()]
        return [part.strip("\"'") for part in parts] if len(parts) > 1 else text
    if form.is_list:
        return [part.strip() for part in re.split("[;,]", text) if part.strip()]
    return text


def _filled(cell: str) -> bool:
    return cell.strip() != ""
