"""The laboratory's own test log, CSV or Excel: one row a test, the campaign file's keys as column heads."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from colonnade.campaign.channel import MAIN
from colonnade.campaign.test import Test
from colonnade.findings import Finding, note
from colonnade.readers.small_table import SmallTable, read_table


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
    ReadError
        If the file is missing or cannot be read as a table; with a line for each problem of its heads.
    """
    table = read_table(path, "a test log")
    keys = Test.purposes()
    files = {index: head.name for index, head in enumerate(table.heads) if head.name.startswith("file.")}
    places, unused = table.places([*keys, *map(str.casefold, files.values())], "is not a key of a test")
    heads = {index: files.get(index, key) for key, index in places.items()}
    tests = [
        _test({head: (index, cells[index]) for index, head in heads.items() if cells[index]}, table)
        for _, cells in table.rows
    ]
    problems = [f"{path.name}, row {row}: {fault}" for row, fault in table.faults]
    warnings = [note("unused column", said) for said in unused]
    return Log(path.name, tuple(tests), tuple(row for row, _ in table.rows), tuple(problems), tuple(warnings))


def _test(cells: dict[str, tuple[int, str]], table: SmallTable) -> dict[str, Any]:
    test = {head: _value(head, *cell, table) for head, cell in cells.items() if not head.startswith("file.")}
    files = {head.removeprefix("file."): cell for head, (_, cell) in cells.items() if head.startswith("file.")}
    if files:
        test["file"] = ({MAIN: test["file"]} if "file" in test else {}) | files
    return test


def _value(key: str, index: int, text: str, table: SmallTable) -> Any:
    form = Test.forms()[key]
    if form.is_number or form.dimension or form.is_interval:
        text = table.quantity(index, text)
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
