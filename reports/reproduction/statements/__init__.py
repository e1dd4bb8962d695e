"""Every statement of the paper, in the order of its pages here."""

from __future__ import annotations

from reproduction.statement import Answer, Numbers, Statement
from reproduction.statements import computation, earthquakes, free, maps, setting, sines, specimens

STATEMENTS: tuple[Statement, ...] = (
    *setting.stated,
    *specimens.stated,
    *computation.stated,
    *free.stated,
    *sines.stated,
    *maps.stated,
    *earthquakes.stated,
)


def answers(numbers: Numbers) -> dict[str, Answer]:
    """Answer every statement by its rule."""
    return {statement.id: statement.answer(numbers) for statement in STATEMENTS}
