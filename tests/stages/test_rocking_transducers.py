"""Transducers of other kinds through the whole chain: recorded, conditioned, fused into the motion of the specimen."""

from pathlib import Path

import numpy as np
import pytest

import chain
from colonnade import campaign as campaigns
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.store.description import describe
from prism import PRISM

HALF_WIDTH = 0.043

HEAD = """
schema = 1
campaign = "kinds"
title = "Kinds"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame.channels]
table = {column = "table", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}
"""
TESTS = """
[[tests]]
id = "free-01"
kind = "free-vibration"
specimen = "prism"
setup = "frame"
file = "free.csv"

[[tests]]
id = "shake-01"
kind = "earthquake"
specimen = "prism"
setup = "frame"
file = "shake.csv"
"""
DISPLACEMENT = 'quantity = "displacement", unit = "m", on = "specimen", relative_to = "table"'
CHANNELS = {
    "gyroscope": 'quantity = "angular_velocity", unit = "rad/s", on = "specimen", direction = [0, 1, 0]',
    "turned_gyroscope": 'quantity = "angular_velocity", unit = "rad/s", on = "specimen", direction = [0, -1, 0]',
    "inclinometer": 'quantity = "angle", unit = "rad", on = "specimen", direction = [0, 1, 0]',
    "laser": f'{DISPLACEMENT}, sensing = "surface", at = ["43 mm", "0 mm", "400 mm"], direction = [1, 0, 0], '
    "normal = [1, 0, 0]",
    "wire": f'{DISPLACEMENT}, sensing = "wire", at = ["-43 mm", "0 mm", "60 mm"], direction = [1, 0, 0], '
    'anchor = ["-300 mm", "0 mm", "60 mm"]',
    "left": f'{DISPLACEMENT}, at = ["-43 mm", "0 mm", "0 mm"], direction = [0, 0, 1]',
    "right": f'{DISPLACEMENT}, at = ["43 mm", "0 mm", "0 mm"], direction = [0, 0, 1]',
    "across": f'{DISPLACEMENT}, at = ["0 mm", "43 mm", "400 mm"], direction = [0, 1, 0]',
    "high": 'quantity = "acceleration", unit = "m/s^2", on = "specimen", at = ["43 mm", "0 mm", "430 mm"], '
    "direction = [1, 0, 0]",
    "low": 'quantity = "acceleration", unit = "m/s^2", on = "specimen", at = ["43 mm", "0 mm", "50 mm"], '
    "direction = [1, 0, 0]",
    "upwards": 'quantity = "acceleration", unit = "m/s^2", on = "specimen", at = ["0 mm", "0 mm", "456 mm"], '
    "direction = [0, 0, 1]",
    "base_up": 'quantity = "acceleration", unit = "m/s^2", on = "table", direction = [0, 0, -1]',
    "base_across": 'quantity = "acceleration", unit = "m/s^2", on = "table", direction = [0, 1, 0]',
}
NOISE = {"gyroscope": 2e-3, "turned_gyroscope": 2e-3, "inclinometer": 2e-4, "high": 0.05, "low": 0.05, "upwards": 0.05}


def _moved(time, angle, base, slide):
    """What every transducer would read, from rotation matrices in the plane and differences over time."""
    side = np.where(angle < 0, -1.0, 1.0)
    cosine, sine = np.cos(angle), np.sin(angle)

    def place(x, z):
        arm = x - side * HALF_WIDTH
        return side * HALF_WIDTH + slide + arm * cosine + z * sine, z * cosine - arm * sine

    def sensed(x, z, along):
        horizontal, vertical = (np.gradient(np.gradient(each, time), time) for each in place(x, z))
        horizontal, vertical = horizontal + base, vertical + 9.81
        return cosine * horizontal - sine * vertical if along == "x" else sine * horizontal + cosine * vertical

    face_x, face_z = place(0.043, 0.4)
    pin_x, pin_z = place(-0.043, 0.06)
    return {
        "table": base,
        "gyroscope": np.gradient(angle, time),
        "turned_gyroscope": -np.gradient(angle, time),
        "inclinometer": angle,
        "laser": face_x + (face_z - 0.4) * np.tan(angle) * -1.0 - 0.043,
        "wire": np.hypot(pin_x + 0.3, pin_z - 0.06) - (0.3 - 0.043),
        "left": place(-0.043, 0.0)[1],
        "right": place(0.043, 0.0)[1],
        "across": np.zeros_like(angle),
        "base_up": -0.3 * base,
        "base_across": 0.1 * base,
        "high": sensed(0.043, 0.43, "x"),
        "low": sensed(0.043, 0.05, "x"),
        "upwards": sensed(0.0, 0.456, "z"),
    }


