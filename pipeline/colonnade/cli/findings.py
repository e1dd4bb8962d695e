"""How findings are written on a terminal: the severity first, causes before what follows from them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from colonnade.findings import Finding, in_order


def records_of(findings: Iterable[Finding]) -> list[dict[str, Any]]:
    """Give findings as JSON shows them, in order: severity, kind, text, and whether one before explains it."""
    return [
        {"severity": str(each.severity), "kind": each.kind, "text": each.text, "explained": explained}
        for each, explained in in_order(findings)
    ]


def lines_of(findings: Iterable[Finding]) -> list[str]:
    """Write each finding as a line, in order."""
    return [line_of(record) for record in records_of(findings)]


def line_of(record: Mapping[str, Any]) -> str:
    """Write a finding of the summary as a line; what another explains is said to follow from it."""
    follows = " (follows from the above)" if record.get("explained") else ""
    return f"{record['severity']}{follows}: {record['text']}"
