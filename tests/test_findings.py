"""Findings: weighed, put in order, and stored without loss."""

import itertools

from colonnade.findings import (
    MEASUREMENT,
    Finding,
    Severity,
    at_stage,
    from_text,
    in_order,
    note,
    serious,
    to_text,
    warning,
)
from every import every

GAIN = serious("gain", "The gain of top is ten times off.")
NO_ARC = warning("no restitution", "No arc was found.", follows=MEASUREMENT)
SPIKES = note("spikes", "Spikes on 2 samples.")
LOST = warning("lost samples", "1 gap in time.")


def test_text_that_nobody_weighed_is_a_warning_and_never_less():
    assert Finding("cut off").severity is Severity.WARNING


@every("order", list(itertools.permutations([GAIN, NO_ARC, SPIKES, LOST])))
def test_causes_come_first_and_what_follows_from_them_last(order):
    assert in_order(order) == [(GAIN, False), (LOST, False), (SPIKES, False), (NO_ARC, True)]


def test_without_its_cause_a_symptom_stands_by_itself():
    assert in_order([SPIKES, NO_ARC]) == [(NO_ARC, False), (SPIKES, False)]


def test_a_sentence_that_two_stages_found_is_told_once():
    told = [*at_stage([LOST], "ingest"), *at_stage([LOST], "condition")]
    assert [(each.text, each.stage) for each, _ in in_order(told)] == [("1 gap in time.", "ingest")]


def test_findings_come_back_as_they_were_stored():
    found = at_stage([GAIN, NO_ARC, SPIKES], "condition")
    assert from_text(to_text(found)) == found
