"""Findings on a terminal: by kind, the worst first, causes before symptoms."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from colonnade.cli.common.console import say, say_marked
from colonnade.errors import count
from colonnade.findings import WORST_FIRST, Finding, Severity
from colonnade.units.text import listed

if TYPE_CHECKING:
    from colonnade.campaign.forms.summary import Warned
    from colonnade.workflow import RunResult

IN_FULL = 3
"""Findings of one kind that are written in full; of the others only their subjects."""

NAMED = 8
"""Tests that are named after them."""

STYLES = {Severity.SERIOUS: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "dim"}
"""How a severity looks on a terminal."""

WORDS = {Severity.SERIOUS: "serious finding", Severity.WARNING: "warning", Severity.NOTE: "note"}
"""What a finding of a severity is called."""

Findings = Mapping[str, Sequence[tuple[Finding, bool]]]
"""By subject, in order, each with whether it follows from one before it."""


def records_of(ordered: Iterable[tuple[Finding, bool]]) -> list[Warned]:
    """Give findings as JSON shows them: the records of the summary."""
    from colonnade.campaign.forms.summary import Warned

    return [Warned.of(each, explained=explained) for each, explained in ordered]


def show_failures(result: RunResult, mark: str, *, where: str) -> None:
    """Write what failed, alike reasons together, each with the serious findings that are probably its cause."""
    findings, groups = result.findings, dict[tuple[str, str], list[tuple[str, str]]]()
    for stage in result.stages:
        if stage.action == "failed":
            text = probable_cause(findings.get(stage.heading, ()), where=where) + stage.reason
            alike = re.sub(r"\d+", "", text.replace(stage.heading, ""))
            groups.setdefault((mark.format(stage.stage), alike), []).append((stage.heading, text))
    for (said, _), members in groups.items():
        _show_alike(said, Severity.SERIOUS, members)


def probable_cause(findings: Sequence[tuple[Finding, bool]], *, where: str) -> str:
    """Name the serious findings about a failed test, and where on the screen they are."""
    kinds = dict.fromkeys(each.kind for each, explained in findings if each.severity == "serious" and not explained)
    return f"probably because of the serious findings {where} ({', '.join(kinds)}): " if kinds else ""


def show_by_kind(findings: Findings) -> None:
    """
    Write findings by kind, the worst first: a few in full, the others by their subjects alone.

    What another finding explains is only counted after it; of notes, one is written in full.
    """
    groups: dict[tuple[bool, Severity, str], list[tuple[str, str]]] = {}
    for subject, ordered in findings.items():
        for each, explained in ordered:
            groups.setdefault((explained, each.severity, each.kind), []).append((subject, each.text))
    for explained, severity, kind in sorted(groups, key=lambda key: (key[0], WORST_FIRST.index(key[1]))):
        members = groups[explained, severity, kind]
        if explained:
            say(f"follows from the above: {kind}: {_named(members)}")
        else:
            _show_alike(f"{severity} ({kind})", severity, members)
    counts = Counter(severity for (explained, severity, _), members in groups.items() if not explained for _ in members)
    if counts:
        say(counted(counts))


def _show_alike(mark: str, severity: Severity, members: Sequence[tuple[str, str]]) -> None:
    """Write the first of subjects and texts that are alike, and name the other subjects."""
    in_full = 1 if severity is Severity.NOTE else IN_FULL
    for subject, text in members[:in_full]:
        say_marked(mark, STYLES[severity], f": {subject}: {text}".replace("\n", "\n  "))
    if rest := members[in_full:]:
        say(f"  and {len(rest)} more of this kind: {_named(rest)}")


def counted(severities: Mapping[Severity, int]) -> str:
    """Count findings, the worst first: "1 serious finding, 2 notes"."""
    return ", ".join(count(severities[each], word) for each, word in WORDS.items() if severities.get(each))


def _named(members: Sequence[tuple[str, str]]) -> str:
    return listed(list(dict.fromkeys(subject for subject, _ in members)), NAMED)
