"""What the programs of reports share: options, and how numbers, tables, figures and parts of pages are written."""

from __future__ import annotations

import argparse
import json
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from colonnade.figures.files.output import to_svg

HERE = Path(__file__).resolve().parent
RECORD = 400
"""Characters: what is shorter, and every list of plain values, is a record with a line of its own."""


def options(description: str | None, **counts: int) -> argparse.Namespace:
    """Read the options of a study: its counts, with their defaults, and the folder that its results go into."""
    parser = argparse.ArgumentParser(description=description)
    for name, default in counts.items():
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--folder", type=Path, default=HERE, help="where the results go")
    return parser.parse_args()


def write_numbers(path: Path, numbers: Any) -> None:
    """Write JSON with a record a line, so that a comparison of two versions shows which records changed."""
    path.write_text(_records(numbers, "\n") + "\n", encoding="utf-8")


def _records(value: Any, line: str) -> str:
    whole, deeper = json.dumps(value, ensure_ascii=False), f"{line} "
    holding = (dict, list, tuple)
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, holding) else ()
    if len(whole) <= RECORD or not any(isinstance(each, holding) for each in inside):
        return whole
    parts = [_records(each, deeper) for each in inside]
    if isinstance(value, dict):
        parts = [f"{json.dumps(name, ensure_ascii=False)}: {part}" for name, part in zip(value, parts, strict=True)]
    return whole[0] + ",".join(deeper + part for part in parts) + line + whole[-1]


def rounded(value: Any, digits: int) -> Any:
    """Numbers with so many digits, and None for those that are none; arrays are lists."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, dict):
        return {name: rounded(each, digits) for name, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(each, digits) for each in value]
    if isinstance(value, float):
        return float(f"{value:.{digits}g}") if math.isfinite(value) else None
    return value


def write_figure(path: Path, figure: Figure, title: str, described: str) -> None:
    """Write a figure with the title and the description that a reader who does not see it gets."""
    path.write_text(to_svg(figure, identity=path.stem, title=title, description=described), encoding="utf-8")


@dataclass(frozen=True)
class Study:
    """A study: its name, the page of its numbers and of the name of its figure, and that figure, if it has one."""

    name: str
    page: Callable[[Any, str], str]
    draw: Callable[[Any], Figure] | None = None
    title: str = ""
    described: str = ""

    def write(self, found: Any, folder: Path) -> None:
        """Write page, numbers and figure into a folder."""
        write_numbers(folder / f"{self.name}.json", found)
        (folder / f"{self.name}.md").write_text(self.page(found, f"{self.name}.svg"), encoding="utf-8")
        if self.draw is not None:
            write_figure(folder / f"{self.name}.svg", self.draw(found), self.title, self.described)

    def perform(self, measure: Callable[..., Any], description: str | None, **counts: int) -> Any:
        """Measure as the options say, by default so many, and write what was found; return it, too."""
        told = vars(options(description, **counts))
        folder = told.pop("folder")
        found = measure(**told)
        self.write(found, folder)
        return found


def table(heads: Iterable[str], rows: Iterable[Sequence[object]]) -> str:
    """Write a table in Markdown; what a row is short of is empty."""
    heads = list(heads)
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for row in rows:
        cells = [str(cell).replace("|", "\\|") for cell in row]
        lines.append("| " + " | ".join(cells + [""] * (len(heads) - len(cells))) + " |")
    return "\n".join(lines)


Cells = Mapping[str, str | Callable[[Any], object]]
"""Of a row below each head: its fields in a format, or a function of it."""


def columns(cells: Cells, rows: Iterable[Any]) -> str:
    """Write a table by its columns."""
    made = ([cell.format_map(row) if isinstance(cell, str) else cell(row) for cell in cells.values()] for row in rows)
    return table(cells, made)


def renewed(document: str, marks: tuple[str, str], inside: str) -> str:
    """Put text between the two marks of a document."""
    begin, end = marks
    return re.sub(
        f"{re.escape(begin)}.*{re.escape(end)}", lambda _: f"{begin}\n\n{inside}\n\n{end}", document, flags=re.DOTALL
    )
