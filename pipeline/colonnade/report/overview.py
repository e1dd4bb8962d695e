"""What the overview shows: the rows of its tables, what needs a look, outcomes, peaks, sine tests, Spans."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import inf, log, nan
from typing import Any, NamedTuple, get_args

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.assessed import AssessmentSummary
from colonnade.campaign.forms.summary import PredictionSummary, TestSummary, Warned
from colonnade.dynamics.history import Outcome
from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError, count
from colonnade.figures.agreement import PeakPoint, predicted_over_measured
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.curve import Curve, envelope
from colonnade.figures.stored import record
from colonnade.figures.stored.record import SpanPanel
from colonnade.findings import WORST_FIRST, Severity
from colonnade.identification.response.boundaries import Bracket, MapPoint, bracket_boundaries
from colonnade.identification.response.rank import WITHIN, is_within
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records import wording
from colonnade.store.records.stored import Failure, as_map
from colonnade.store.results import models_shown
from colonnade.units.text import NOTHING, number, quantity


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
    def of(cls, campaign: Campaign, test: Test, record: TestSummary, failures: Iterable[Failure] = ()) -> TestRow:
        """Make the row of a test."""
        review = campaign.review(test.id)
        return cls(test, record, models_shown(campaign), tuple(failures), bool(review.sentences), review.excluded)

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


MEASURED = (*get_args(Outcome), "not-overturned")
"""Outcomes that a test can have; the last is only observed, where nothing was measured."""


class Cell(NamedTuple):
    """Tests of one measured and one predicted outcome, and whether these agree."""

    measured: str
    predicted: str
    tests: tuple[str, ...]
    agrees: bool


class Confusion(NamedTuple):
    """Outcomes of one model: by measured outcome a row of cells, one for each predicted outcome."""

    model: str
    predicted: tuple[str, ...]
    rows: list[tuple[Cell, ...]]

    @property
    def wrong(self) -> list[Cell]:
        """Cells with tests whose outcome the model misses, those with most tests first."""
        cells = [cell for row in self.rows for cell in row if cell.tests and not cell.agrees]
        return sorted(cells, key=lambda cell: -len(cell.tests))


def confusions(tests: Sequence[TestRow], models: Sequence[str]) -> list[Confusion]:
    """Count the outcomes of each model that predicts a test whose outcome is known."""
    predicted, found = get_args(Outcome), []
    for model in models:
        known = [row for row in tests if row.agrees(model) is not None]
        by_outcome = {measured: [row for row in known if row.outcome == measured] for measured in MEASURED}
        rows = [
            tuple(_cell(own, measured, each, model) for each in predicted)
            for measured, own in by_outcome.items()
            if own
        ]
        if rows:
            found.append(Confusion(model, predicted, rows))
    return found


def _cell(own: Sequence[TestRow], measured: str, predicted: str, model: str) -> Cell:
    tests = [row for row in own if row.predicted(model).outcome == predicted]
    agrees = predicted != "overturned" if measured == "not-overturned" else predicted == measured
    return Cell(measured, predicted, tuple(row.id for row in tests), agrees)


NAMED = 10
"""Tests whose predicted peaks are furthest from the measured ones, named under the figure and numbered in it."""


class Worst(NamedTuple):
    """One of the tests whose predicted peak is furthest from the measured one; `factor` is predicted over measured."""

    row: TestRow
    model: str
    factor: float


def worst(tests: Sequence[TestRow], models: Sequence[str]) -> list[Worst]:
    """
    Find the `NAMED` predictions furthest from the measured peak, as a ratio either way.

    A model that predicts overturning of a test that rocked has no peak: its outcome is missed.
    """
    found = []
    for row in tests:
        measured = row.record.peak_ratio
        for model in models if row.record.outcome == "rocking" and measured else ():
            predicted = row.predicted(model).peak_ratio
            if predicted is not None and measured:
                found.append(Worst(row, model, predicted / measured))
    found.sort(key=lambda each: (-abs(log(each.factor)) if each.factor > 0 else -inf, each.row.id))
    return found[:NAMED]


def peak_points(tests: Sequence[TestRow], models: Sequence[str], named: Sequence[Worst]) -> dict[str, list[PeakPoint]]:
    """Give the points of the figure, by model: every prediction of a test that rocked, overturning without a peak."""
    numbers = {(each.row.id, each.model): place for place, each in enumerate(named, 1)}
    found = {
        model: [
            _point(row, model, numbers.get((row.id, model)))
            for row in tests
            if row.record.outcome == "rocking" and row.record.peak_ratio and row.predicted(model).outcome
        ]
        for model in models
    }
    return {model: own for model, own in found.items() if own}


def _point(row: TestRow, model: str, place: int | None) -> PeakPoint:
    predicted = row.predicted(model)
    ends = predicted.peak_low, predicted.peak_high
    return PeakPoint(row.record.peak_ratio or 0.0, predicted.peak_ratio, *ends, test=row.id, number=place)


def peaks_picture(found: Mapping[str, Sequence[PeakPoint]]) -> Picture | None:
    """Draw the figure; None without a point."""
    if not found:
        return None
    described = ", ".join(f"{count(len(own), 'test')} by the {model} model" for model, own in found.items())
    title = "Predicted over measured largest rocking angle"
    return Picture(predicted_over_measured(found), "peaks", title, f"{described}.")


def attention(
    tests: Sequence[TestRow],
    models: Sequence[str],
    groups: Sequence[WarningGroup],
    confusions: Sequence[Confusion],
    assessed: Mapping[str, AssessmentSummary] | None = None,
) -> dict[str, Any]:
    """
    Gather what needs a look, the most urgent first; `groups` are all findings, the worst first.

    `outside` has of each model the tests whose measured angle is outside its own spread, and how many of those judged
    are so by chance. Findings that follow from another one, and notes, are counted only: they need no look.
    """
    causes = [group for group in groups if not group.first.explained]
    by_severity = {each: [group for group in causes if group.first.severity == each] for each in Severity}
    judged = {model: [(row.id, said) for row in tests if (said := row.verdict(model))] for model in models}
    outside = {model: [name for name, said in own if said == "outside"] for model, own in judged.items()}
    needed = {
        "failed": [row for row in tests if row.record.status == "failed"],
        "unanswered": {
            name: Failure("assessment", each.reason or "")
            for name, each in (assessed or {}).items()
            if each.status == "failed"
        },
        "serious": by_severity[Severity.SERIOUS],
        "missed": [(each.model, cell) for each in confusions for cell in each.wrong],
        "warnings": by_severity[Severity.WARNING],
        "outside": [(model, names, (1 - WITHIN) * len(judged[model])) for model, names in outside.items() if names],
    }
    counted = {"explained": len(groups) - len(causes), "notes": len(by_severity[Severity.NOTE])}
    return needed | counted | {"is_needed": any(needed.values())}


_NUMBER = re.compile(r"(?<![A-Za-z_-])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?: (\w+?)s?\b)?")


class WarningGroup(NamedTuple):
    """Warnings of one stage that differ in their numbers alone: the first, and who has them."""

    first: Warned
    subjects: list[str]


def warning_groups(given: Iterable[tuple[str, Warned]]) -> list[WarningGroup]:
    """
    Gather warnings, the worst first, and of these those that most subjects have.

    Parameters
    ----------
    given : iterable of (str, Warned)
        Each with its subject: a test's id, or ``specimen <id>``.
    """
    groups: dict[tuple[str, str, str], WarningGroup] = {}
    for subject, found in given:
        key = found.stage, found.severity, _NUMBER.sub(r"# \1", found.text)
        group = groups.setdefault(key, WarningGroup(found, []))
        if subject not in group.subjects:
            group.subjects.append(subject)
    return sorted(groups.values(), key=lambda group: (WORST_FIRST.index(group.first.severity), -len(group.subjects)))


def ladder(tests: Sequence[TestRow]) -> dict[str, list[TestRow]]:
    """Lay out the sine tests of a specimen with known Ω and A: by rising frequency, of each by rising amplitude."""
    sines: dict[str, list[TestRow]] = defaultdict(list)
    for row in sorted(tests, key=lambda row: (row.frequency or 0.0, row.record.amplitude_ratio or 0.0, row.id)):
        if row.frequency is not None and row.record.amplitude_ratio is not None:
            sines[quantity(row.frequency, "Hz")].append(row)
    return sines


class SpanTest(NamedTuple):
    """An earthquake test with a Span: what the figure of all Spans and its table show."""

    row: TestRow
    panel: SpanPanel
    description: str


class SpanGroup(NamedTuple):
    """Earthquake tests of one specimen and motion, by rising Span."""

    title: str
    tests: list[TestRow]
    picture: Picture


def span_groups(drawn: Sequence[SpanTest]) -> list[SpanGroup]:
    """Draw the earthquake tests that have an angle, those of one specimen and motion side by side."""
    together: dict[tuple[str, str, float], list[SpanTest]] = defaultdict(list)
    for entry in drawn:
        test = entry.row.test
        together[test.specimen, test.motion or "", test.time_scale or 1.0].append(entry)
    groups = []
    for place, ((specimen, motion, scale), members) in enumerate(together.items(), start=1):
        if len(members) < 2:
            continue
        members.sort(key=lambda entry: (entry.row.test.span or 0.0, entry.row.id))
        title = f"{motion or 'Base motion'}, {specimen}" + (f", time scale {scale:.4g}" if scale != 1.0 else "")
        described = " ".join(f"{entry.panel.title}: {entry.description}" for entry in members)
        picture = record.spans(f"spans-{place}", title, described, [entry.panel for entry in members])
        groups.append(SpanGroup(title, [entry.row for entry in members], picture))
    return groups


def charts_of(campaign: Campaign, layout: Layout, specimen: str) -> list[StabilityMap]:
    """Read the stability maps of a specimen by the campaign's models in the plane, which a run keeps up to date."""
    found = []
    for model in campaign.processing.predict.models:
        path = layout.stage(specimen, "map", model)
        if not MODELS[model].in_space and path.is_file():
            with suppress(StoreError):
                found.append(files.read(path))
    return [as_map(stored) for stored in found if stored.attrs.get("status") == "done"]


def boundaries_of(points: Sequence[MapPoint]) -> list[tuple[str, str, str]]:
    """Write what sine tests bracket: Ω, the brackets of rocking and of overturning."""
    return [
        (number(each.frequency_ratio, 4), _bracket(each.rocking), _bracket(each.overturning))
        for each in bracket_boundaries(points)
    ]


def _bracket(bracket: Bracket) -> str:
    below, above = number(bracket.below, 4), number(bracket.above, 4)
    if bracket.above is None:
        return NOTHING if bracket.below is None else f"above {below}"
    place = f"below {above}" if bracket.below is None else f"{below} – {above}"
    others = ", ".join(number(each, 3) for each in bracket.exceptions)
    return f"{place}, but not at {others}" if others else place
