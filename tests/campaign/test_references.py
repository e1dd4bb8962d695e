"""Names that refer to nothing and ids that clash, in documents that no schema has seen."""

from __future__ import annotations

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.references import dangling

ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)


def document(*, channels=None, recorders=None, specimen=None, test=None):
    frame = {"channels": channels or {"top": {}}, "recorders": recorders or {}}
    tests = [{"id": "one", "specimen": "prism", "setup": "frame"} | (test or {})]
    return {"specimens": {"prism": {"shape": "prism"} | (specimen or {})}, "setups": {"frame": frame}, "tests": tests}


def test_a_document_whose_names_all_exist_has_no_problem(contract):
    assert list(dangling(tomllib.loads(contract))) == []
    assert list(dangling(document())) == []


def aligned(*named):
    return document(
        channels={"top": {}, "second": {"recorder": "daq2"}}, recorders={"daq2": {"clock": {"align": list(named)}}}
    )


ALIGN = ("setups", "frame", "recorders", "daq2", "clock", "align")


@pytest.mark.parametrize(
    ("written", "place", "told"),
    [
        (
            document(test={"specimen": "zzz"}),
            ("tests", 0, "specimen"),
            'Unknown specimen "zzz". Choose one of: "prism".',
        ),
        (document(test={"setup": "zzz"}), ("tests", 0, "setup"), 'Unknown setup "zzz". Choose one of: "frame".'),
        (
            document(test={"file": {"daq2": "a.csv"}}),
            ("tests", 0, "file", "daq2"),
            'Unknown recorder in set-up "frame". Choose one of: "main".',
        ),
        (
            document(channels={"top": {"recorder": "mian"}}),
            ("setups", "frame", "channels", "top", "recorder"),
            'Unknown recorder "mian" in this set-up. Did you mean "main"?',
        ),
        (aligned("tpo", "second"), ALIGN, 'Unknown channel "tpo" in this set-up. Did you mean "top"?'),
        (
            aligned("second", "second"),
            ALIGN,
            '"second" is not a channel of recorder "main". Choose one of: "top".',
        ),
        (aligned("top", "top"), ALIGN, '"top" is not a channel of recorder "daq2". Choose one of: "second".'),
        (
            document(channels={"a.b": {}, "A_b": {}}),
            ("setups", "frame", "channels", "A_b"),
            "This id differs from \"a.b\" only in case or in '.', '-' and '_'. Choose another.",
        ),
        (
            document(recorders={"daq": {}, "DAQ": {}}),
            ("setups", "frame", "recorders", "DAQ"),
            'This id differs from "daq" only in upper and lower case. Choose another.',
        ),
        (
            {"specimens": {"prism": {}, "Prism": {}}},
            ("specimens", "Prism"),
            'This id differs from "prism" only in upper and lower case. Choose another.',
        ),
        (
            {"setups": {"frame": {}, "FRAME": {}}},
            ("setups", "FRAME"),
            'This id differs from "frame" only in upper and lower case. Choose another.',
        ),
    ],
    ids=[
        "specimen",
        "setup",
        "recorder of a test",
        "recorder of a channel",
        "aligned channel",
        "aligned with the other recorder",
        "aligned by the main recorder",
        "channels",
        "recorders",
        "specimens",
        "setups",
    ],
)
def test_one_problem_is_told_at_its_place(written, place, told):
    assert list(dangling(written)) == [(place, told)]


def test_names_of_recorders_may_differ_where_those_of_channels_may_not():
    assert list(dangling(document(recorders={"daq.2": {}, "daq-2": {}}))) == []


def test_tests_without_an_id_do_not_clash_and_equal_ids_do():
    tests = [{}, {}, {"id": "a"}, {"id": 3}, {"id": 3}, {"id": "a"}, {"id": "A"}]
    assert list(dangling({"tests": tests})) == [
        (("tests", 5, "id"), '"a": This id is used twice. Give every test its own id.'),
        (("tests", 6, "id"), '"A": It differs from "a" only in upper and lower case. Give every test its own id.'),
    ]


@pytest.mark.parametrize(("shape", "count"), [("prism", 1), ("measured", 1), ("cylinder", 0), ("cone", 0)])
def test_a_face_without_normal_is_told_once_for_all_tests(shape, count):
    written = document(channels={"laser": {"sensing": "surface"}, "wire": {}}, specimen={"shape": shape})
    written["tests"] *= 3
    found = list(dangling(written))
    assert [place for place, _ in found if place[-1] == "normal"] == [
        ("setups", "frame", "channels", "laser", "normal")
    ] * count
    written["setups"]["frame"]["channels"]["laser"]["normal"] = [1, 0, 0]
    assert not [place for place, _ in dangling(written) if place[-1] == "normal"]


@given(ANYTHING, ANYTHING, ANYTHING)
def test_values_of_any_type_are_passed_over(specimens, setups, tests):
    for written in (
        {"specimens": specimens, "setups": setups, "tests": tests},
        {"setups": {"frame": setups}, "tests": [tests, {"setup": "frame", "specimen": specimens, "file": tests}]},
        {"setups": {"frame": {"channels": setups, "recorders": tests}}},
        {"setups": {"frame": {"channels": {"a": setups}, "recorders": {"b": {"clock": {"align": [tests, "a"]}}}}}},
    ):
        assert all(place and told.endswith((".", "?")) for place, told in dangling(written))
