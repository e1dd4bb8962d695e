"""When a file has arrived, and the line on its test."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.forms import summary
from colonnade.campaign.forms.summary import IdentifiedSummary, PredictionSummary, RestitutionSummary, Warned
from colonnade.findings import Severity
from colonnade.workflow.watching.arrivals import Arrivals
from colonnade.workflow.watching.measure import Line

FILE = Path("raw/free-01.csv")


def mark(size):
    return size, size, 1


@pytest.mark.parametrize(
    ("looks", "finished"),
    [
        ([1, 2, 2], [False, False, True]),
        ([None, None, 1, 1], [False, True, False, True]),
        ([None, 1, 1], [False, False, False]),
    ],
    ids=["written again", "away and back", "away for a moment"],
)
def test_a_file_that_is_known_is_given_again_when_it_has_changed(looks, finished):
    arrivals = Arrivals(settle=1.0)
    arrivals.know({FILE: mark(1)})
    returned = [arrivals.look({FILE: mark(size)} if size else {}, now) for now, size in enumerate(looks)]
    assert returned == [{FILE} if is_given else set() for is_given in finished]


@given(st.lists(st.tuples(st.floats(0.01, 3.0), st.integers(0, 3)), max_size=40))
def test_each_content_is_given_once_and_only_after_it_settled(steps):
    arrivals, now, changed, last, returned, written = Arrivals(settle=1.0), 0.0, 0.0, None, False, 0
    for pause, size in steps:
        now += pause
        if size != last:
            last, changed, returned, written = size, now, False, written + 1
        finished = arrivals.look({FILE: (size, written, 1)}, now)
        if finished:
            assert now - changed >= 1.0
            assert not returned
            returned = True
        assert returned or now - changed < 1.0


KNOWN = RestitutionSummary(value=0.976, low=0.974, high=0.978, level=0.95, source="identified", tests=("a", "b"))


def line(**given):
    rocked = {"status": "done", "kind": "sine", "specimen": "prism", "outcome": "rocking"}
    return Line("sine-07", summary.TestSummary(**rocked | given), KNOWN)


def test_a_sine_says_its_place_on_the_map():
    predicted = {"linear": PredictionSummary(outcome="rocking", peak_ratio=0.44), "contact": PredictionSummary()}
    sine = {"peak_ratio": 0.412, "frequency_ratio": 4.463, "amplitude_ratio": 2.1, "predicted": predicted}
    peaks = "sine-07: rocking 0.412 α; linear 0.440 α; Ω 4.46, A 2.1"
    assert line(**sine).text() == peaks


def test_a_free_vibration_says_its_e_and_that_of_all_or_why_there_is_none():
    own = IdentifiedSummary(value=0.9755, low=0.9735, high=0.9775)
    said = line(kind="free-vibration", restitution=own).text()
    assert said.startswith("sine-07: e 0.976 ± 0.002; prism e 0.976 ± 0.002, identified from 2 free vibrations")
    refused = IdentifiedSummary(reason="too few peaks")
    assert "rocking, no e: too few peaks; prism e" in line(kind="free-vibration", restitution=refused).text()
    failed = line(status="failed", reason="ingest: cut off", outcome=None)
    assert failed.text() == "sine-07: failed: ingest: cut off"


def test_two_findings_are_said_and_others_named_and_notes_are_left_out():
    warnings = [
        Warned(severity=severity, kind=kind, text=f"{kind}.", explained=kind == "follows")
        for severity, *kinds in ((Severity.WARNING, "clipped", "drift", "spikes", "follows"), (Severity.NOTE, "note"))
        for kind in kinds
    ]
    assert "warning: clipped; warning: drift; and spikes" in line(warnings=tuple(warnings)).text()


def test_programs_get_the_record_and_what_is_added():
    said = json.loads(json.dumps(line(outcome="overturned").as_json(), allow_nan=False))
    assert (said["test"], said["outcome"]) == ("sine-07", "overturned")
    assert said["specimen_restitution"]["tests"] == ["a", "b"]
