"""Recordings that other laboratories published: one with a measured specimen, and a folder as a newcomer drafts it."""

import re
import shutil

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from colonnade.workflow import run
from filling_in import filled_in

pytestmark = pytest.mark.whole

WOODEN_BLOCK = """
schema = 1
campaign = "wooden-block"
title = "Shake table with a block on it"
[specimens.statue]
shape = "measured"
mass = "80 kg"
pole_distance = "610 mm"
critical_angle = "0.21 rad"
inertia = "41.2 kg m^2"
restitution = 0.9
[setups.table.channels]
drive = {column = "Output To Table", quantity = "other", unit = "V"}
light = {column = "LED Light", quantity = "other"}
table = {column = "Table accel XXXX", quantity = "acceleration", unit = "g's", on = "table", direction = [1, 0, 0]}
block = {column = 5, quantity = "acceleration", unit = "g's", on = "specimen", direction = [1, 0, 0]}

[[tests]]
id = "sine-2Hz"
kind = "sine"
frequency = "2 Hz"
specimen = "statue"
setup = "table"
file = "raw/thadhaines_01.csv"
zero = ["3.75 s", "6.15 s"]
observed_outcome = "no-rocking"
"""


@pytest.fixture(scope="module")
def wooden_block(shared_data, tmp_path_factory, run_campaign):
    folder = tmp_path_factory.mktemp("other")
    (folder / "raw").mkdir()
    shutil.copy(shared_data / "shaketable" / "thadhaines_01.csv", folder / "raw")
    (folder / "campaign.toml").write_text(WOODEN_BLOCK, encoding="utf-8")
    return run_campaign(folder / "campaign.toml")


def test_the_shake_table_recording_has_its_published_figures(wooden_block):
    recorded = wooden_block.result("sine-2Hz", "ingest")
    assert recorded.sizes["elapsed"] == pytest.approx(9000, abs=2)
    assert float(np.diff(recorded["elapsed"]).mean()) == pytest.approx(1e-3, rel=1e-6)
    table = recorded["table_recorded"].to_numpy()
    assert np.percentile(np.abs(table), 99) == pytest.approx(0.35, abs=0.1)  # ± 0.35 g
    dark = recorded["elapsed"].to_numpy()[recorded["light_recorded"].to_numpy() < 1.0]
    assert (dark.min(), dark.max()) == pytest.approx((3.731, 6.189), abs=2e-3)  # the sync light is off
    assert float(np.std(recorded["block_recorded"])) == pytest.approx(0.006, abs=0.001)


def test_the_dead_channel_is_flagged_and_told(wooden_block):
    recorded = wooden_block.result("sine-2Hz", "ingest")
    assert (recorded["block_quality"].to_numpy() == 3).all()
    assert any(
        "block" in warning["text"] and "practically dead" in warning["text"]
        for warning in wooden_block.test("sine-2Hz")["warnings"]
    )


def test_the_linear_model_runs_on_the_recorded_table_motion(wooden_block):
    test = wooden_block.test("sine-2Hz")
    assert test["status"] == "done"
    assert test["predicted"]["linear"]["outcome"] in ("no-rocking", "rocking", "overturned")
    assert 2.5 < test["pga"] < 6.0
    predicted = wooden_block.result("sine-2Hz", "predict", "linear")
    np.testing.assert_allclose(
        predicted["base_acceleration"], wooden_block.result("sine-2Hz", "rocking")["base_acceleration"]
    )
    assert wooden_block.summary["specimens"]["statue"]["restitution"]["source"] == "given"


ANSWERS = {"width": '"86 mm"', "depth": '"86 mm"', "height": '"456 mm"', "mass": '"26.10 kg"', "relative_to": '"table"'}


def test_the_shake_table_recordings_of_others_run(shared_data, tmp_path):
    shutil.copytree(shared_data / "shaketable", tmp_path / "table", copy_function=shutil.copyfile)
    drafted = draft(tmp_path / "table")
    assert drafted.refused == ()

    def answer(owner, key):
        if key in ANSWERS and owner == "specimen":
            return ANSWERS[key]
        if key == "quantity":
            return '"acceleration"' if owner == "column_1" else '"other"'
        return {"sampling_rate": '"100 Hz"', "unit": '"m/s^2"', "on": '"table"'}[key]

    path = filled_in(drafted, answer)
    assert [test.kind for test in load(path).tests.values()] == ["earthquake", "sine", "other", "other"]
    result = run(path, until="rocking", workers=1)
    refused = {stage.subject: stage.reason for stage in result.stages if stage.action == "failed"}
    assert refused.keys() <= {"grashorn_testingData"}  # of which "other" was answered for both columns
    assert all(re.search("usable", reason) for reason in refused.values())
