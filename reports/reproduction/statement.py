"""What a statement of the paper is, and the rules by which it is answered."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

Numbers = Mapping[str, Any]

Verdict = Literal["agrees", "differs", "undecided"]

WORDS: dict[Verdict, str] = {"agrees": "agrees", "differs": "differs", "undecided": "cannot be decided"}

HISTORIES = {"good": 0.1, "reasonably good": 0.2}
"""RMS of the difference of two histories of θ, over α, up to which their agreement is called so. The paper gives no
measure; these are ours."""

BOUNDARIES = {"very good": 0.1, "fairly good": 0.25}
"""The same of a boundary on the map: RMS of the difference, over the boundary's own A."""


@dataclass(frozen=True)
class Answer:
    """A verdict, and the number that it rests on, in words with its unit."""

    verdict: Verdict
    ours: str


@dataclass(frozen=True)
class Statement:
    """
    A statement of the paper.

    Attributes
    ----------
    id : str
    section : str
        Of the paper, or the number of its table or figure.
    says : str
        What it states, in our words.
    examined : str
        How we examine it.
    rule : str
        When it agrees, in words: "it agrees if …"; empty if no number can decide it.
    finds : callable
        Applies the rule to the numbers of results.json; words alone if there is none.
    page : str
        The page that shows it: `tables`, `free-vibration`, `sines`, `maps`, `earthquakes` or `setting`.
    """

    id: str
    section: str
    says: str
    examined: str
    rule: str
    finds: Callable[[Numbers], Answer | str]
    page: str

    def answer(self, numbers: Numbers) -> Answer:
        """Answer by the rule; without one no number bears on it, or it is what the virtual laboratory was given."""
        found = self.finds(numbers)
        return found if isinstance(found, Answer) else Answer("undecided", found)


def sine_tests(numbers: Numbers) -> list[tuple[Numbers, Numbers]]:
    """Give each sine test of the prism: what was measured and predicted, and what its history shows."""
    return [(numbers["tests"][name], each) for name, each in numbers["sines"].items()]


def judged(agrees: bool, ours: str) -> Answer:
    """Answer by a condition."""
    return Answer("agrees" if agrees else "differs", ours)


Finding = Callable[[Numbers], Answer | str]


class Statements(list[Statement]):
    """The statements of a page in their order; the function that answers one is decorated with it."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.page = page

    def __call__(
        self, section: str, says: str, examined: str, rule: str = "", *, name: str = "", page: str = ""
    ) -> Callable[[Finding], Finding]:
        """Add a statement, whose id is the name of the function that answers it if it has no other."""

        def add(finds: Finding) -> Finding:
            identity = name or finds.__name__.strip("_").replace("_", "-")
            self.append(Statement(identity, section, says, examined, rule, finds, page or self.page))
            return finds

        return add

    def undecided(self, name: str, section: str, says: str, examined: str, ours: str) -> None:
        """Add a statement that no simulation can decide."""
        self(section, says, examined, name=name)(lambda _: ours)
