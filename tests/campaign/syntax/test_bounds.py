"""Any finite number in a campaign file makes a campaign that can be used, or is refused in a sentence."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign import load
from colonnade.errors import CampaignError

CAMPAIGN = """\
schema = 1
campaign = "bounds"
title = "Numbers"
gravity = {gravity}

[specimens.prism]
shape = "prism"
width = {width}
depth = {depth}
height = {height}
mass = {mass}
scale = {scale}
critical_angle = {critical_angle}
pole_distance = {pole_distance}
inertia = {inertia}
restitution = {restitution}

[setups.frame]
sampling_rate = {rate}
catch = {catch}
table_tilt = {table_tilt}

[setups.frame.channels.top]
column = "top"
quantity = "displacement"
unit = "V"
gain = {gain}
offset = {offset}
range = {range}
on = "specimen"
at = [{at}, "0 mm", "440 mm"]
direction = [{direction}, 0, 0]
relative_to = "table"
delay = {delay}

[motions.pulse]
file = "raw/motion.txt"
interval = {interval}

[processing]
sampling_rate = {sampling_rate}
lowpass = {lowpass}
base_lowpass = {base_lowpass}
spike_threshold = {spike_threshold}
flat_duration = {flat_duration}
gap = {gap}
jitter = {jitter}
rest_duration = {rest_duration}
longest_offset = {longest_offset}

[processing.restitution]
lowest_amplitude = {lowest_amplitude}
level = {level}

[processing.predict]
rest_angle = {rest_angle}

[processing.predict.ensemble]
critical_angle = {ensemble_critical_angle}
p = {ensemble_p}
filter = {ensemble_filter}

[processing.predict.contact]
step = {step}
penetration = {penetration}
friction = {friction}
modulus = {modulus}
poisson_ratio = {poisson_ratio}
out_of_plane = {out_of_plane}
damping_fraction = {damping_fraction}

[[tests]]
id = "free-01"
kind = "free-vibration"
specimen = "prism"
setup = "frame"
file = "raw/free-01.csv"
window = ["0 s", {window}]
frequency = {frequency}
span = {span}
time_scale = {time_scale}
"""
USUAL = {
    "gravity": (9.81, "m/s^2"),
    "width": (0.086, "m"),
    "depth": (0.086, "m"),
    "height": (0.456, "m"),
    "mass": (26.1, "kg"),
    "scale": (20.0, None),
    "critical_angle": (0.1864, "rad"),
    "pole_distance": (0.232, "m"),
    "inertia": (1.873, "kg m^2"),
    "restitution": (0.95, None),
    "rate": (200.0, "Hz"),
    "catch": (0.3, "rad"),
    "table_tilt": (0.001, "rad"),
    "gain": (10.0, "mm/V"),
    "offset": (0.1, "mm"),
    "range": (10.0, "V"),
    "at": (0.043, "m"),
    "direction": (1.0, None),
    "delay": (0.002, "s"),
    "interval": (0.02, "s"),
    "sampling_rate": (200.0, "Hz"),
    "lowpass": (25.0, "Hz"),
    "base_lowpass": (25.0, "Hz"),
    "spike_threshold": (8.0, None),
    "flat_duration": (0.5, "s"),
    "gap": (1.5, None),
    "jitter": (0.05, None),
    "rest_duration": (0.5, "s"),
    "longest_offset": (1.0, "s"),
    "lowest_amplitude": (0.02, None),
    "level": (0.95, None),
    "rest_angle": (1e-6, None),
    "ensemble_critical_angle": (0.005, None),
    "ensemble_p": (0.005, None),
    "ensemble_filter": (0.1, None),
    "step": (1e-5, "s"),
    "penetration": (1e-6, None),
    "friction": (0.6, None),
    "modulus": (2e11, "Pa"),
    "poisson_ratio": (0.3, None),
    "out_of_plane": (0.0, "rad"),
    "damping_fraction": (0.1, None),
    "window": (8.0, "s"),
    "frequency": (3.0, "Hz"),
    "span": (2.0, None),
    "time_scale": (1.0, None),
}
EXTREMES = (5e-324, 1e-300, 1e-30, 1e-12, 1e12, 1e30, 1e300, 1.7976931348623157e308)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("bounds")


def written(folder, **numbers):
    values = {key: (numbers.get(key, usual), unit) for key, (usual, unit) in USUAL.items()}
    texts = {key: repr(value) if unit is None else f'"{value!r} {unit}"' for key, (value, unit) in values.items()}
    (folder / "campaign.toml").write_text(CAMPAIGN.format(**texts), encoding="utf-8")
    return folder


def of(campaign, key):
    """Numbers of a campaign that follow from its own, and that everything computes with."""
    block, top = campaign.block("prism"), campaign.setups["frame"].channels["top"]
    return (block.p, block.critical_angle, block.pole_distance, block.inertia, top.factor, top.offset, top.full_scale)


def expect_usable_or_refused(folder, key, value):
    try:
        campaign = load(written(folder, **{key: value}))
    except CampaignError as error:
        told = str(error)
        assert len(told) < 400, told
        assert "Internal" not in told
        assert "Traceback" not in told
        assert any(word in told for word in ("expected", "above zero", "at most", "block")), told
        return False
    assert all(math.isfinite(number) for number in of(campaign, key))
    return True


def test_the_usual_numbers_are_accepted(folder):
    assert expect_usable_or_refused(folder, "mass", 26.1)


@pytest.mark.parametrize("key", USUAL)
def test_a_number_far_from_any_laboratory_is_refused_in_a_sentence_or_harmless(folder, key):
    for value in EXTREMES:
        expect_usable_or_refused(folder, key, value)


@given(key=st.sampled_from(sorted(USUAL)), value=st.floats(min_value=5e-324, allow_infinity=False, allow_nan=False))
def test_any_finite_number_above_zero_makes_a_usable_campaign_or_is_refused(folder, key, value):
    expect_usable_or_refused(folder, key, value)


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("scale", 1e300, "A number from 0.001 to 100000 was expected."),
        ("rest_angle", 1e-300, "A number between 1e-10 and 0.1 was expected."),
        ("rate", 1e300, "A value between 0.0001 Hz and 1e+07 Hz was expected."),
        ("sampling_rate", 1e300, "A value between 0.0001 Hz and 1e+07 Hz was expected."),
        ("gravity", 1e-300, "A value between 0.01 m/s^2 and 10000 m/s^2 was expected."),
        ("step", 5e-13, "A value between 1e-07 s and 0.001 s was expected."),
        ("inertia", 1e-9, "give a frequency parameter of"),
        ("gain", 1e30, "was expected."),
        ("offset", 1e300, "was expected."),
        ("at", 1e300, "At most 10000 m was expected."),
    ],
)
def test_what_was_met_is_refused_with_what_was_expected(folder, key, value, expected):
    with pytest.raises(CampaignError) as refused:
        load(written(folder, **{key: value}))
    assert expected in str(refused.value)
