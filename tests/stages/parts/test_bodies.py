"""The bodies of a column as an optical system saw them, against how they really moved."""

import numpy as np
import pytest

import drums
from colonnade.campaign import load
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow import run

pytestmark = pytest.mark.whole


@pytest.fixture(scope="module")
def column(shaken_drums):
    """The history of a column, and what a run of its campaign made of the recording."""
    history, folder = shaken_drums
    results = {
        stage: files.read(Layout(load(folder).folder).stage("quake", *stage))
        for stage in (("rocking",), ("predict", "contact"))
    }
    return history, results[("rocking",)], results["predict", "contact"]


def centre(history, name):
    """Displacement of the centre of the base of a body, m, by its quaternions."""
    from scipy.spatial.transform import Rotation

    body, placed = history.bodies[name], history.assembly.bodies[name]
    arm = Rotation.from_quat(body.orientation, scalar_first=True).apply([0.0, 0.0, -placed.centre_height])
    return body.position + arm - np.append(placed.position, history.assembly.levels[name])


@pytest.mark.parametrize("name", ["1", "2", "3"])
def test_each_body_is_measured_as_it_moved(column, name):
    history, measured, _ = column
    body, place = history.bodies[name], list(history.bodies).index(name)
    # 25 Hz of the low-pass and 20 µm of noise.
    for variable, true, allowed in (
        ("body_angle", body.angle, 5e-4),
        ("body_joint_angle", body.relative.angle, 6e-4),
        ("body_yaw", body.yaw, 2e-4),
        ("body_uplift", body.uplift, 1e-4),
        ("body_transverse_slide", centre(history, name)[:, 1], 1e-4),
    ):
        off = measured[variable].to_numpy()[place] - true
        assert np.sqrt(np.nanmean(off**2)) < allowed, variable
    for axis, key in enumerate("xy"):
        left = float(measured[f"body_residual_{key}"][place])
        assert left == pytest.approx(centre(history, name)[-101:, axis].mean(), abs=5e-5)
    assert float(measured["body_residual_yaw"][place]) == pytest.approx(body.yaw[-101:].mean(), abs=2e-4)


def test_joints_say_when_and_how_far_they_opened(column):
    history, measured, _ = column
    for place, body in enumerate(history.bodies.values()):
        width = 0.2
        assert float(measured["body_opening"][place]) == pytest.approx(
            width * np.abs(body.relative.angle).max(), rel=0.02, abs=2e-4
        )
    assert measured["body_opening_time"].to_numpy()[0] == pytest.approx(0.55, abs=0.06)
    assert list(measured["body_outcome"].to_numpy()) == ["rocking"] * 3
    assert measured.attrs["outcome"] == history.outcome


def test_the_contact_model_moves_the_bodies_on_the_recorded_motion(column):
    history, _, predicted = column
    assert predicted.attrs["outcome"] == history.outcome
    assert float(predicted["peak_ratio"]) == pytest.approx(history.peak_ratio, abs=0.01)
    first = predicted["elapsed"].to_numpy() < 1.3  # the motion as recorded differs by its noise
    for place, body in enumerate(history.bodies.values()):
        off = predicted["body_angle"].to_numpy()[place] - body.angle
        assert np.abs(off[first]).max() < 0.02 * 0.32


def test_a_body_without_markers_is_named_and_the_others_are_measured(tmp_path, column):
    history = column[0]
    drums.write_campaign(tmp_path, history)
    text = (tmp_path / "campaign.toml").read_text().splitlines()
    (tmp_path / "campaign.toml").write_text("\n".join(line for line in text if not line.startswith("m2")))
    done = run(tmp_path, until="rocking", workers=1)
    measured = files.read(Layout(tmp_path).stage("quake", "rocking"))
    assert list(measured["body_outcome"].to_numpy()) == ["rocking", "", ""]
    assert np.isfinite(measured["body_angle"].to_numpy()[2]).any()  # relative to the table it is known
    assert any("2: no transducer on it" in each.text for every in done.findings.values() for each, _ in every)


def test_what_stands_on_a_body_that_fell_has_fallen(tmp_path):
    history = drums.write_campaign(tmp_path, strength=4.5)
    assert history.overturned_bodies == ("1", "2", "3")
    done = run(tmp_path, until="rocking", workers=1)
    assert [each.text for found in done.findings.values() for each, _ in found] == []  # no marker tore off
    measured = files.read(Layout(tmp_path).stage("quake", "rocking"))
    assert list(measured["body_outcome"].to_numpy()) == ["overturned"] * 3
    assert measured.attrs["outcome"] == "overturned"


def test_runs_of_the_contact_model_say_how_probably_a_body_falls_and_how_far_it_moves(tmp_path):
    history = drums.write_campaign(tmp_path, strength=6.0)
    path = tmp_path / "campaign.toml"
    path.write_text(path.read_text().replace("members = 0", "members = 2"))
    assert not run(tmp_path, until="compare", workers=1).failed
    bands = files.read(Layout(tmp_path).stage("quake", "ensemble", "contact"))
    falls = bands["body_overturning_probability"].to_numpy()
    assert list(bands["body"].to_numpy()) == list(history.bodies)
    assert (np.diff(falls) >= 0).all()  # what stands on what falls has fallen
    assert float(bands["overturning_probability"]) == falls.max()
    moved = bands["body_moved_band"].to_numpy()
    assert (np.diff(moved[:, falls < 1], axis=0) >= 0).all()
    compared = files.read(Layout(tmp_path).stage("quake", "compare"))
    assert 0.5 < float(compared["horizon"][0]) <= 4.0