@pytest.fixture
def measure(tmp_path):
    """Measure a motion with some transducers, and take it through all stages up to rocking."""

    def measured(names, time, angle, *, base=None, test="shake-01", slide=0.0, lost=(), spoilt=None):
        wired = "".join(f'{name} = {{column = "{name}", {CHANNELS[name]}}}\n' for name in names)
        path = tmp_path / "campaign.toml"
        path.write_text(HEAD + wired + TESTS, encoding="utf-8")
        campaign = campaigns.load(path)
        rng = np.random.default_rng(5)
        readings = _moved(time, angle, np.zeros_like(time) if base is None else base, slide)
        columns = []
        for name in ("table", *names):
            values = readings[name] + NOISE.get(name, 2e-5) * rng.standard_normal(time.size)
            values[np.isin(np.arange(time.size), lost) & (name in CHANNELS)] = np.nan
            columns.append(RecordedChannel(name, None, (spoilt or {}).get(name, 1.0) * values, time))
        recordings = {"main": Recording(Path("kinds.csv"), "delimited", tuple(columns))}
        return chain.measured(campaign, test, recordings)[1]

    return measured


def _error(result, time, angle):
    return result["rocking_angle"].to_numpy() - np.interp(result["elapsed"], time, angle)


SETS = {
    "a laser": ["laser"],
    "a string pot": ["wire"],
    "a laser and a string pot": ["laser", "wire"],
    "an inclinometer": ["inclinometer"],
    "a vertical pair": ["left", "right"],
    "a gyroscope": ["gyroscope"],
    "two gyroscopes, one turned": ["gyroscope", "turned_gyroscope"],
    "a laser and a gyroscope": ["laser", "gyroscope"],
    "all at once": ["laser", "wire", "inclinometer", "left", "right", "across", "gyroscope", "high", "low", "upwards"],
}


@pytest.mark.parametrize("names", SETS.values(), ids=SETS)
def test_the_angle_under_a_base_motion_is_the_true_one(names, shaken, measure):
    _, time, angle, base = shaken
    result = measure(names, time, angle, base=base)
    assert np.sqrt(np.nanmean(_error(result, time, angle) ** 2)) < 4e-3 * PRISM.critical_angle
    assert result.attrs["outcome"] == "rocking"
    assert float(result["peak_time"]) == pytest.approx(time[np.argmax(np.abs(angle))], abs=0.01)


@pytest.mark.parametrize("names", SETS.values(), ids=SETS)
def test_the_angle_of_a_free_vibration_is_the_true_one(names, free_vibration, measure):
    _, time, angle, _ = free_vibration
    result = measure(names, time, angle, test="free-01")
    away = np.abs(time - 1.0) > 0.05  # the release is a step that the filter rounds
    assert np.sqrt(np.nanmean(_error(result, time, angle)[away] ** 2)) < 4e-3 * PRISM.critical_angle
    assert float(result["peak_ratio"]) == pytest.approx(0.5, abs=0.01)


def test_a_gyroscope_alone_says_how_its_error_grows(free_vibration, measure):
    _, time, angle, _ = free_vibration
    result = measure(["gyroscope"], time, angle, test="free-01")
    deviation = result["angle_deviation"].to_numpy()
    assert deviation[0] > 3 * deviation[-1]
    assert np.mean(np.abs(_error(result, time, angle)) < 3 * deviation) > 0.95
    assert "standard error grows to" in result.attrs["separation"]
    assert "slide and uplift are not measured" in result.attrs["separation"]


def test_a_gyroscope_alone_gives_the_restitution(free_vibration, measure):
    _, time, angle, restitution = free_vibration
    result = measure(["gyroscope"], time, angle, test="free-01")
    found = identify_restitution(
        result["elapsed"].to_numpy(),
        result["rocking_angle"].to_numpy(),
        PRISM,
        noise=float(result["rocking_angle_standard_error"]),
    )
    assert found.value == pytest.approx(restitution, abs=2e-3)


def test_everything_that_is_written_is_described(shaken, measure):
    _, time, angle, base = shaken
    names = [*SETS["all at once"], "base_up", "base_across"]
    described = describe(measure(names, time, angle, base=base), "rocking")
    assert all("long_name" in described[name].attrs for name in described.variables)
    assert {"slide", "uplift", "out_of_plane_angle", "angle_deviation"} <= set(described.variables)


