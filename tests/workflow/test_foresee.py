import hashlib
import json

import jsonschema
import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.forms.forecast import ForecastBlock
from colonnade.campaign.forms.schema import json_schema
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError
from colonnade.stages.forecast import felt, plan_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.workflow.asked import motion_asked_for
from colonnade.workflow.foresee import factor_of
from foreseeing import LATER, TEST, foreseen_of
from prism import PRISM


def test_a_weak_motion_does_not_rock_needs_friction_by_its_acceleration_and_a_strong_one_overturns(foreseen):
    weak, strong = (each.forecast.models["linear"] for each in foreseen[1])
    assert (weak.no_rocking, weak.rocking, weak.overturned) == (1.0, 0.0, 0.0)
    assert {(band.low, band.high) for band in weak.bands} == {(0.0, 0.0)}
    assert strong.overturned == 1.0
    assert set(strong.peak_ratio) == {None}
    standing = foreseen[1][0].forecast
    assert standing.table.peak_acceleration == pytest.approx(0.01 * 9.80665)
    friction = standing.table.peak_acceleration / standing.inputs.block.gravity
    assert standing.models["nonlinear"].required_friction == pytest.approx(friction, rel=1e-9)


def test_a_file_says_all_that_it_follows_from(foreseen):
    folder, made = foreseen
    content = json.loads(made[1].path.read_text(encoding="utf-8"))
    jsonschema.validate(content, json_schema("forecast"))
    digest = content.pop("sha256")
    assert digest == hash_of(content)
    assert (content["test"], content["specimen"], content["level"]) == (LATER, "prism", "9x")
    rocking = files.read(Layout(folder).stage(TEST, "rocking"))
    moved = 9 * rocking["base_acceleration"].to_numpy()
    assert content["motion"]["sha256"] == hashlib.sha256(moved.astype("<f8").tobytes()).hexdigest()
    pooled = files.read(Layout(folder).stage("prism", "specimen"))
    e = content["inputs"]["restitution"]
    assert e["value"] == pytest.approx(pooled["side_restitution"].to_numpy().tolist())
    assert (e["low"], e["high"]) == pytest.approx([float(pooled[f"restitution_{end}"]) for end in ("low", "high")])
    raw = content["raw_files"]
    assert raw[f"raw/{TEST}.csv"] == hashlib.sha256((folder / f"raw/{TEST}.csv").read_bytes()).hexdigest()
    assert f"raw/{LATER}.csv" not in raw


def test_the_frozen_inputs_give_the_same_members_again(foreseen):
    folder, made = foreseen
    forecast = made[0].forecast
    asked = motion_asked_for(TEST, load(folder), Layout(folder))
    factor = factor_of(forecast.level, asked)
    motion = Motion(factor * asked.motion.acceleration, asked.motion.dt)
    again = plan_of(forecast.inputs, "linear", felt(forecast.inputs, motion)).run()
    assert again.peak_ratio.tolist() == list(forecast.models["linear"].peak_ratio)


def test_a_raw_file_that_was_read_counts_as_there_although_it_is_deleted(foreseen_copy):
    raw = foreseen_copy / f"raw/{TEST}.csv"
    digest = hashlib.sha256(raw.read_bytes()).hexdigest()
    raw.unlink()
    (made,) = foreseen_of(foreseen_copy, motion=TEST, levels=("1x",), test=TEST)
    assert made.forecast.raw_files[f"raw/{TEST}.csv"] == digest


def test_a_file_counts_by_its_shape_and_a_level_once(foreseen_copy):
    motion = foreseen_copy / "pulse.txt"
    values = np.sin(np.arange(200) * 0.1)
    motion.write_text("".join(f"{0.01 * k:.2f} {value:.9f}\n" for k, value in enumerate(values)), encoding="utf-8")
    levels = ["0.02 g", "0.02 g"]
    (made,) = foreseen_of(foreseen_copy, motion="pulse.txt", levels=levels, specimen="statue", time_scale=0.5)
    assert made.forecast.motion.interval == pytest.approx(0.005)
    assert made.forecast.table.peak_acceleration == pytest.approx(0.02 * 9.80665)
    with pytest.raises(CampaignError, match="only the shape"):
        foreseen_of(foreseen_copy, motion="pulse.txt", levels=["2x"], specimen="statue")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"specimen": None}, "several specimens"),
        ({"specimen": "prsm"}, 'Did you mean "prism"'),
        ({"motion": "span-2"}, "There is no motion"),
        ({"motion": "sine-dead"}, "its table motion is not known"),
        ({"levels": ["0.3"]}, "--level 0.3"),
        ({"levels": ["1e9 g"]}, "was expected"),
        ({"levels": ["0x"]}, "was expected"),
        ({"test": "span-99"}, "planned = true"),
        ({"test": LATER, "levels": ["1x", "2x"]}, "has one"),
        ({"test": "free-01"}, "free-vibration"),
        ({"test": "watched"}, "is a test of statue"),
        ({"time_scale": 0.0}, "--time-scale"),
    ],
)
def test_what_cannot_be_foreseen_is_refused_and_nothing_is_written(foreseen, change, said):
    folder, made = foreseen
    with pytest.raises(CampaignError, match=said):
        foreseen_of(folder, **({"motion": TEST, "levels": ["0.1 g"], "specimen": "prism"} | change))
    assert len(list((folder / "forecasts").iterdir())) == len(made)


def test_a_frame_is_forecast_with_its_beam():
    frame = Block.frame(PRISM, beam_mass=20.0, columns=2)
    assert ForecastBlock.of(frame).block() == frame
