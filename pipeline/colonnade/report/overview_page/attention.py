"""What needs a look before anything else: failures and findings in groups, missed outcomes, misfits outside."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from colonnade.campaign.forms.assessed import AssessmentSummary
from colonnade.campaign.forms.summary import Warned
from colonnade.findings import Severity
from colonnade.identification.response.rank import WITHIN
from colonnade.report.overview_page.agreement import Cell, Confusion
from colonnade.report.rows import TestRow
from colonnade.store.records.stored import Failure


@dataclass(frozen=True)
class Attention:
    """
    What needs a look, the most urgent first.

    Attributes
    ----------
    failed : list of TestRow
    unanswered : dict of str to Failure
        Why assessments failed.
    serious : list of WarningGroup
        Findings that make results wrong; what follows from another one is not among them.
    missed : list of (str, Cell)
        Model, and tests whose outcome it misses.
    warnings : list of WarningGroup
    outside : list of (str, list of str, float)
        Model, tests whose measured angle is outside its own spread, and how many of those judged are so by chance.
    explained, notes : int
        Findings that follow from another one, and notes; they are counted only.
    """

    failed: list[TestRow]
    unanswered: dict[str, Failure]
    serious: list[WarningGroup]
    missed: list[tuple[str, Cell]]
    warnings: list[WarningGroup]
    outside: list[tuple[str, list[str], float]]
    explained: int
    notes: int

    @property
    def is_needed(self) -> bool:
        """Whether there is anything to look at."""
        return bool(self.failed or self.unanswered or self.serious or self.missed or self.warnings or self.outside)


def attention(
    tests: Sequence[TestRow],
    models: Sequence[str],
    groups: Sequence[WarningGroup],
    confusions: Sequence[Confusion],
    assessed: Mapping[str, AssessmentSummary] | None = None,
) -> Attention:
    """Gather what needs a look; `groups` are the findings of all tests, specimens and assessments, the worst first."""
    causes = [group for group in groups if not group.first.explained]
    judged = [(model, {row.id: said for row in tests if (said := row.verdict(model))}) for model in models]
    outside = [(model, [id for id, said in own.items() if said == "outside"], own) for model, own in judged]
    return Attention(
        failed=[row for row in tests if row.record.status == "failed"],
        unanswered={
            name: Failure("assessment", each.reason or "")
            for name, each in (assessed or {}).items()
            if each.status == "failed"
        },
        serious=[group for group in causes if group.first.severity == Severity.SERIOUS],
        missed=[(each.model, cell) for each in confusions for cell in each.wrong],
        warnings=[group for group in causes if group.first.severity == Severity.WARNING],
        outside=[(model, names, (1 - WITHIN) * len(own)) for model, names, own in outside if names],
        explained=len(groups) - len(causes),
        notes=sum(group.first.severity == Severity.NOTE for group in causes),
    )


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
    return sorted(groups.values(), key=lambda group: (Severity(group.first.severity).rank, -len(group.subjects)))
