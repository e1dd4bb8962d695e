"""A campaign of several bodies that MuJoCo moves: how far its truth converges, and what a run measures of it."""

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.laboratory import assemblies
from colonnade.laboratory.runs import with_truth
from colonnade.laboratory.table import ramped_sine
from colonnade.workflow import run

pytest.importorskip("mujoco")

TIME = np.arange(401) / assemblies.RATE
TABLE = ramped_sine(3.0, 3.2, start=0.2, cycles=2, ramp=1)


@pytest.fixture
def recorded(tmp_path, monkeypatch):
    """Write some of the recordings; give the folder and the truth."""

    def write(*recordings):
        monkeypatch.setattr(assemblies, "SHAKEN", {name: assemblies.SHAKEN[name] for name in recordings})
        return assemblies.write_assemblies(tmp_path)

    return write


@pytest.mark.whole
def test_two_blocks_on_one_table_are_two_tests_on_one_file(recorded, tmp_path):
    written = recorded("pair")
    result = run(tmp_path, only=list(written.truth["tests"]), until="compare", workers=1)
    assert not result.failed
    compared = with_truth(written.truth, result.summary)["tests"]
    assert {name: test["outcome"] for name, test in compared.items()} == {
        "pair-slender": "rocking",
        "pair-stout": "no-rocking",
    }
    assert all(test["outcome"] == test["true_outcome"] for test in compared.values())


@pytest.mark.slow
@pytest.mark.parametrize("specimen", ["column", "portal"])
def test_half_the_step_moves_the_bodies_alike_in_the_first_second(recorded, tmp_path, specimen):
    recorded("pair")
    campaign = load(tmp_path)
    whole = campaign.specimens[specimen].assembly(campaign.gravity)
    coarse, fine = (
        assemblies.move(whole, TABLE.acceleration, TIME, step).turned[:, :, :, 2]
        for step in (assemblies.STEP, assemblies.STEP / 2)
    )
    # Their axes: rocking begins at 0.4 s and reaches 0.2 α.
    apart = np.abs(np.arctan2(coarse[..., 0], coarse[..., 2]) - np.arctan2(fine[..., 0], fine[..., 2]))
    assert apart[TIME <= 1.0].max() < 0.01 * min(whole.critical_angles.values())


@pytest.mark.slow
def test_nine_of_ten_outcomes_are_right_and_bodies_are_where_they_stand(tmp_path):
    written = assemblies.write_assemblies(tmp_path, workers=2)
    result = run(tmp_path, workers=2)
    assert not result.failed
    compared = with_truth(written.truth, result.summary)["tests"]
    assert len(compared) == 10
    assert sum(test["outcome"] == test["true_outcome"] for test in compared.values()) >= 9
    moved = {name: (test["moved"], test["true_moved"]) for name, test in compared.items() if "body" in test}
    assert {"column-2", "column-3", "portal-2", "portal-3"} <= moved.keys()
    for name, (measured, true) in moved.items():
        assert measured == pytest.approx(true, abs=2e-4), name
