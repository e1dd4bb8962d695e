"""Findings on a terminal: by kind, the worst first, a few in full, what follows from others only counted."""

from pathlib import Path

import pytest

from colonnade.cli.common import findings as shown_as
from colonnade.cli.common.findings import IN_FULL, NAMED, probable_cause, records_of
from colonnade.findings import in_order, note, serious, warning
from colonnade.store.records.wording import finding
from colonnade.workflow.chain import RunResult, StageRun

GAIN = serious("gain", "The gain is wrong.")
ARC = warning("no arc", "No arc was found.", follows=("gain",))
SPIKE = note("spikes", "Spikes on 2 samples.")


def shown(capsys, findings):
    shown_as.show_by_kind({subject: in_order(each) for subject, each in findings.items()})
    return capsys.readouterr().out.splitlines()


def test_the_worst_is_first_and_what_follows_is_named_after_it(capsys):
    assert shown(capsys, {"a": [SPIKE, ARC, GAIN]}) == [
        "serious (gain): a: The gain is wrong.",
        "note (spikes): a: Spikes on 2 samples.",
        "follows from the above: no arc: a",
        "1 serious finding, 1 note",
    ]


def test_many_of_one_kind_are_counted(capsys):
    names = [f"t{number}" for number in range(IN_FULL + NAMED + 2)]
    lines = shown(capsys, {name: [warning("unit", f"Unit of {name}.")] for name in names})
    assert len(lines) == IN_FULL + 2
    assert lines[IN_FULL] == f"  and {NAMED + 2} more of this kind: {', '.join(names[IN_FULL:-2])} and 2 more"
    assert lines[-1] == f"{len(names)} warnings"


def test_many_tests_that_fail_alike_are_counted(capsys):
    names = [f"t{number:04}" for number in range(2000)]
    failed = [StageRun(name, "ingest", "failed", reason=f"raw/{name}.csv: file not found") for name in names]
    other = StageRun("x", "rocking", "failed", reason="other")
    shown_as.show_failures(RunResult((*failed, other), Path("summary.json"), None), "failed in {}", where="above")
    lines = capsys.readouterr().out.splitlines()
    assert lines[:IN_FULL] == [f"failed in ingest: {name}: raw/{name}.csv: file not found" for name in names[:IN_FULL]]
    named, more = ", ".join(names[IN_FULL : IN_FULL + NAMED]), 2000 - IN_FULL
    counted = f"  and {more} more of this kind: {named} and {more - NAMED} more"
    assert lines[IN_FULL:] == [counted, "failed in rocking: x: other"]


@pytest.mark.parametrize(
    ("findings", "cause"),
    [([GAIN, ARC], "probably because of the serious findings above (gain): "), ([ARC], ""), ([], "")],
    ids=["a serious one", "a warning", "none"],
)
def test_a_failure_names_the_serious_findings(findings, cause):
    assert probable_cause(in_order(findings), where="above") == cause


def test_records_say_what_explains_what():
    records = records_of(in_order([ARC, GAIN]))
    assert [(each.kind, each.explained) for each in records] == [("gain", False), ("no arc", True)]
    assert finding(vars(records[1])) == "warning (follows from the above): No arc was found."
