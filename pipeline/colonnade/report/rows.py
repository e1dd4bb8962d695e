"""One test in the tables of all tests: its entry in the campaign file, its record, and its angle as a small line."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import PredictionSummary, TestSummary
from colonnade.figures.panels.curve import Curve, envelope
from colonnade.figures.stored.subject import OfTest
from colonnade.findings import Severity
from colonnade.identification.response.rank import is_within
from colonnade.store.records import wording
from colonnade.store.records.stored import Failure
from colonnade.store.results import models_shown

KINDS = {
    "free-vibration": "Free vibration",
    "sine": "Sine test",
    "earthquake": "Earthquake test",
    "pulse": "Pulse test",
    "noise": "Noise test",
    "tilt": "Tilt test",
    "other": "Other test",
}
"""Kinds of test in words."""


@dataclass(frozen=True)
class TestRow:
    """
    One test.

    Attributes
    ----------
    test : Test
    record : TestSummary
    models : tuple of str
        Those of the campaign.
    failures : tuple of Failure
        In the order of the stages.
    reviewed : bool
        Whether the manual review has an entry for it.
    excluded : str
        By whom and why the manual review leaves it out, empty if it does not.
    """

    __test__ = False  # pytest takes a class of this name for a test

    test: Test
    record: TestSummary
    models: tuple[str, ...]
    failures: tuple[Failure, ...]
    reviewed: bool
    excluded: str

    @classmethod
    def of(cls, one: OfTest) -> TestRow:
        """Make the row of a test of which all is read."""
        return cls.known(one.campaign, one.test, one.record, tuple(one.failures))

    @classmethod
    def known(cls, campaign: Campaign, test: Test, record: TestSummary, failures: tuple[Failure, ...]) -> TestRow:
        """Make the row of a test whose failures are known."""
        review = campaign.review(test.id)
        models = models_shown(campaign)
        return cls(test, record, models, failures, bool(review.sentences), review.excluded)

    @property
    def id(self) -> str:
        """Its id."""
        return self.test.id

    @property
    def outcome(self) -> str:
        """The measured outcome, else the observed one, empty if neither is known."""
        return self.record.outcome or self.record.observed_outcome or ""

    @property
    def frequency(self) -> float | None:
        """Of a sine test, Hz; as meant if that is given, so that tests meant alike are together."""
        return self.test.frequency or self.record.frequency

    @property
    def has_results(self) -> bool:
        """Whether a measured or predicted outcome is known."""
        return bool(self.record.outcome or any(self.predicted(model).outcome for model in self.models))

    @property
    def severities(self) -> list[tuple[str, int]]:
        """How many findings it has of each severity, the worst first; severities without findings are left out."""
        found = [finding.severity for finding in self.record.warnings]
        return [(severity, found.count(severity)) for severity in Severity if severity in found]

    @property
    def states(self) -> list[str]:
        """How far it is, and the severities of its findings."""
        return ["excluded" if self.excluded else self.record.status, *(severity for severity, _ in self.severities)]

    @property
    def differing(self) -> list[str]:
        """Models that predict another outcome than the measured (or observed) one, or whose runs do not hold it."""
        return [model for model, mark in self.marks.items() if mark == wording.DIFFERS]

    @property
    def marks(self) -> dict[str, str]:
        """The verdict on each model's prediction: ✓, ≠ or nothing."""
        return {model: wording.verdict(self.record, model) for model in self.models}

    def answer(self, level: float) -> str:
        """Say what the test gave, and what each model predicts of it; `level` is that of the interval of e."""
        said = (f"{model} {text}" for model, text in wording.predicted(self.record).items())
        return "; ".join((wording.measured(self.record, level), *said))

    def predicted(self, model: str) -> PredictionSummary:
        """Return what a model predicts, empty if it has not run."""
        return self.record.predicted.get(model, PredictionSummary())

    def agrees(self, model: str) -> bool | None:
        """Return whether a model's outcome is the measured (or observed) one, None if either is not known."""
        return wording.agree(self.outcome, self.predicted(model).outcome or "")

    def verdict(self, model: str) -> str:
        """Return whether the measured angle is "within" or "outside" a model's own spread, empty if not judged."""
        rank = self.predicted(model).within_spread
        within = is_within(nan if rank is None else rank)
        return "" if within is None else "within" if within else "outside"


WIDTH, HEIGHT = 64, 20
"""Of the picture, in its own units; its full height is ± the critical angle."""

_INTERVALS = 32


def polyline(ratio: Curve | None) -> str:
    """
    Write a history as the points of an SVG polyline.

    Parameters
    ----------
    ratio : Curve or None
        θ/α over time; gaps are bridged.

    Returns
    -------
    points : str
        Within `WIDTH` and `HEIGHT`, θ > 0 upwards, whole numbers; empty without two finite values.

    Examples
    --------
    >>> polyline(Curve(np.linspace(0.0, 1.0, 5), np.array([0.0, 0.0, 0.0, 1.0, 2.0])))
    '0,10 32,10 48,0 64,0'
    """
    if ratio is None:
        return ""
    known = np.isfinite(ratio.values)
    time, values = ratio.time[known], ratio.values[known]
    if time.size < 2 or time[-1] <= time[0]:
        return ""
    time, values = envelope(Curve(time, values), intervals=_INTERVALS)
    x = np.rint(WIDTH * (time - time[0]) / (time[-1] - time[0])).astype(int)
    y = np.rint(HEIGHT / 2 * (1 - np.clip(values, -1.0, 1.0))).astype(int)
    bends = np.ones(y.size, dtype=bool)
    bends[1:-1] = (y[1:-1] != y[:-2]) | (y[1:-1] != y[2:])
    return " ".join(f"{across},{down}" for across, down in zip(x[bends], y[bends], strict=True))
