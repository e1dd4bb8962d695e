"""Numbers, figures and statements with their answers as Markdown."""

from __future__ import annotations

import re
from collections.abc import Sequence

from reproduction.drawings import FIGURES
from reproduction.statement import WORDS, Numbers, Statement, Verdict
from reproduction.statements import STATEMENTS, answers
from study import table

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


HEADS = ("where", "the paper says", "examined", "we find", "")

_FIGURE = re.compile(r"fig\. (\d+)")


def statement_table(statements: Sequence[Statement], numbers: Numbers) -> str:
    """Lay statements beside what we find."""
    found = answers(numbers)
    return table(
        HEADS,
        [
            [
                each.section,
                each.says,
                f"{each.examined}. Agrees if: {each.rule}." if each.rule else f"{each.examined}.",
                found[each.id].ours,
                verdict_text(found[each.id].verdict),
            ]
            for each in statements
        ],
    )


def verdict_text(verdict: Verdict) -> str:
    """Write a verdict, so that one that differs is seen."""
    return f"**{WORDS[verdict]}**" if verdict == "differs" else WORDS[verdict]


def figure_of(statement: Statement) -> str | None:
    """Return the number of the figure that a statement belongs to, if that is drawn."""
    found = _FIGURE.search(statement.section)
    drawn = {entry.number for entry in FIGURES}
    return found[1] if found and found[1] in drawn else None


def of_figure(number: str) -> list[Statement]:
    """Return the statements that belong to a figure."""
    return [each for each in STATEMENTS if figure_of(each) == number]
