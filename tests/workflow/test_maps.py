"""A campaign's maps: from what is known of a specimen, in blocks that outlast a kill, the same whatever the workers."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.maps.chart import stability_map
from colonnade.errors import CampaignError, StoreError
from colonnade.store import files
from colonnade.workflow.map_plans import Wanted, measured_points
from colonnade.workflow.maps import as_map, make_maps

BLOCK = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
FEW = Wanted(frequency_ratio=(2.0, 5.0), amplitude_ratio=(0.8, 2.0), points=(6, 10), cycles=5.0)


def made(small, wanted=FEW, **options):
    (only,) = make_maps(small.folder, wanted, **({"workers": 1} | options))
    return only


def content(small, **options):
    return files.read(made(small, **options).path).attrs["content"]


def test_a_map_takes_the_identified_restitution_and_is_that_of_the_library(small):
    result = made(small)
    assert (result.restitution_source, result.action) == ("identified", "done")
    stored = as_map(files.read(result.path))
    pooled = files.read(small.layout.specimen("prism"))
    e = tuple(float(value) for value in pooled["side_restitution"])
    expected = stability_map(
        BLOCK,
        restitution=e,
        frequency_ratio=np.linspace(2.0, 5.0, 6),
        amplitude_ratio=np.linspace(0.8, 2.0, 10),
        cycles=5.0,
    )
    for name in ("outcome", "overturning_fraction", "no_rocking", "lower", "upper", "interval_start", "interval_end"):
        np.testing.assert_array_equal(getattr(stored, name), getattr(expected, name), err_msg=name)
    assert stored.options == expected.options


def test_several_processes_give_the_same_bit_for_bit(small):
    alone = content(small)
    small.layout.map("prism", "linear").unlink()
    assert content(small, workers=2) == alone


def test_a_map_that_is_there_is_not_made_again_until_something_changes(small):
    assert made(small).action == "done"
    assert made(small).action == "up-to-date"
    assert made(small, Wanted(**(vars(FEW) | {"ramp": 1.0}))).action == "done"
    small.edit('height = "456 mm"', 'height = "460 mm"')
    assert made(small, Wanted(**(vars(FEW) | {"ramp": 1.0}))).action == "done"


def test_a_campaign_that_was_never_run_takes_the_rigid_body_and_has_no_points(untouched):
    result = made(untouched)
    assert (result.restitution_source, result.measured) == ("rigid-body", 0)


def test_sine_tests_of_the_summary_stand_on_the_map_and_widen_it(small):
    summary = small.summary()
    summary["tests"]["pulse-01"] |= {"frequency_ratio": 6.0, "amplitude_ratio": 4.0, "outcome": "overturned"}
    summary["tests"]["pulse-02"] |= {"frequency_ratio": 3.0, "amplitude_ratio": None, "outcome": "rocking"}
    small.layout.summary_json.write_text(json.dumps(summary), encoding="utf-8")
    (point,) = measured_points(small.layout, "prism")
    assert (point.test, point.frequency_ratio, point.amplitude_ratio, point.outcome) == (
        "pulse-01",
        6.0,
        4.0,
        "overturned",
    )
    assert measured_points(small.layout, "another") == []
    result = made(small, Wanted(points=(3, 4), cycles=2.0))
    chart = as_map(files.read(result.path))
    assert chart.frequency_ratio[0] < 6.0 < chart.frequency_ratio[-1]
    assert chart.amplitude_ratio[0] < 4.0 < chart.amplitude_ratio[-1]
    assert result.measured == 1


@pytest.mark.parametrize(
    ("wanted", "specimens", "found"),
    [
        (FEW, ("prysm",), 'no specimen "prysm".*Did you mean "prism"'),
        (Wanted(frequency_ratio=(3.0, 2.0)), (), "frequency_ratio has to be positive, finite and increasing"),
        (Wanted(cycles=0.0), (), "at least one cycle"),
        (Wanted(motion="pulse-99"), (), 'no test "pulse-99"'),
        (Wanted(motion="pulse-01"), (), "pulse-01: its table motion cannot be stretched"),
    ],
    ids=["an unknown specimen", "a range backwards", "no cycle", "an unknown test", "a test that is no sine"],
)
def test_what_cannot_be_mapped_is_told(small, wanted, specimens, found):
    with pytest.raises(CampaignError, match=found):
        make_maps(small.folder, wanted, specimens=specimens, workers=1)


def test_a_map_waits_for_no_run_but_says_that_one_is_under_way(small):
    from colonnade.workflow.lock import only_run

    with only_run(small.layout), pytest.raises(StoreError, match="being run already"):
        made(small)


MAP = """
import sys
from colonnade.workflow.map_plans import Wanted
from colonnade.workflow.maps import make_maps
wanted = Wanted(frequency_ratio=(2.0, 5.0), amplitude_ratio=(0.8, 2.0), points=(60, 10), cycles=5.0)
def told(done, total):
    print(done, flush=True)
make_maps(sys.argv[1], wanted, workers=1, progress=told)
"""


def test_a_map_that_is_killed_goes_on_where_it_was_and_leaves_nothing_behind(small):
    process = subprocess.Popen([sys.executable, "-c", MAP, str(small.folder)], stdout=subprocess.PIPE, text=True)
    while process.stdout.readline().strip() not in ("3", ""):
        pass
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    process.stdout.close()
    assert not small.layout.map("prism", "linear").exists()
    wanted = Wanted(**(vars(FEW) | {"points": (60, 10)}))
    told = []
    result = made(small, wanted, progress=lambda *state: told.append(state))
    assert 3 <= told[0][0] < 60
    again = files.read(result.path).attrs["content"]
    assert not small.layout.map_blocks("prism", "linear").exists()
    result.path.unlink()
    assert files.read(made(small, wanted).path).attrs["content"] == again
