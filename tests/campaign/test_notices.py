"""What looks odd in a valid campaign is told."""

import re

import pytest


def test_the_contracts_example_is_without_a_warning(contract, load_text):
    assert load_text(contract).warnings == ()


CHANNEL = {
    **{"column": '"X"', "quantity": '"displacement"', "unit": '"mm"', "on": '"specimen"'},
    **{"at": '["1 mm", "0 mm", "1 mm"]', "direction": "[1, 0, 0]", "relative_to": '"table"'},
}


def with_extra(contract, keys):
    """The contract with one more channel; a key that is None is left out."""
    channel = ", ".join(f"{key} = {value}" for key, value in (CHANNEL | keys).items() if value)
    return contract.replace("[processing]", f"extra = {{{channel}}}\n\n[processing]")


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"quantity": '"velocity"', "unit": '"m/s"'}, 'quantity = "velocity" on the specimen is valid but not'),
        ({"quantity": '"acceleration"', "unit": '"g"'}, 'quantity = "acceleration" on the specimen is valid but not'),
        ({"on": '"ground"'}, 'quantity = "displacement" on the ground is valid but not'),
    ],
)
def test_a_channel_without_a_stage_is_told(keys, told, contract, load_text):
    assert any(warning.text.startswith(told) for warning in load_text(with_extra(contract, keys)).warnings)


def test_a_deviating_measured_value_is_told_with_its_place(contract, load_text):
    text = contract.replace('height = "456 mm"', 'height = "456 mm", critical_angle = "0.1886 rad"')
    (told,) = [each.text for each in load_text(text).warnings if "critical_angle is given" in each.text]
    assert re.match(r"specimens\.prism\.critical_angle is given as 0.1886 rad, \+1.2\s% from the 0.1864 rad", told)


def test_a_campaign_without_tests_is_told(contract, load_text):
    assert "The campaign has no tests yet." in map(str, load_text(contract[: contract.index("[[tests]]")]).warnings)


@pytest.mark.parametrize(
    "keys",
    [
        {"sensing": '"surface"', "normal": "[1, 0, 0]"},
        {"sensing": '"wire"', "anchor": '["1 m", "0 m", "0 m"]'},
        {"quantity": '"angle"', "unit": '"deg"', "direction": "[0, 1, 0]"},
        {"quantity": '"angular_velocity"', "unit": '"deg/s"', "direction": "[0, 1, 0]"},
        {"direction": "[0, 1, 0]"},
        {"on": '"table"', "direction": "[0, 0, 1]"},
    ],
    ids=["laser", "string pot", "inclinometer", "gyroscope", "across", "vertical table"],
)
def test_transducers_of_all_kinds_are_used_without_a_word(keys, contract, load_text):
    assert not any("extra" in warning.text for warning in load_text(with_extra(contract, keys)).warnings)


def _told(text, load_text, kind):
    return [found for found in load_text(text).warnings if found.kind == kind]


@pytest.mark.parametrize(
    ("changed", "severity", "said"),
    [
        (('height = "456 mm"', 'height = "456 m"'), "serious", "give 7.7 kg/m³; .* its lengths .mm read as m"),
        (('height = "456 mm"', 'height = "456 cm"'), None, ""),
        (('mass = "26.10 kg"', 'mass = "0.1 kg"'), "warning", "give 30 kg/m³"),
        (('mass = "26.10 kg"', 'mass = "100000 kg"'), "serious", "give 30000000 kg/m³; .* check the units"),
    ],
    ids=["m for mm", "a lighter material", "a foam", "too heavy"],
)
def test_a_specimen_of_no_material_is_told_with_its_density(changed, severity, said, contract, load_text):
    told = _told(contract.replace(*changed), load_text, "specimen")
    found = [each for each in told if each.about == "specimens.prism"]
    assert [each.severity for each in found] == ([severity] if severity else [])
    assert all(re.search(said, each.text) for each in found)


@pytest.mark.parametrize(
    ("at", "severity"),
    [
        ('["43 mm", "0 mm", "440 mm"]', None),
        ('["100 mm", "0 mm", "500 mm"]', None),
        ('["43 mm", "0 mm", "600 mm"]', None),
        ('["43 mm", "0 mm", "440 m"]', "serious"),
        ('["43 m", "0 mm", "440 mm"]', "serious"),
        ('["43 mm", "0 mm", "-440 cm"]', "serious"),
    ],
    ids=["on it", "on a bracket", "on a mast", "m for mm", "beside it", "below it"],
)
def test_a_point_far_off_the_specimen_is_told(at, severity, contract, load_text):
    found = [each for each in _told(with_extra(contract, {"at": at}), load_text, "geometry") if "extra.at" in each.text]
    assert [each.severity for each in found] == ([severity] if severity else [])
