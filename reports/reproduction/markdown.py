"""Tables and numbers as Markdown text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

VIRTUAL = "*“Measured” here means measured on a virtual shake table: no recording of the experiment is public.*"
"""First line of every page."""


def table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Write a table."""
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    return "\n".join(lines + ["| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |" for row in rows])


def shown(value: float | None, digits: int = 3) -> str:
    """Write a number, or a dash for None."""
    return "–" if value is None else f"{value:.{digits}g}"


def fixed(value: float | None, digits: int = 2) -> str:
    """Write a number with so many decimals, or a dash."""
    return "–" if value is None else f"{value:.{digits}f}"


def figure(number: str, title: str) -> str:
    """Write a figure of the paper under its heading."""
    return f"## Figure {number}: {title[0].lower()}{title[1:]}\n\n![Figure {number}: {title}](figure-{number}.svg)"
