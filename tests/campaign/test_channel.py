"""Channels: recorded values to SI, ranges, and what a channel has to say of itself."""

import pytest
from pydantic import ValidationError

from colonnade.campaign import Channel
from every import every

DISPLACEMENT = {"column": "LVDT", "quantity": "displacement", "on": "table", "direction": [1, 0, 0]}

SPECIMEN = {"unit": "mm", "on": "specimen", "at": ["43 mm", "0 mm", "440 mm"], "relative_to": "table"}

WIRE = {"sensing": "wire"}


def channel(**keys):
    return Channel.model_validate(DISPLACEMENT | keys)


@pytest.mark.parametrize(
    ("keys", "factor", "offset"),
    [
        ({"unit": "mm"}, 0.001, 0.0),
        ({"unit": "mm", "gain": -1}, -0.001, 0.0),
        ({"unit": "mm", "gain": "-1", "offset": "2 cm"}, -0.001, 0.02),
        ({"unit": "V", "gain": "10.02 mm/V", "offset": "-0.13 mm"}, 0.01002, -0.00013),
        ({"unit": "mV", "gain": "10.02 mm/V"}, 1.002e-5, 0.0),
    ],
)
def test_physical_value_is_recorded_times_factor_plus_offset(keys, factor, offset):
    found = channel(**keys)
    assert found.factor == pytest.approx(factor, rel=1e-14)
    assert found.offset == pytest.approx(offset, rel=1e-14)
    assert found.si_unit == "m"


@every(
    ("keys", "recorded", "full_scale"),
    [
        ({"unit": "V", "gain": "10 mm/V"}, None, None),
        ({"unit": "V", "gain": "10 mm/V", "range": "10 V"}, 10.0, 0.1),
        ({"unit": "V", "gain": "10 mm/V", "range": "50 mm"}, None, 0.05),
        ({"unit": "V", "gain": "10 mm/V", "offset": "5 mm", "range": "10 V"}, 10.0, 0.105),
        ({"unit": "mm", "range": "50 mm"}, 50.0, 0.05),
        ({"unit": "mm", "gain": 2, "range": "50 mm"}, 50.0, 0.1),
        ({"unit": "mm", "gain": 2, "range": "5 cm"}, None, 0.05),
    ],
)
def test_range_is_of_the_recorded_value_where_it_has_its_unit(keys, recorded, full_scale):
    found = channel(**keys)
    assert found.range_recorded == (None if recorded is None else pytest.approx(recorded))
    assert found.full_scale == (None if full_scale is None else pytest.approx(full_scale))


@pytest.mark.parametrize(
    ("keys", "factor", "si_unit"),
    [
        ({}, 1.0, "1"),
        ({"unit": "°C"}, 1.0, "degC"),
        ({"unit": "mV"}, 0.001, "V"),
        ({"unit": "V", "gain": "5 bar/V"}, 5e5, "kg m-1 s-2"),
    ],
)
def test_other_quantities_keep_the_dimension_that_they_have(keys, factor, si_unit):
    found = Channel.model_validate({"column": 1, "quantity": "other"} | keys)
    assert found.factor == pytest.approx(factor)
    assert found.si_unit == si_unit


def problems(**keys):
    with pytest.raises(ValidationError) as caught:
        channel(**keys)
    return {str(each["loc"][0]): each["msg"] for each in caught.value.errors()}


@every(
    ("keys", "key", "words"),
    [
        ({}, "unit", "It is missing"),
        ({"unit": "V"}, "unit", 'add a gain in "mm/V"'),
        ({"unit": "V", "gain": "0.5 g/V"}, "gain", 'is not a length. A gain in "mm per V" was expected'),
        ({"unit": "V", "gain": "0 mm/V"}, "gain", "It is 0 m. A value between"),
        ({"unit": "V", "gain": "1e400 mm/V"}, "gain", "too large"),
        ({"unit": "V", "gain": True}, "gain", "Text in quotes was expected: physical over recorded"),
        ({"unit": 3}, "unit", "Text in quotes was expected: unit of the values"),
        ({"unit": "mm", "offset": "3"}, "offset", "has no unit"),
        ({"unit": "V", "gain": "10 mm/V", "range": "2 g"}, "range", 'A range in the recorded unit, "V", is also'),
        ({"unit": "mm", "delay": "2 mm"}, "delay", "A time was expected"),
        ({"unit": "mm", "column": ""}, "column", "its column in the raw file, or its number from 1"),
        ({"unit": "mm", "sensing": "surface"}, "sensing", "is for a displacement of the specimen"),
        (SPECIMEN | WIRE, "anchor", "needs its fixed end"),
        ({"unit": "mm", "normal": [1, 0, 0]}, "normal", 'needs sensing = "surface"'),
        ({"unit": "mm", "anchor": ["1 m", "0 m", "0 m"]}, "anchor", 'needs sensing = "wire"'),
        (SPECIMEN | {"sensing": "surface", "normal": [0, 0, 1]}, "normal", "looks at right angles to `direction`"),
        (SPECIMEN | WIRE | {"anchor": ["43 mm", "0 mm", "1 m"]}, "anchor", "looks at right angles to `direction`"),
        (SPECIMEN | WIRE | {"anchor": ["43 mm", "0 mm", "440 mm"]}, "anchor", "looks at right angles"),
    ],
)
def test_a_channel_that_does_not_fit_together_is_told_at_its_key(keys, key, words):
    assert words in problems(**keys)[key]


def test_a_displacement_of_the_specimen_needs_point_and_reference():
    assert set(problems(unit="mm", on="specimen")) == {"at", "relative_to"}


def test_several_problems_of_one_channel_are_told_together():
    found = problems(unit="V", gain="0.5 g/V", on="specimen", at=["43 mm", "0 mm", "1 m"])
    assert set(found) == {"gain", "relative_to"}


LASER = {"sensing": "surface"}


@every("keys", [LASER | {"normal": [1, 0, 0]}, LASER, WIRE | {"anchor": ["-500 mm", "50 mm", "440 mm"]}])
def test_lines_of_sight_and_wires_that_see_the_specimen_are_taken(keys):
    assert channel(**SPECIMEN | keys).sensing == keys["sensing"]
