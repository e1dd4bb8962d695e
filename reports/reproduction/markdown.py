"""Tables and numbers as Markdown text."""

from __future__ import annotations

VIRTUAL = "*“Measured” here means measured on a virtual shake table: no recording of the experiment is public.*"
"""First line of every page."""


def shown(value: float | None, digits: int = 3) -> str:
    """Write a number, or a dash for None."""
    return "–" if value is None else f"{value:.{digits}g}"


def fixed(value: float | None, digits: int = 2) -> str:
    """Write a number with so many decimals, or a dash."""
    return "–" if value is None else f"{value:.{digits}f}"


def figure(number: str, title: str) -> str:
    """Write a figure of the paper under its heading."""
    return f"## Figure {number}: {title[0].lower()}{title[1:]}\n\n![Figure {number}: {title}](figure-{number}.svg)"
