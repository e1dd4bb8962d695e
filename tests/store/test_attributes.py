"""Attributes go into a file of results in forms that NetCDF has, and come back as they were."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.findings import note, serious, warning
from colonnade.store.attributes import listed, restored, storable
from every import every

FINDINGS = [
    serious("unit", "Column a is in mm, the campaign file says cm.", follows=("gain",)),
    warning("jitter", "Steps vary by 3 %."),
    note("rounded times", "Rounded to 1 ms."),
]


@pytest.mark.parametrize("value", [True, False, np.True_, np.False_])
def test_a_truth_value_becomes_a_byte_of_the_same_truth(value):
    stored = storable({"seen": value})["seen"]
    assert isinstance(stored, np.int8)
    assert bool(stored) is bool(value)


@every("value", [0, 1, 2.5, "text", "", "µm", [1.0, 2.0], (3,), ["a", 1]])
def test_what_netcdf_holds_is_left_as_it_is(value):
    stored = storable({"value": value})["value"]
    assert stored == value
    assert type(stored) is type(value)


def test_an_array_is_left_as_it_is():
    value = np.array([0.9, 0.8])
    assert storable({"value": value})["value"] is value


def test_what_is_not_known_is_left_out_and_nothing_else():
    assert storable({"a": None, "b": 0, "c": "", "d": []}).keys() == {"b", "c", "d"}


def test_a_mapping_is_the_same_text_whatever_its_order():
    one, other = storable({"settings": {"b": 1, "a": {"x": None}}}), storable({"settings": {"a": {"x": None}, "b": 1}})
    assert one == other
    assert json.loads(one["settings"]) == {"a": {"x": None}, "b": 1}


def test_letters_beyond_ascii_stay_readable():
    stored = storable({"settings": {"unit": "µm"}, "notes": ["größer"]})
    assert "µm" in stored["settings"]
    assert "größer" in stored["notes"]


@given(st.lists(st.text()))
def test_a_list_of_text_comes_back(lines):
    stored = storable({"notes": lines, "refused": tuple(lines)})
    assert all(isinstance(value, str) for value in stored.values())
    assert restored(stored) == {"notes": lines, "refused": lines}


def test_findings_come_back_whole():
    assert restored(storable({"warnings": FINDINGS})) == {"warnings": FINDINGS}


def test_no_findings_come_back_as_none():
    assert restored(storable({"warnings": []})) == {"warnings": []}


def test_plain_text_among_findings_becomes_a_warning():
    found = restored(storable({"warnings": [FINDINGS[0], "The table moved."]}))["warnings"]
    assert found == [FINDINGS[0], warning("other", "The table moved.")]


@every("text", ["[1, 2]", '["a", 1]', '[["a"]]', "[not json", "[", '{"a": "b"}', '"a"', " []", "null"])
def test_text_that_is_not_a_list_of_text_passes(text):
    assert listed(text) == text


@given(st.text().filter(lambda text: not text.startswith("[")))
def test_other_text_passes_unread(text):
    assert restored({"reason": text}) == {"reason": text}


@pytest.mark.parametrize("value", [2.5, np.int8(1), None])
def test_what_is_not_text_passes(value):
    assert listed(value) is value
