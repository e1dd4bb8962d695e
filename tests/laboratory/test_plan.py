"""A plan and its campaign file: loaded back as planned, with a file for each recorder; whose folder it may write to."""

import numpy as np
import pytest

from colonnade.campaign import FILE_NAME, load
from colonnade.campaign.channel import MAIN
from colonnade.errors import CampaignError
from colonnade.laboratory.files import TDMS
from colonnade.laboratory.plan import MARK, TESTS_A_DAY, Plan, Recorder, Trial, begun, claim

HEAD = """
schema = 1
campaign = "virtual-1"
title = 'A "title"'

[specimens]
"prism.a" = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame]
catch = "0.28 rad"

[setups.frame.recorders.daq2]

[setups.frame.channels]
low = {column = "LVDT", quantity = "displacement", unit = "mm", on = "table", direction = [1, 0, 0]}
"""


def plan():
    shaken = Trial("span-2.0", "earthquake", "frame", 9.0, entry={"span": 2.0, "motion": 'the "big" one'})
    recorders = {MAIN: Recorder(200.0), "daq2": Recorder(400.0, TDMS, late=0.3)}
    return Plan(HEAD, {"prism.a": 0.93}, {"frame": recorders}, (shaken,))


def test_it_is_loaded_as_it_was_planned(tmp_path):
    (tmp_path / FILE_NAME).write_text(plan().campaign_text(), encoding="utf-8")
    test = load(tmp_path).tests["span-2.0"]
    assert (test.kind, test.span, test.motion, test.specimen) == ("earthquake", 2.0, 'the "big" one', "prism.a")
    assert {name: path.name for name, path in test.files.items()} == {
        MAIN: "span-2.0.csv",
        "daq2": "span-2.0-daq2.tdms",
    }


@pytest.mark.parametrize("content", ["schema = 1\n", ""], ids=["of a laboratory", "empty"])
def test_a_campaign_file_of_another_hand_is_not_replaced(tmp_path, content):
    claim(tmp_path)
    path = tmp_path / FILE_NAME
    path.write_text(content, encoding="utf-8")
    with pytest.raises(CampaignError, match="was not written by the virtual laboratory and was not changed"):
        claim(tmp_path)
    assert plan().campaign_text().startswith(MARK)
    path.write_text(plan().campaign_text(), encoding="utf-8")
    claim(tmp_path)


def test_tests_follow_each_other_on_working_days_between_nine_and_four():
    moments = [begun(position) for position in range(10 * TESTS_A_DAY)]
    assert moments == sorted(set(moments))
    assert len({moment.date() for moment in moments}) == 10
    assert np.is_busday([moment.date() for moment in moments]).all()
    assert {moment.hour for moment in moments} == set(range(9, 16))
