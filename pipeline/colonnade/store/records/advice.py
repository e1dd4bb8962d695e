"""What is advised: a test, or that none is needed, with the reason, the risk and what the table must do."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import inf, pi
from typing import Any, Literal

from colonnade.campaign.setup import ShakeTable
from colonnade.errors import count
from colonnade.units.text import probability, quantity

HEADS = ("specimen", "next", "risk", "tests left", "why")
"""Of a table of advice, see `Advice.row`."""

UNITS = {"acceleration": "g", "velocity": "m/s", "stroke": "mm"}
"""Units in which the demand on the table is written."""


@dataclass(frozen=True)
class Advice:
    """
    The next test of one kind of a specimen.

    Attributes
    ----------
    specimen : str
    kind : str
        "sine", "free-vibration" or "earthquake".
    test : str
        What to do, such as "5 Hz at 0.31 g (A 1.65)".
    is_enough : bool
        Whether no test of this kind is needed.
    reason : str
        Why, with figures.
    risk : float or None
        Predicted probability that it overturns; None for a free vibration.
    left : int or None
        Tests that are probably left, this one included; None if that cannot be said.
    demand : dict of str to float
        Peak `acceleration` (m/s²), `velocity` (m/s) and `stroke` (m, from the middle) of the table, as far as known.
    beyond : tuple of str
        What the table cannot do of it, a sentence each.
    values : dict of str to float
        The figures behind it, SI.
    """

    specimen: str
    kind: Literal["sine", "free-vibration", "earthquake"]
    test: str
    is_enough: bool
    reason: str
    risk: float | None = None
    left: int | None = None
    demand: dict[str, float] = field(default_factory=dict)
    beyond: tuple[str, ...] = ()
    values: dict[str, float] = field(default_factory=dict)

    def text(self) -> str:
        """Write it in a line."""
        return f"next {self.what()}; {'; '.join((self.reason, *self.beyond))}"

    def what(self) -> str:
        """Write what is to be done, without the reason."""
        if self.is_enough:
            return f"{self.kind} of {self.specimen}: enough"
        risk = "" if self.risk is None else f", risk {probability(self.risk)}"
        left = "" if self.left is None else f", {count(self.left, 'test')} left"
        return f"{self.kind} of {self.specimen}: {self.test}{risk}{left}"

    def row(self) -> tuple[str, str, str, str, str]:
        """Write it under `HEADS`."""
        return (
            self.specimen,
            f"{self.kind}: {'enough' if self.is_enough else self.test}",
            "" if self.risk is None or self.is_enough else probability(self.risk),
            "" if self.left is None else str(self.left),
            "; ".join((self.reason, *self.beyond)),
        )

    def as_json(self) -> dict[str, Any]:
        """Give it for programs."""
        return {"next": vars(self)}


def ranked(advice: Iterable[Advice]) -> list[Advice]:
    """
    Put what tells most first.

    Free vibrations come first: nothing falls in them, and every prediction uses e. Then by what a test is expected to
    tell; then what the table cannot do, and last what is enough.
    """
    return sorted(advice, key=lambda each: (each.is_enough, bool(each.beyond), -_told(each)))


def _told(advice: Advice) -> float:
    """Give what a test is expected to tell, bit."""
    if advice.kind == "free-vibration":
        return inf
    return advice.values.get("bits", advice.values.get("entropy", 0.0))


def demand_of_sine(acceleration: float, frequency: float) -> dict[str, float]:
    """
    Give what a table must do in a steady sine of an acceleration amplitude (m/s²) and a frequency (Hz).

    Examples
    --------
    >>> {name: round(value, 4) for name, value in demand_of_sine(2.0, 5.0).items()}
    {'acceleration': 2.0, 'velocity': 0.0637, 'stroke': 0.002}
    """
    omega = 2 * pi * frequency
    return {"acceleration": acceleration, "velocity": acceleration / omega, "stroke": acceleration / omega**2}


def beyond(table: ShakeTable, demand: dict[str, float]) -> tuple[str, ...]:
    """Say which limits of the table a demand passes."""
    return tuple(
        f"needs {quantity(value, UNITS[name])} of {name}; the table has {quantity(limit, UNITS[name])}"
        for name, value in demand.items()
        if (limit := getattr(table, name)) is not None and value > limit
    )
