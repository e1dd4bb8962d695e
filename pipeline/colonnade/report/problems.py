"""Everything that went wrong or looks odd: failures with their reasons, and warnings of the same text together."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

from colonnade.findings import Severity
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import SpecimenPage

_NUMBER = re.compile(r"(?<![A-Za-z_-])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?: (\w+?)s?\b)?")


class WarningGroup(NamedTuple):
    """Warnings of one stage that differ in their numbers alone: the words of the first, and who has them."""

    stage: str
    severity: str
    text: str
    subjects: tuple[str, ...]


def warning_groups(tests: Sequence[TestRow], specimens: Sequence[SpecimenPage]) -> tuple[WarningGroup, ...]:
    """
    Gather all warnings, the worst first, and of these those that most tests have.

    Subjects that are specimens are written ``specimen <id>``.
    """
    texts: dict[tuple[str, str, str], str] = {}
    subjects: dict[tuple[str, str, str], dict[str, None]] = defaultdict(dict)
    told = [(test.id, message) for test in tests for message in test.warnings]
    told += [(f"specimen {specimen.id}", message) for specimen in specimens for message in specimen.warnings]
    for subject, message in told:
        key = message.stage, message.severity, _NUMBER.sub(r"# \1", message.text)
        texts.setdefault(key, message.text)
        subjects[key][subject] = None
    groups = [WarningGroup(*key[:2], texts[key], tuple(who)) for key, who in subjects.items()]
    return tuple(sorted(groups, key=lambda group: (Severity(group.severity).rank, -len(group.subjects))))
