"""A result over Ω and A is made once, again only if what it is made from changed, and says what it was made from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign import load
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps.plan import plan_map
from colonnade.dynamics.motion import Motion
from colonnade.store import files
from colonnade.store.results import ResultId
from colonnade.workflow.maps.results import bring_up_to_date, given
from prism import PRISM

PLAN = plan_map(PRISM, frequency_ratio=[2.0, 3.0], amplitude_ratio=[1.0, 2.0])
RESULT = ResultId("prism", "map", "linear")


@pytest.fixture
def bring(untouched):
    """Bring a result up to date whose making only leaves a mark among its blocks."""
    campaign, layout = load(untouched.folder), untouched.layout

    def make(folder, key):
        folder.mkdir(parents=True)
        (folder / "block-0.npz").write_bytes(b"")
        assert key
        return xr.Dataset({"lower_limit": ("frequency_ratio", [1.5, 1.6])}, attrs={"settings": "{}"})

    def brought(plan=PLAN, settings=None, make=make):
        return bring_up_to_date(
            campaign, layout, RESULT, plan, settings or {"cycles": 5}, {"restitution_source": "given"}, make
        )

    return brought


def test_what_was_made_is_stored_with_its_attributes_and_without_its_blocks(bring, untouched):
    stored, because = bring()
    assert because == "never run"
    np.testing.assert_array_equal(stored["lower_limit"], [1.5, 1.6])
    assert stored.attrs["restitution_source"] == "given"
    assert stored.attrs.items() <= files.read(untouched.layout.path(RESULT)).attrs.items()
    assert not untouched.layout.blocks(RESULT).exists()


def test_it_is_made_again_only_if_something_changed(bring):
    bring()
    assert bring(make=None)[1] == ""
    assert bring(settings={"cycles": 6})[1] == "settings changed"
    assert bring(settings={"cycles": 6}, make=None)[1] == ""
    assert bring(replace(PLAN, amplitude_ratio=np.array([1.0, 2.5])), {"cycles": 6})[1] == "upstream changed"


def test_blocks_of_a_making_that_was_interrupted_stay(bring, untouched):
    def interrupted(folder, key):
        folder.mkdir(parents=True)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        bring(make=interrupted)
    assert untouched.layout.blocks(RESULT).is_dir()
    assert not untouched.layout.path(RESULT).exists()


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"block": Block.prism(width=0.086, depth=0.086, height=0.457, mass=26.10)}, "block"),
        ({"frequency_ratio": np.array([2.0, 3.1])}, "axes"),
        ({"amplitude_ratio": np.array([1.0, 2.1])}, "axes"),
        ({"motion": Motion(np.array([0.0, 1.0, 0.0]), 0.01)}, "motion"),
    ],
    ids=["a block", "other Ω", "other A", "a recorded motion"],
)
def test_each_thing_that_a_map_is_made_from_has_its_hash(change, name):
    before, after = given(PLAN), given(replace(PLAN, **change))
    assert {key for key in before if before[key] != after[key]} == {name}


def test_a_motion_is_known_by_its_step_too():
    fast, slow = (given(replace(PLAN, motion=Motion(np.array([0.0, 1.0, 0.0]), dt))) for dt in (0.01, 0.02))
    assert fast["motion"] != slow["motion"]
