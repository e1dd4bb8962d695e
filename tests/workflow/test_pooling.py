"""One rule for e, whoever asks: given in the campaign file, else identified, else of the rigid body."""

from __future__ import annotations

from colonnade.workflow.maps.plans import Wanted
from colonnade.workflow.maps.stability import make_maps

BODY = 'mass = "26.10 kg"}'
GIVEN = 'mass = "26.10 kg", restitution = 0.93}'
MAP = Wanted(frequency_ratio=(3.0, 4.0), amplitude_ratio=(0.5, 1.5), points=(2, 3), cycles=2.0)


def summarised(small):
    restitution = small.summary()["specimens"]["prism"]["restitution"]
    return restitution["value"], restitution["source"]


def mapped(small):
    (made,) = make_maps(small.folder, MAP, workers=1)
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
