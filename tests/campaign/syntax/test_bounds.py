"""Any finite number in a campaign file makes a campaign that can be used, or is refused in a sentence."""

import math
import re
import tomllib
from copy import deepcopy

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign import load
from colonnade.campaign.syntax.document import toml_value
from colonnade.errors import CampaignError

CAMPAIGN = tomllib.loads("""
schema = 1
campaign = "bounds"
title = "Numbers"
gravity = "9.81 m/s^2"
motions.pulse = {file = "raw/motion.txt", interval = "0.02 s"}

[specimens]
prism = {shape = "prism", width = "0.086 m", depth = "0.086 m", height = "0.456 m", mass = "26.1 kg", scale = 20.0, \
critical_angle = "0.1864 rad", pole_distance = "0.232 m", inertia = "1.873 kg m^2", restitution = 0.95}

[setups.frame]
sampling_rate = "200.0 Hz"
catch = "0.3 rad"
table_tilt = "0.001 rad"

[setups.frame.channels]
top = {column = "top", quantity = "displacement", unit = "V", gain = "10.0 mm/V", offset = "0.1 mm", range = "10.0 V", \
on = "specimen", at = ["0.043 m", "0 mm", "440 mm"], direction = [1.0, 0, 0], relative_to = "table", delay = "0.002 s"}

[processing]
sampling_rate = "200.0 Hz"
lowpass = "25.0 Hz"
base_lowpass = "25.0 Hz"
spike_threshold = 8.0
flat_duration = "0.5 s"
gap = 1.5
jitter = 0.05
rest_duration = "0.5 s"
longest_offset = "1.0 s"
restitution = {lowest_amplitude = 0.02, level = 0.95}

[processing.predict]
rest_angle = 1e-6
ensemble = {critical_angle = 0.005, p = 0.005, filter = 0.1}

contact = {step = "1e-5 s", penetration = 1e-6, friction = 0.6, modulus = "2e11 Pa", poisson_ratio = 0.3, \
out_of_plane = "0.0 rad", damping_fraction = 0.1}

[[tests]]
id = "free-01"
kind = "free-vibration"
specimen = "prism"
setup = "frame"
file = "raw/free-01.csv"
window = ["0 s", "8.0 s"]
frequency = "3.0 Hz"
span = 2.0
time_scale = 1.0
""")


def numbers_in(value, place=()):
    """Places of the numbers of a document, alone or with a unit; 0 and 1 in a list are coordinates."""
    if isinstance(value, (dict, list)):
        for key, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from numbers_in(each, (*place, key))
    elif isinstance(value, float) or (isinstance(value, str) and re.match(r"[\d.e-]+ ", value)):
        yield place


NUMBERS = {".".join(map(str, place)): place for place in numbers_in(CAMPAIGN)}
EXTREMES = (5e-324, 1e-300, 1e-30, 1e-12, 1e12, 1e30, 1e300, 1.7976931348623157e308)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("bounds")


def written(folder, key, value):
    document = deepcopy(CAMPAIGN)
    *tables, last = NUMBERS[key]
    table = document
    for each in tables:
        table = table[each]
    usual = table[last]
    table[last] = value if isinstance(usual, float) else f"{value!r} {usual.partition(' ')[2]}"
    text = "".join(f"{name} = {toml_value(each)}\n" for name, each in document.items())
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return folder


def expect_usable_or_refused(folder, key, value):
    try:
        campaign = load(written(folder, key, value))
    except CampaignError as error:
        told = str(error)
        assert len(told) < 400, told
        assert "Internal" not in told
        assert "Traceback" not in told
        assert any(word in told for word in ("expected", "above zero", "at most", "block")), told
        return False
    block, top = campaign.block("prism"), campaign.setups["frame"].channels["top"]
    assert all(math.isfinite(number) for number in (block.p, block.critical_angle, block.pole_distance, block.inertia))
    assert all(math.isfinite(number) for number in (top.factor, top.offset, top.full_scale))
    return True


def test_the_usual_numbers_are_accepted(folder):
    assert expect_usable_or_refused(folder, "specimens.prism.mass", 26.1)


@pytest.mark.parametrize("key", NUMBERS)
def test_a_number_far_from_any_laboratory_is_refused_in_a_sentence_or_harmless(folder, key):
    for value in EXTREMES:
        expect_usable_or_refused(folder, key, value)


@given(key=st.sampled_from(sorted(NUMBERS)), value=st.floats(min_value=5e-324, allow_infinity=False, allow_nan=False))
def test_any_finite_number_above_zero_makes_a_usable_campaign_or_is_refused(folder, key, value):
    expect_usable_or_refused(folder, key, value)


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("specimens.prism.scale", 1e300, "A number from 0.001 to 100000 was expected."),
        ("processing.predict.rest_angle", 1e-300, "A number between 1e-10 and 0.1 was expected."),
        ("setups.frame.sampling_rate", 1e300, "A value between 0.0001 Hz and 1e+07 Hz was expected."),
        ("processing.sampling_rate", 1e300, "A value between 0.0001 Hz and 1e+07 Hz was expected."),
        ("gravity", 1e-300, "A value between 0.01 m/s^2 and 10000 m/s^2 was expected."),
        ("processing.predict.contact.step", 5e-13, "A value between 1e-07 s and 0.001 s was expected."),
        ("specimens.prism.inertia", 1e-9, "give a frequency parameter of"),
        ("setups.frame.channels.top.gain", 1e30, "was expected."),
        ("setups.frame.channels.top.offset", 1e300, "was expected."),
        ("setups.frame.channels.top.at.0", 1e300, "At most 10000 m was expected."),
    ],
)
def test_what_was_met_is_refused_with_what_was_expected(folder, key, value, expected):
    with pytest.raises(CampaignError, match=re.escape(expected)):
        load(written(folder, key, value))
