"""Patterns of file names: what a name says, and which patterns are refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.test import Test
from colonnade.campaign.watched import Pattern, parts
from colonnade.units import DIMENSIONS
from every import every

NAMES = {
    "specimen": {"cone": "cone", "cone-2": "cone-2", "säule": "Säule"},
    "kind": {"free": "free-vibration", "sine": "sine"},
    "recorder": {"daq2": "daq2"},
}


def test_a_name_gives_the_values_of_a_test():
    pattern = Pattern("{specimen}_{kind}_{frequency:Hz}Hz_{amplitude:g}g_{number}.csv")
    assert pattern.match("Cone-2_Sine_4,5Hz_0p25g_003.CSV", NAMES) == {
        "specimen": "cone-2",
        "kind": "sine",
        "frequency": "4.5 Hz",
        "amplitude": "0.25 g",
        "number": "003",
    }


@pytest.mark.parametrize("name", ["cone-free-.csv", "cube-free-1.csv", "cone-free-1.csv.bak", "cone-free-1e5.csv"])
def test_a_name_that_does_not_fit_gives_nothing(name):
    assert Pattern("{specimen}-{kind}-{number}.csv").match(name, NAMES) is None


def test_signs_of_the_pattern_are_taken_as_they_are():
    pattern = Pattern("run (a+b).{number}.csv")
    assert pattern.match("run (a+b).7.csv", NAMES) == {"number": "7"}
    assert pattern.match("run (aab).7.csv", NAMES) is None


@every(
    ("text", "said"),
    [
        ("{specimn}.csv", 'Did you mean "specimen"?'),
        ("{frequency}.csv", "{frequency:Hz}"),
        ("{frequency:mm}.csv", '{frequency} with unit "mm" was found. {frequency:Hz} was expected.'),
        ("{span:Hz}.csv", "{span} was expected"),
        ("{span}-{span}.csv", "2 times"),
        ("{span.csv", "brace"),
    ],
)
def test_a_wrong_pattern_is_refused_with_what_to_write(text, said):
    assert any(said in problem for problem in Pattern(text).problems())


@given(st.text(max_size=60), st.text(max_size=60))
def test_no_text_of_a_pattern_or_a_name_is_an_exception(text, name):
    pattern = Pattern(text)
    if not list(pattern.problems()):
        found = pattern.match(name, NAMES)
        assert found is None or set(found) <= set(parts())


@given(
    st.sampled_from(sorted(NAMES["specimen"].values())),
    st.decimals(min_value=0, max_value=999, places=3),
    st.sampled_from(".,p"),
)
def test_what_is_written_into_a_name_is_read_from_it(specimen, frequency, sign):
    written = str(frequency).replace(".", sign)
    found = Pattern("{specimen}-{frequency:Hz}.csv").match(f"{specimen}-{written}.csv", NAMES)
    assert found == {"specimen": specimen, "frequency": f"{frequency} Hz"}


def test_every_number_and_quantity_of_a_test_is_a_part_with_its_unit():
    kinds = Test.kinds()
    assert {"frequency", "amplitude", "span", "time_scale"} <= set(parts()) <= {*kinds, "recorder", "number"}
    for key in set(parts()) & kinds.keys():
        (unit,) = [DIMENSIONS[kind][1] for kind in kinds[key] if kind in DIMENSIONS] or [""]
        assert list(Pattern(f"{{{key}:{unit}}}.csv" if unit else f"{{{key}}}.csv").problems()) == []
