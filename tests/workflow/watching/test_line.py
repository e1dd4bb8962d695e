"""The line on a test: what happened, what was predicted, where it is on the map, what is wrong, in this order."""

from __future__ import annotations

import json

from colonnade.campaign.forms.summary import (
    IdentifiedSummary,
    PredictionSummary,
    RestitutionSummary,
    TestSummary,
    Warned,
)
from colonnade.findings import Severity, serious
from colonnade.workflow.watching.line import Line

KNOWN = RestitutionSummary(value=0.976, low=0.974, high=0.978, level=0.95, source="identified", tests=("a", "b"))


def line(record: TestSummary, *, limits: dict[str, float] | None = None, changed: tuple = ()) -> Line:
    return Line("sine-07", record, KNOWN, limits or {}, changed, 2.34)


def test_a_sine_is_put_on_the_map() -> None:
    record = TestSummary(
        status="done",
        kind="sine",
        specimen="prism",
        outcome="rocking",
        peak_ratio=0.412,
        frequency_ratio=4.463,
        amplitude_ratio=2.1,
        predicted={"linear": PredictionSummary(outcome="rocking", peak_ratio=0.44), "contact": PredictionSummary()},
    )
    said = line(record, limits={"no_rocking": 1.0, "lower": 2.61}).text()
    assert said == (
        "sine-07: rocking, peak 0.412 α; linear: rocking, peak 0.44 α; Ω 4.46, A 2.1 (overturns from A 2.61 by the map)"
        " (2.3 s)"
    )
    assert "by the map" not in line(record).text()


def test_a_free_vibration_says_its_e_and_that_of_all() -> None:
    own = IdentifiedSummary(value=0.9755, low=0.9735, high=0.9775)
    record = TestSummary(status="done", kind="free-vibration", specimen="prism", outcome="rocking", restitution=own)
    said = line(record).text()
    assert "e 0.976 ± 0.002; prism so far e 0.976 ± 0.002 of 2" in said
    refused = record.model_copy(update={"restitution": IdentifiedSummary(reason="too few peaks")})
    assert "no e (too few peaks)" in line(refused).text()


def test_a_failure_gives_its_reason() -> None:
    record = TestSummary(status="failed", reason="ingest: cut off", kind="sine", specimen="prism")
    assert line(record).text() == "sine-07: failed: ingest: cut off (2.3 s)"


def test_what_changed_comes_before_other_findings_and_notes_are_left_out() -> None:
    warnings = tuple(
        Warned(severity=severity, kind=kind, text=f"{kind}.", explained=explained)
        for severity, kind, explained in [
            (Severity.WARNING, "clipped", False),
            (Severity.WARNING, "drift", False),
            (Severity.WARNING, "follows", True),
            (Severity.NOTE, "note", False),
        ]
    )
    record = TestSummary(status="done", kind="sine", specimen="prism", outcome="rocking", warnings=warnings)
    said = line(record, changed=(serious("dead channel", "Channel top does not move."),)).text()
    assert "serious: Channel top does not move; warning: clipped; and drift (" in said


def test_programs_get_the_record_and_what_is_added() -> None:
    record = TestSummary(status="done", kind="sine", specimen="prism", outcome="overturned")
    said = json.loads(json.dumps(line(record, limits={"lower": 2.6}).as_json(), allow_nan=False))
    assert (said["test"], said["outcome"], said["map_limits"]) == ("sine-07", "overturned", {"lower": 2.6})
    assert said["specimen_restitution"]["tests"] == ["a", "b"]
