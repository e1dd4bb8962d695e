"""
What colonnade says while it goes on: findings, each with how much it matters, and causes before what follows from them.

A finding is written for the person in the laboratory, as the errors are. It travels with the result that it is about:
through a stage's warnings into the NetCDF file, the summary, the report and what the commands print.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from typing import Any


class Severity(StrEnum):
    """How much a finding matters, the worst first."""

    SERIOUS = "serious"
    """Something is wrong, and results of this test are wrong with it until it is put right."""
    WARNING = "warning"
    """Something is not as it should be; a result may be affected."""
    NOTE = "note"
    """Good to know; the results hold."""

    @property
    def rank(self) -> int:
        """Place in the order, 0 for the worst."""
        return list(Severity).index(self)


@dataclass(frozen=True)
class Finding:
    """
    A finding about a campaign, a raw file or a result.

    Attributes
    ----------
    text : str
        A sentence for people: what was found, where, what was expected, what to do.
    kind : str
        In a few words what it is about, the same for all findings of one kind: they are counted by it.
    severity : Severity
    follows : tuple of str
        Kinds of findings that explain this one where the same test has them.
    stage : str
        That found it; empty where that is not known yet.
    about : str
        Of a finding in the campaign file, the table that it is in: ``specimens.prism``, ``setups.frame``.
    """

    text: str
    kind: str = "other"
    severity: Severity = Severity.WARNING
    follows: tuple[str, ...] = ()
    stage: str = ""
    about: str = ""

    @classmethod
    def of(cls, told: Finding | str, kind: str = "other") -> Finding:
        """Take text that nobody weighed as a warning, so that it is not passed over."""
        return told if isinstance(told, Finding) else cls(told, kind)

    def __str__(self) -> str:
        """Give the sentence."""
        return self.text


def serious(kind: str, text: str, *, follows: tuple[str, ...] = ()) -> Finding:
    """Build a finding because of which results are wrong until it is put right."""
    return Finding(text, kind, Severity.SERIOUS, follows)


def warning(kind: str, text: str, *, follows: tuple[str, ...] = ()) -> Finding:
    """Build a finding that may affect a result."""
    return Finding(text, kind, Severity.WARNING, follows)


def note(kind: str, text: str, *, follows: tuple[str, ...] = ()) -> Finding:
    """Build a finding with which the results hold."""
    return Finding(text, kind, Severity.NOTE, follows)


MEASUREMENT = (
    *("specimen", "geometry", "gain", "unit", "sign"),
    *("swapped channels", "dead channel", "channel left out", "clock"),
)
"""Kinds of what is wrong with the measurement itself: where one is found, odd results follow from it."""


def in_order(findings: Iterable[Finding], known: Iterable[Finding] = ()) -> list[tuple[Finding, bool]]:
    """
    Put the findings of one test in order: the worst first, each once, and behind its cause what follows from it.

    Parameters
    ----------
    findings : iterable of Finding
    known : iterable of Finding, optional
        Of the campaign file, that concern this test: they explain findings too, and are not listed.

    Returns
    -------
    ordered : list of (Finding, bool)
        Each with whether it follows from one before it.

    Examples
    --------
    >>> arc = warning("no arc", "No arc was found.", follows=("gain",))
    >>> [(each.kind, explained) for each, explained in in_order([arc, serious("gain", "Ten times off.")])]
    [('gain', False), ('no arc', True)]
    """
    first: dict[str, Finding] = {}
    for finding in findings:
        first.setdefault(finding.text, finding)
    each = sorted(first.values(), key=lambda finding: finding.severity.rank)
    others = [*each, *known]
    causes = [finding for finding in each if not _explained(finding, others)]
    return [(finding, False) for finding in causes] + [(finding, True) for finding in each if finding not in causes]


def _explained(finding: Finding, others: Sequence[Finding]) -> bool:
    """Whether another finding, itself no consequence of this one, is of a kind that explains it."""
    return any(
        other.kind in finding.follows and finding.kind not in other.follows for other in others if other is not finding
    )


def at_stage(findings: Iterable[Finding | str], stage: str) -> list[Finding]:
    """Say of findings at which stage they were found, where they do not say it."""
    return [replace(each, stage=each.stage or stage) for each in map(Finding.of, findings)]


def as_record(finding: Finding) -> dict[str, Any]:
    """Give a finding as JSON holds it; what is empty is left out."""
    return {name: value for name, value in asdict(finding).items() if value}


def to_text(findings: Iterable[Finding | str]) -> str:
    """Write findings as JSON text, as a result's file holds them."""
    return json.dumps([as_record(Finding.of(each)) for each in findings], ensure_ascii=False)


def from_text(text: str) -> list[Finding]:
    """
    Read findings back; of what was written in another form, the text, as warnings.

    Examples
    --------
    >>> from_text(to_text([note("spikes", "Spikes on 2 samples.")])) == [note("spikes", "Spikes on 2 samples.")]
    True
    >>> from_text('["cut off"]')[0].severity
    <Severity.WARNING: 'warning'>
    """
    try:
        records = json.loads(text or "[]")
    except json.JSONDecodeError:
        records = [text]
    return [_read(record) for record in (records if isinstance(records, list) else [text])]


def _read(record: Any) -> Finding:
    if not isinstance(record, Mapping) or "text" not in record:
        return Finding(record if isinstance(record, str) else json.dumps(record, ensure_ascii=False))
    known = {str(severity): severity for severity in Severity}
    return Finding(
        str(record["text"]),
        str(record.get("kind", "other")),
        known.get(str(record.get("severity")), Severity.WARNING),
        tuple(str(kind) for kind in record.get("follows", ())),
        str(record.get("stage", "")),
        str(record.get("about", "")),
    )
