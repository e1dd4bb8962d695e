"""Statements with their answers as tables."""

from __future__ import annotations

import re
from collections.abc import Sequence

from reproduction.drawings import FIGURES
from reproduction.statement import WORDS, Numbers, Statement, Verdict
from reproduction.statements import STATEMENTS, answers
from study import table

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
