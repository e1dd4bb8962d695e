"""A newcomer's way on whole folders: draft, fill in what is asked, run, and get what is true."""

import re
import shutil

import pytest

from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from colonnade.workflow import run
from filling_in import filled_in

PRISM = {"width": '"86 mm"', "depth": '"86 mm"', "height": '"456 mm"', "mass": '"26.10 kg"', "relative_to": '"table"'}


@pytest.mark.whole
def test_the_shake_table_recordings_of_others_run(shared_data, tmp_path):
    shutil.copytree(shared_data / "shaketable", tmp_path / "table", copy_function=shutil.copyfile)
    drafted = draft(tmp_path / "table")
    assert drafted.refused == ()

    def answer(owner, key):
        if key in PRISM and owner == "specimen":
            return PRISM[key]
        if key == "quantity":
            return '"acceleration"' if owner == "column_1" else '"other"'
        return {"sampling_rate": '"100 Hz"', "unit": '"m/s^2"', "on": '"table"'}[key]

    path = filled_in(drafted, answer)
    assert [test.kind for test in load(path).tests.values()] == ["earthquake", "sine", "other", "other"]
    result = run(path, until="rocking", workers=1)
    refused = {stage.subject: stage.reason for stage in result.stages if stage.action == "failed"}
    assert refused.keys() <= {"grashorn_testingData"}  # of which "other" was answered for both columns
    assert all(re.search("usable", reason) for reason in refused.values())
