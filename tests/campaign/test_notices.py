"""What is accepted but not yet used is told once a key; what looks odd is told too."""

from __future__ import annotations

import pytest


def test_keys_without_a_stage_are_told_once_with_the_first_place(contract, load_text):
    assert load_text(contract).warnings == (
        "scale is understood but not yet used (specimens.prism and 1 more).",
        "table_tilt is understood but not yet used (setups.frame).",
        "time_scale is understood but not yet used (tests[span-2.0]).",
        'tests[span-2.0] has no file of recorder "daq2"; its channels are absent in this test.',
    )


CHANNEL = {
    "column": '"X"',
    "quantity": '"displacement"',
    "unit": '"mm"',
    "on": '"specimen"',
    "at": '["1 mm", "0 mm", "1 mm"]',
    "direction": "[1, 0, 0]",
    "relative_to": '"table"',
}


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"sensing": '"surface"', "normal": "[1, 0, 0]"}, 'sensing = "surface" is understood but not yet used'),
        ({"sensing": '"wire"', "anchor": '["1 m", "0 m", "0 m"]'}, "anchor is understood but not yet used"),
        ({"quantity": '"acceleration"', "unit": '"g"'}, 'quantity = "acceleration" on the specimen is understood'),
        ({"quantity": '"angular_velocity"', "unit": '"deg/s"'}, 'quantity = "angular_velocity" on the specimen'),
        ({"direction": "[0, 1, 0]"}, "a displacement out of the plane of rocking is understood but not yet used"),
        ({"on": '"ground"'}, 'quantity = "displacement" on the ground is understood'),
        ({"on": '"table"', "direction": "[0, 0, 1]"}, "a motion of the table that is not along x"),
    ],
)
def test_a_channel_without_a_stage_is_told(keys, told, contract, load_text):
    channel = ", ".join(f"{key} = {value}" for key, value in (CHANNEL | keys).items())
    text = contract.replace("[processing]", f"extra = {{{channel}}}\n\n[processing]")
    assert any(warning.startswith(told) for warning in load_text(text).warnings)


def test_a_deviating_measured_value_is_told_with_its_place(contract, load_text):
    text = contract.replace('height = "456 mm"', 'height = "456 mm", critical_angle = "0.1886 rad"')
    told = [
        warning for warning in load_text(text).warnings if warning.startswith("specimens.prism.critical_angle is given")
    ]
    assert len(told) == 1
    assert "the tangent of the angle" in told[0]


def test_a_sine_without_frequency_and_a_campaign_without_tests_are_told(contract, load_text):
    sine = contract.replace('kind = "earthquake"', 'kind = "sine"')
    assert any("sine test without frequency" in warning for warning in load_text(sine).warnings)
    assert "There is no test yet." in load_text(contract[: contract.index("[[tests]]")]).warnings
