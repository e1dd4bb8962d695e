"""e and laws of contact on request: one rule for e, whoever asks."""

import pytest

from colonnade.campaign import load
from colonnade.workflow.calibration import calibrate
from colonnade.workflow.maps import Wanted, make_maps

pytestmark = pytest.mark.whole

BODY = 'mass = "26.10 kg"}'
GIVEN = 'mass = "26.10 kg", restitution = 0.93}'


def give(campaign):
    """A law of contact that is found soon, and e."""
    contact = 'contact = {step = "100 us", penetration = 1e-6, damping_fraction = 0.3}'
    campaign.edit("[setups.frame.channels]", f"[processing.predict]\n{contact}\n\n[setups.frame.channels]")
    campaign.edit(BODY, GIVEN)


def test_a_given_restitution_is_known_without_any_run_and_a_stored_law_is_not_found_again(untouched, monkeypatch):
    give(untouched)
    (made,) = calibrate(load(untouched.folder), untouched.layout)
    assert made["restitution"] == 0.93
    monkeypatch.setattr("colonnade.stages.contact.contact", None)
    (again,) = calibrate(load(untouched.folder), untouched.layout)
    assert again == made


def test_a_law_that_cannot_be_found_says_why(untouched):
    give(untouched)
    untouched.edit('step = "100 us"', 'step = "1 ms"')
    (refused,) = calibrate(load(untouched.folder), untouched.layout)
    assert "Use a shorter step or a softer contact" in refused["reason"]
    assert refused["path"] is None


MAP = Wanted(omega=(3.0, 4.0), amplitude=(0.5, 1.5), points=(2, 3), cycles=2.0)


def summarised(small):
    restitution = small.summary()["specimens"]["prism"]["restitution"]
    return restitution["value"], restitution["source"]


def mapped(small):
    (made,) = make_maps(load(small.folder), small.layout, MAP)
    return made.restitution_source


def test_a_given_restitution_that_is_taken_out_again_is_nowhere_used(small):
    identified = summarised(small)
    small.edit(BODY, GIVEN)
    small.run()
    assert summarised(small) == (0.93, "given")
    small.edit(GIVEN, BODY)
    assert mapped(small) == "identified"
    small.run(until="ingest")
    assert summarised(small) == identified
    assert identified[1] == "identified"


def test_a_restitution_that_was_identified_for_another_block_is_not_used(small):
    small.edit('height = "456 mm"', 'height = "400 mm"')
    small.run(until="ingest")
    assert summarised(small)[1] == "rigid-body"
    assert mapped(small) == "rigid-body"
