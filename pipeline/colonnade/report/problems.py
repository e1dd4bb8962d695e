"""Failures with their reasons, and warnings grouped by their text."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from colonnade.campaign.forms.summary import Warned
from colonnade.findings import Severity

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
