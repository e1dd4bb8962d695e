"""
Findings: what colonnade reports while it continues, each with its severity, causes before symptoms.

A finding is written for the person in the laboratory, like an error. It stays with the result that it is about:
from a stage's warnings into the NetCDF file, the summary, the report and the output of the commands.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from enum import StrEnum

from pydantic import TypeAdapter


class Severity(StrEnum):
    """How much a finding matters, the worst first."""

    SERIOUS = "serious"
    """Something is wrong, and the results of this test are wrong until it is corrected."""
    WARNING = "warning"
    """Something is not as expected; a result may be affected."""
    NOTE = "note"
    """Good to know; the results are valid."""


WORST_FIRST = tuple(Severity)


@dataclass(frozen=True)
class Finding:
    """
    A finding about a campaign, a raw file or a result.

    Attributes
    ----------
    text : str
        A sentence for people: what was found, where, what was expected, what to do.
    kind : str
        What it is about, in a few words; findings are counted by it.
    severity : Severity
    follows : tuple of str
        Kinds of findings that explain this one if the same test has them.
    stage : str
        That found it; empty if that is not known yet.
    about : str
        Of a finding in the campaign file, the table that it is in: ``specimens.prism``, ``setups.frame``.
    """

    text: str
    kind: str = "other"
    severity: Severity = Severity.WARNING
    follows: tuple[str, ...] = ()
    stage: str = ""
    about: str = ""

    def __str__(self) -> str:
        """Give the sentence."""
        return self.text


def serious(kind: str, text: str, *, follows: tuple[str, ...] = ()) -> Finding:
    """Build a finding that makes results wrong until it is corrected."""
    return Finding(text, kind, Severity.SERIOUS, follows)


def warning(kind: str, text: str, *, follows: tuple[str, ...] = ()) -> Finding:
    """Build a finding that may affect a result."""
    return Finding(text, kind, Severity.WARNING, follows)


def note(kind: str, text: str, *, follows: tuple[str, ...] = ()) -> Finding:
    """Build a finding that does not affect the results."""
    return Finding(text, kind, Severity.NOTE, follows)


MEASUREMENT = (
    *("specimen", "geometry", "gain", "unit", "sign"),
    *("swapped channels", "dead channel", "channel left out", "clock", "late recorder"),
)
"""Kinds of errors of the measurement itself: if one is found, odd results follow from it."""


def in_order(findings: Iterable[Finding], known: Iterable[Finding] = ()) -> list[tuple[Finding, bool]]:
    """
    Put the findings of one test in order: the worst first, each once, and after its cause what follows from it.

    Parameters
    ----------
    findings : iterable of Finding
    known : iterable of Finding, optional
        From the campaign file, about this test: they also explain findings, but are not listed.

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
    each = sorted(first.values(), key=lambda finding: WORST_FIRST.index(finding.severity))
    others = [*each, *known]
    causes = [finding for finding in each if not _explained(finding, others)]
    return [(finding, False) for finding in causes] + [(finding, True) for finding in each if finding not in causes]


def _explained(finding: Finding, others: Sequence[Finding]) -> bool:
    """Whether another finding, itself no consequence of this one, is of a kind that explains it."""
    return any(
        other.kind in finding.follows and finding.kind not in other.follows for other in others if other is not finding
    )


def at_stage(findings: Iterable[Finding], stage: str) -> list[Finding]:
    """Add the stage to findings that do not name one."""
    return [replace(each, stage=each.stage or stage) for each in findings]


def to_text(findings: Iterable[Finding]) -> str:
    """Write findings as JSON text without empty fields, as a result's file holds them."""
    records = [{name: value for name, value in asdict(each).items() if value} for each in findings]
    return json.dumps(records, ensure_ascii=False)


def from_text(text: str) -> list[Finding]:
    """
    Read findings back.

    Examples
    --------
    >>> from_text(to_text([note("spikes", "Spikes on 2 samples.")])) == [note("spikes", "Spikes on 2 samples.")]
    True
    """
    return _MANY.validate_json(text or "[]")


_MANY = TypeAdapter(list[Finding])
