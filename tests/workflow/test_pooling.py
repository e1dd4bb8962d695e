"""One rule for e, whoever asks: given in the campaign file, else identified, else of the rigid body."""

from __future__ import annotations

import pytest

from colonnade.store import files
from colonnade.workflow.maps.plans import Wanted
from colonnade.workflow.maps.stability import make_maps
from colonnade.workflow.pooling import restitution_taken

BODY = 'mass = "26.10 kg"}'
GIVEN = 'mass = "26.10 kg", restitution = 0.93}'
MAP = Wanted(frequency_ratio=(3.0, 4.0), amplitude_ratio=(0.5, 1.5), points=(2, 3), cycles=2.0)
RIGID_BODY = 0.94848


def summarised(small):
    restitution = small.summary()["specimens"]["prism"]["restitution"]
    return restitution["value"], restitution["source"]


def mapped(small):
    (made,) = make_maps(small.folder, MAP, workers=1)
    return made.restitution_source


def test_a_given_restitution_is_in_the_summary_before_any_stage_used_it(untouched):
    untouched.edit(BODY, GIVEN)
    untouched.run(until="ingest")
    assert summarised(untouched) == (0.93, "given")
    assert mapped(untouched) == "given"


def test_without_a_given_one_the_rigid_body_serves_until_one_is_identified(untouched):
    untouched.run(until="ingest")
    value, source = summarised(untouched)
    assert (value, source) == (pytest.approx(RIGID_BODY, abs=1e-5), "rigid-body")
    assert mapped(untouched) == "rigid-body"


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


def test_a_given_restitution_comes_before_an_identified_one_that_is_stored(small):
    small.edit(BODY, GIVEN)
    assert mapped(small) == "given"
    small.run(until="ingest")
    assert summarised(small) == (0.93, "given")


def test_a_restitution_that_was_identified_for_another_block_is_not_used(small):
    small.edit('height = "456 mm"', 'height = "400 mm"')
    small.run(until="ingest")
    assert summarised(small)[1] == "rigid-body"
    assert mapped(small) == "rigid-body"


def test_what_is_stored_is_what_the_rule_gives(small):
    from colonnade.campaign import load

    stored = files.read(small.layout.stage("prism", "specimen"))
    again = restitution_taken(load(small.folder), small.layout, "prism")
    assert again.attrs.items() <= stored.attrs.items()
    assert all(again[name].equals(stored[name].astype(again[name].dtype)) for name in again.variables)
