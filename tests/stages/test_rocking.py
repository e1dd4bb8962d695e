"""The motion of the specimen and of its base, from displacement transducers and from those of other kinds."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import chain
from chain import changed, conditioned
from colonnade import campaign as campaigns
from colonnade.errors import StageError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.stages import rocking as rocking_stage
from colonnade.stages.rocking import rocking
from colonnade.store.description import describe
from prism import PRISM, campaign_of, entry


def _rocking(campaign, name, recordings, **changes):
    test = campaign.tests[name]
    read = _with_channels(rocking_stage.RockingInputs.of(campaign, test), **changes)
    return rocking(conditioned(campaign, test, recordings), read)


def _with_channels(read, **changes):
    return read.model_copy(update={"transducers": read.transducers.model_copy(update=changes)})


def test_the_angle_of_a_free_vibration_is_the_true_one(small_campaign, free_vibration):
    recordings, time, angle, _ = free_vibration
    result = _rocking(small_campaign, "free-01", recordings)
    away = np.abs(time - 1.0) > 0.05  # the release is a step that the filter rounds
    error = (result["rocking_angle"].to_numpy() - np.interp(result["elapsed"], time, angle))[away]
    assert np.sqrt(np.mean(error**2)) < 5e-4 * PRISM.critical_angle
    assert result.attrs["outcome"] == "rocking"
    assert float(result["peak_ratio"]) == pytest.approx(0.5, abs=2e-3)
    assert "angle and slide" in result.attrs["separation"]
    rest = result["rocking_angle"].to_numpy()[time[: result.sizes["elapsed"]] > 11]
    assert rest.std() < 2 * float(result["rocking_angle_standard_error"])
    assert float(result["rocking_angle_standard_error"]) < 5e-5


def test_the_base_motion_and_its_peak_are_those_of_the_table(small_campaign, shaken):
    recordings, time, angle, base = shaken
    result = _rocking(small_campaign, "shake-01", recordings)
    expected = np.interp(result["elapsed"], time, base)
    np.testing.assert_allclose(result["base_acceleration"], expected, atol=0.01)
    assert float(result["peak_ground_acceleration"]) == pytest.approx(np.abs(base).max(), rel=5e-3)
    assert float(result["peak_time"]) == pytest.approx(time[np.argmax(np.abs(angle))], abs=0.01)


def test_ground_relative_transducers_need_the_tables_displacement(small_campaign, shaken):
    test = small_campaign.tests["shake-01"]
    read = rocking_stage.RockingInputs.of(small_campaign, test)
    positions = {name: replace(each, on_ground=True) for name, each in read.transducers.positions.items()}
    with pytest.raises(StageError, match="relative to the ground"):
        rocking(conditioned(small_campaign, test, shaken[0]), _with_channels(read, positions=positions))


def test_a_specimen_without_transducers_still_has_its_base_motion_and_nothing_at_all_is_refused(small_campaign, shaken):
    result = _rocking(small_campaign, "shake-01", shaken[0], positions={})
    assert "rocking_angle" not in result
    assert result.attrs["outcome"] == ""
    assert float(result["peak_ground_acceleration"]) > 1
    with pytest.raises(StageError, match="at least one of the two is needed"):
        _rocking(small_campaign, "shake-01", shaken[0], positions={}, accelerations={})


def test_a_lost_transducer_leaves_the_angle_to_the_other(small_campaign, free_vibration):
    recordings, _time, _angle, _ = free_vibration
    recordings["main"].channel("LVDT 2").values[:] = np.nan
    result = _rocking(small_campaign, "free-01", recordings)
    assert "slide cannot be separated" in result.attrs["separation"]
    assert float(result["peak_ratio"]) == pytest.approx(0.5, abs=2e-3)


@pytest.mark.parametrize("share", [0.06, 0.12, 0.4])
def test_a_block_that_walks_under_its_only_transducer_is_told(share, small_campaign, shaken):
    recordings, time, _, _ = shaken
    walk = share * PRISM.critical_angle * 400 / 12 * np.clip((time - 1) / 6, 0, 1)
    recordings["main"].channel("LVDT 1").values[:] += walk
    motion = _rocking(changed(small_campaign, ("\nbottom = ", "\n# bottom = ")), "shake-01", recordings)
    (told,) = [str(each) for each in motion.attrs["warnings"] if each.kind == "rest"]
    assert f"is at {share:.2g} α" in told
    assert "the block walked under it" in told


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
    "a vertical pair": ["left", "right"],
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
