"""Transducers of other kinds through the whole chain: recorded, conditioned, fused into the motion of the specimen."""

import re
from pathlib import Path

import numpy as np
import pytest

import chain
from colonnade import campaign as campaigns
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.store.description import describe
from prism import PRISM, campaign_of, entry

HALF_WIDTH = 0.043

TURNING = 'quantity = "angular_velocity", unit = "rad/s", on = "specimen"'
MOVING = 'quantity = "displacement", unit = "m", on = "specimen", relative_to = "table"'
SHAKING = 'quantity = "acceleration", unit = "m/s^2"'
CHANNELS = {
    "table": f'{SHAKING}, on = "table", direction = [1, 0, 0]',
    "gyroscope": f"{TURNING}, direction = [0, 1, 0]",
    "turned_gyroscope": f"{TURNING}, direction = [0, -1, 0]",
    "inclinometer": 'quantity = "angle", unit = "rad", on = "specimen", direction = [0, 1, 0]',
    "laser": f'{MOVING}, sensing = "surface", at = [43, 0, 400], direction = [1, 0, 0], normal = [1, 0, 0]',
    "wire": f'{MOVING}, sensing = "wire", at = [-43, 0, 60], direction = [1, 0, 0], anchor = [-300, 0, 60]',
    "left": f"{MOVING}, at = [-43, 0, 0], direction = [0, 0, 1]",
    "right": f"{MOVING}, at = [43, 0, 0], direction = [0, 0, 1]",
    "across": f"{MOVING}, at = [0, 43, 400], direction = [0, 1, 0]",
    "high": f'{SHAKING}, on = "specimen", at = [43, 0, 430], direction = [1, 0, 0]',
    "base_up": f'{SHAKING}, on = "table", direction = [0, 0, -1]',
    "base_across": f'{SHAKING}, on = "table", direction = [0, 1, 0]',
}
"""What each transducer is; places in mm."""

NOISE = {"gyroscope": 2e-3, "turned_gyroscope": 2e-3, "inclinometer": 2e-4, "high": 0.05}


def _moved(time, angle, base):
    """What every transducer would read, from rotation matrices in the plane and differences over time."""
    side = np.where(angle < 0, -1.0, 1.0)
    cosine, sine = np.cos(angle), np.sin(angle)

    def place(x, z):
        arm = x - side * HALF_WIDTH
        return side * HALF_WIDTH + arm * cosine + z * sine, z * cosine - arm * sine

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
        "high": cosine * (base + np.gradient(np.gradient(place(0.043, 0.43)[0], time), time)) - 9.81 * sine,
    }


@pytest.fixture
def measure(tmp_path, request):
    """Measure a motion with some transducers, up to the stage `rocking`; give its result and the error of its angle."""

    def measured(*names, motion="shaken", spoilt=None):
        _, time, angle, base = request.getfixturevalue(motion)
        test, base = ("shake-01", base) if motion == "shaken" else ("free-01", np.zeros_like(time))
        names = ("table", *names)
        wired = "".join(f'{name} = {{column = "{name}", {CHANNELS[name]}}}\n' for name in names)
        wired = re.sub(r"(at|anchor) = \[(\S+), (\S+), (\S+)\]", r'\1 = ["\2 mm", "\3 mm", "\4 mm"]', wired)
        tests = entry("free-01", "free-vibration") + entry("shake-01", "earthquake")
        (tmp_path / "campaign.toml").write_text(campaign_of(wired, tests=tests), encoding="utf-8")
        rng, readings = np.random.default_rng(5), _moved(time, angle, base)
        columns = []
        for name in names:
            values = readings[name] + NOISE.get(name, 2e-5) * rng.standard_normal(time.size)
            columns.append(RecordedChannel(name, None, (spoilt or {}).get(name, 1.0) * values, time))
        recordings = {"main": Recording(Path("kinds.csv"), "delimited", tuple(columns))}
        result = chain.measured(campaigns.load(tmp_path), test, recordings)[1]
        return result, result["rocking_angle"] - np.interp(result["elapsed"], time, angle)

    return measured


def _rms(error):
    """In α."""
    return float(np.sqrt((error**2).mean())) / PRISM.critical_angle


SETS = {
    "a laser": ["laser"],
    "a string pot": ["wire"],
    "an inclinometer": ["inclinometer"],
    "a vertical pair": ["left", "right"],
    "a gyroscope": ["gyroscope"],
    "two gyroscopes, one turned": ["gyroscope", "turned_gyroscope"],
    "all at once": ["laser", "wire", "inclinometer", "left", "right", "across", "gyroscope", "high"],
}


@pytest.mark.parametrize("names", SETS.values(), ids=SETS)
def test_the_angle_under_a_base_motion_and_of_a_free_vibration_is_the_true_one(names, shaken, measure):
    _, time, angle, _ = shaken
    result, error = measure(*names)
    assert _rms(error) < 4e-3
    assert result.attrs["outcome"] == "rocking"
    assert float(result["peak_time"]) == pytest.approx(time[np.argmax(np.abs(angle))], abs=0.01)
    result, error = measure(*names, motion="free_vibration")
    # The release, at 1 s, is a step that the filter rounds.
    assert _rms(error[np.abs(error["elapsed"] - 1.0) > 0.05]) < 4e-3
    assert float(result["peak_ratio"]) == pytest.approx(0.5, abs=0.01)


def test_everything_that_is_written_is_described(shaken, measure):
    result, _ = measure(*SETS["all at once"], "base_up", "base_across")
    described = describe(result, "rocking")
    assert all("long_name" in described[name].attrs for name in described.variables)
    assert {"slide", "uplift", "out_of_plane_angle", "angle_deviation"} <= set(described.variables)
    expected = np.interp(result["elapsed"], shaken[1], shaken[3])
    for name, share in (("base", 1.0), ("vertical_base", 0.3), ("transverse_base", 0.1)):
        np.testing.assert_allclose(result[f"{name}_acceleration"], share * expected, atol=0.02)


def test_a_gyroscope_that_contradicts_the_others_is_left_out_and_said(measure):
    result, error = measure("laser", "gyroscope", spoilt={"gyroscope": -1.0})
    assert "one gyroscope not used" in result.attrs["separation"]
    assert [str(each) for each in result.attrs["warnings"] if "not from gyroscope gyroscope" in str(each)]
    assert _rms(error) < 4e-3
    assert float(result["residual_to_reading"].sel(transducer="gyroscope")) > 1.5
