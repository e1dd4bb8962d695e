"""A newcomer's way on whole folders: draft, fill in what is asked, run, and get what is true."""

import json
import re
import shutil

import pytest

from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from colonnade.laboratory import write_campaign
from colonnade.workflow import run

POINTS = {"lvdt_1": '["43 mm", "0 mm", "440 mm"]', "lvdt_2": '["43 mm", "0 mm", "40 mm"]'}
PRISM = {"width": '"86 mm"', "depth": '"86 mm"', "height": '"456 mm"', "mass": '"26.10 kg"', "relative_to": '"table"'}
GAINS = {"lvdt_1": '"15 mm/V"', "lvdt_2": '"1.5 mm/V"', "tischweg": '"5 mm/V"', "acc": '"0.2 g/V"'}


def filled_in(drafted, answer):
    """Write the draft, each open question answered on its line."""
    lines = drafted.text.splitlines()
    for question in drafted.open:
        owner, _, key = question.key.rpartition(".")
        lines[question.line - 1] = f"{key} = {answer(owner.rpartition('.')[2], key)}"
    drafted.path.write_text("\n".join(lines), encoding="utf-8")
    return drafted.path


@pytest.mark.slow
def test_the_raw_folder_of_the_demo_gives_the_truth_again(tmp_path):
    written = write_campaign(tmp_path / "demo", seed=3)
    (tmp_path / "own").mkdir()
    shutil.copytree(tmp_path / "demo" / "raw", tmp_path / "own" / "raw")

    def answer(owner, key):
        return {"at": POINTS, "gain": GAINS}.get(key, {}).get(owner) or PRISM[key]

    path = filled_in(draft(tmp_path / "own"), answer)
    result = run(path, until="compare", workers=1)
    assert not result.failed
    summary = json.loads(result.summary.read_text(encoding="utf-8"))
    true = written.truth["tests"]
    assert {name: test["outcome"] for name, test in summary["tests"].items()} == {
        name: test["outcome"] for name, test in true.items()
    }
    restitution = summary["specimens"]["specimen"]["restitution"]
    assert restitution["low"] <= 0.976 <= restitution["high"]


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
    assert [test.kind for test in load(path).tests.values()] == ["earthquake", "sine", "other", "sine"]
    result = run(path, until="rocking", workers=1)
    refused = {stage.subject: stage.reason for stage in result.stages if stage.action == "failed"}
    assert refused.keys() <= {"grashorn_testingData"}  # of which "other" was answered for both columns
    assert all(re.search("usable", reason) for reason in refused.values())