def test_accelerometers_alone_give_the_angle_within_their_standard_error(shaken, measure):
    _, time, angle, base = shaken
    result = measure(["high", "low"], time, angle, base=base)
    error = _error(result, time, angle)
    assert np.mean(np.abs(error) < 3 * result["angle_deviation"].to_numpy()) > 0.95
    assert np.sqrt(np.mean(error**2)) < 0.05 * PRISM.critical_angle
    assert "slide cannot be separated from tilt" in result.attrs["separation"]


def test_one_accelerometer_alone_gives_no_angle_and_costs_no_prediction(shaken, measure):
    _, time, angle, base = shaken
    result = measure(["high"], time, angle, base=base)
    assert "rocking_angle" not in result
    assert float(np.abs(result["base_acceleration"]).max()) == pytest.approx(np.abs(base).max(), rel=0.05)
    (told,) = result.attrs["warnings"]
    assert told.severity == "warning"
    assert "Place two along x at different heights (channels high)" in told.text
    assert "Predictions continue" in told.text


def test_slide_uplift_and_the_rest_are_written_where_they_are_separated(shaken, measure):
    _, time, angle, base = shaken
    slide = 0.003 * np.clip(time - 3, 0, 1)
    result = measure(["laser", "wire", "left", "right", "across"], time, angle, base=base, slide=slide)
    np.testing.assert_allclose(result["slide"], np.interp(result["elapsed"], time, slide), atol=3e-4)
    np.testing.assert_allclose(result["uplift"], 0.0, atol=3e-4)
    np.testing.assert_allclose(result["out_of_plane_angle"], 0.0, atol=3e-4)
    assert "yaw" not in result
    assert float(result["uplift_standard_error"]) < 1e-4
    assert "transverse slide cannot be separated" in result.attrs["separation"]


def test_residuals_tell_which_transducer_disagrees(shaken, measure):
    _, time, angle, base = shaken
    names = ["laser", "wire", "inclinometer", "high", "gyroscope"]
    fine = measure(names, time, angle, base=base)
    spoilt = measure(names, time, angle, base=base, spoilt={"high": -1.0})
    assert fine["transducer"].to_numpy().tolist() == ["inclinometer", "laser", "wire", "gyroscope", "high"]
    of_high = [float(each["residual_to_reading"].sel(transducer="high")) for each in (fine, spoilt)]
    assert of_high[0] < 0.35
    assert of_high[1] > 1.5


def test_a_gyroscope_that_contradicts_the_others_is_left_out_and_said(shaken, measure):
    _, time, angle, base = shaken
    result = measure(["laser", "gyroscope"], time, angle, base=base, spoilt={"gyroscope": -1.0})
    assert "one gyroscope not used" in result.attrs["separation"]
    assert [str(each) for each in result.attrs["warnings"] if "not from gyroscope gyroscope" in str(each)]
    assert np.sqrt(np.nanmean(_error(result, time, angle) ** 2)) < 4e-3 * PRISM.critical_angle
    assert float(result["residual_to_reading"].sel(transducer="gyroscope")) > 1.5


def test_a_transducer_that_is_only_compared_does_not_spoil_the_quality_of_the_angle(shaken, measure):
    _, time, angle, base = shaken
    result = measure(["laser", "high"], time, angle, base=base, spoilt={"high": 0.0})
    assert (result["rocking_angle_quality"] == 1).mean() > 0.99


def test_positions_that_do_not_see_the_rotation_leave_it_to_the_gyroscope_and_are_said(shaken, measure):
    _, time, angle, base = shaken
    result = measure(["across", "gyroscope"], time, angle, base=base)
    assert np.sqrt(np.nanmean(_error(result, time, angle) ** 2)) < 4e-3 * PRISM.critical_angle
    assert (
        "the displacement transducers are not used: No transducer measures the rotation" in result.attrs["separation"]
    )


def test_the_base_motion_along_every_axis_is_written(shaken, measure):
    _, time, angle, base = shaken
    result = measure(["laser", "base_up", "base_across"], time, angle, base=base)
    expected = np.interp(result["elapsed"], time, base)
    np.testing.assert_allclose(result["base_acceleration"], expected, atol=0.02)
    np.testing.assert_allclose(result["vertical_base_acceleration"], 0.3 * expected, atol=0.02)
    np.testing.assert_allclose(result["transverse_base_acceleration"], 0.1 * expected, atol=0.02)
