"""What a statement of the paper is, and the rules by which it is answered."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

Numbers = Mapping[str, Any]

Verdict = Literal["agrees", "differs", "undecided"]

WORDS: dict[Verdict, str] = {
    "agrees": "agrees",
    "differs": "differs",
    "undecided": "cannot be decided",
}


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
    answer : callable
        Applies the rule to the numbers of results.json.
    page : str
        The page that shows it: `tables`, `free-vibration`, `sines`, `maps`, `earthquakes` or `setting`.
    """

    id: str
    section: str
    says: str
    examined: str
    rule: str
    answer: Callable[[Numbers], Answer]
    page: str


def judged(agrees: bool, ours: str) -> Answer:
    """Answer by a condition."""
    return Answer("agrees" if agrees else "differs", ours)


def undecided(ours: str) -> Callable[[Numbers], Answer]:
    """Answer what no simulation can show: nothing in the numbers bears on it."""
    return lambda _: Answer("undecided", ours)


def assumed(read: Callable[[Numbers], str]) -> Callable[[Numbers], Answer]:
    """Answer what the virtual laboratory was given: that it comes out again shows nothing of the experiment."""
    return lambda numbers: Answer("undecided", read(numbers))


HISTORIES = {"good": 0.1, "reasonably good": 0.2}
"""RMS of the difference of two histories of θ, over α, up to which their agreement is called so. The paper gives no
measure; these are ours."""

BOUNDARIES = {"very good": 0.1, "fairly good": 0.25}
"""The same of a boundary on the map: RMS of the difference, over the boundary's own A."""
