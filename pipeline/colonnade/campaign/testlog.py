"""The laboratory's own test log, CSV or Excel: one row a test, the campaign file's keys as column heads."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from colonnade.campaign.channel import MAIN
from colonnade.campaign.syntax.document import Source
from colonnade.campaign.syntax.names import inside
from colonnade.campaign.test import Test
from colonnade.errors import ReadError
from colonnade.findings import Finding, note
from colonnade.readers.small_table import SmallTable, read_table


def with_log(source: Source, folder: Path) -> tuple[Source, list[str], list[Finding]]:
    """
    Put the rows of the test log that `tests` names in its place, as tables of the campaign file.

    Empty cells are keys not given. A column that is not a key is left out with a note, but refused where its name is
    nearly that of a key. `file.daq2` is the file of recorder daq2.

    Returns
    -------
    source : Source
        Without tests if there is no such table.
    problems : list of str
        Finished paragraphs.
    notes : list of Finding
    """
    try:
        path = inside(folder, source.document["tests"])
        table = read_table(path, "a test log")
        files = {index: head.name for index, head in enumerate(table.heads) if head.name.startswith("file.")}
        known = [*Test.purposes(), *map(str.casefold, files.values())]
        places, unused = table.places(known, "is not a key of a test")
    except (ReadError, ValueError) as error:
        wrong = [source.paragraph(("tests",), line) for line in str(error).splitlines()]
        return replace(source, document=source.document | {"tests": []}), wrong, []
    heads = {index: files.get(index, key) for key, index in places.items()}
    tests = [
        _test({head: (index, cells[index]) for index, head in heads.items() if cells[index]}, table)
        for _, cells in table.rows
    ]
    rows = tuple(row for row, _ in table.rows)
    read = replace(source, document=source.document | {"tests": tests}, log=path.name, rows=rows)
    return read, [], [note("unused column", said) for said in unused]


def _test(cells: dict[str, tuple[int, str]], table: SmallTable) -> dict[str, Any]:
    test = {head: _value(head, *cell, table) for head, cell in cells.items() if not head.startswith("file.")}
    files = {head.removeprefix("file."): cell for head, (_, cell) in cells.items() if head.startswith("file.")}
    if files:
        test["file"] = ({MAIN: test["file"]} if "file" in test else {}) | files
    return test


def _value(key: str, index: int, text: str, table: SmallTable) -> Any:
    kinds = Test.kinds()[key]
    if kinds - {"list"}:
        text = table.quantity(index, text)
    if "number" in kinds:
        with suppress(ValueError):
            return float(text)
    if not kinds & {"interval", "list"}:
        return text
    between = r"[;,]|\bto\b" if "interval" in kinds else "[;,]"
    parts = [part.strip(" \"'") for part in re.split(between, text.strip("[]")) if part.strip()]
    return parts if len(parts) > 1 or "list" in kinds else text
