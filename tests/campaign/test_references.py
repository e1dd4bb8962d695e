"""Names that refer to nothing and ids that clash, in campaigns whose values can all be read."""

from pathlib import Path

import pytest

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.references import dangling as of_campaign
from every import every

SHAPES = {
    "prism": {"width": "86 mm", "depth": "86 mm", "height": "456 mm"},
    "cylinder": {"diameter": "97 mm", "height": "480 mm"},
    "cone": {"base_diameter": "97 mm", "top_diameter": "75 mm", "height": "480 mm"},
    "measured": {"pole_distance": "610 mm", "critical_angle": "0.21 rad", "inertia": "41 kg m^2"},
}
OTHER = {"column": 1, "quantity": "other"}


def specimen(shape="prism"):
    return {"shape": shape, "mass": "26 kg"} | SHAPES[shape]


def document(*, channels=None, recorders=None, shape="prism", test=None):
    frame = {"channels": {"top": OTHER} if channels is None else channels, "recorders": recorders or {}}
    tests = [{"id": "one", "kind": "other", "specimen": "prism", "setup": "frame", "file": "a.csv"} | (test or {})]
    return {"specimens": {"prism": specimen(shape)}, "setups": {"frame": frame}, "tests": tests}


def dangling(written):
    whole = {"schema": 1, "campaign": "small", "title": "Small"} | written
    return list(of_campaign(CampaignFile.model_validate(whole, context={"folder": Path.cwd()})))


def test_a_document_whose_names_all_exist_has_no_problem():
    assert dangling(document()) == []


def having(**keys):
    return document(channels={"top": OTHER | keys})


def aligned(*named):
    channels = {"top": OTHER, "second": OTHER | {"recorder": "daq2"}}
    return document(channels=channels, recorders={"daq2": {"clock": {"align": list(named)}}})


FRAME = "setups.frame"
ALIGN = f"{FRAME}.recorders.daq2.clock.align"
SPECIMENS = {"specimens": {"prism": specimen(), "Prism": specimen()}}
SETUPS = {"setups": {name: {"channels": {"top": OTHER}} for name in ("frame", "FRAME")}}
BOTH = {"file": {"main": "a.csv", "daq2": "b.csv"}}
DID = "in this set-up. Did you mean"
CASE = "is taken, and upper and lower case do not tell ids apart. Choose another."


@every(
    ("written", "place", "told"),
    [
        (document(test={"specimen": "zzz"}), "tests.0.specimen", 'Unknown specimen "zzz". Choose one of: "prism".'),
        (having(on="prizm"), f"{FRAME}.channels.top.on", 'Unknown body "prizm". Did you mean "prism"?'),
        (document(test={"setup": "zzz"}), "tests.0.setup", 'Unknown setup "zzz". Choose one of: "frame".'),
        (document(test=BOTH), "tests.0.file.daq2", 'Unknown recorder "daq2" in set-up "frame". Choose one of: "main".'),
        (having(recorder="mian"), f"{FRAME}.channels.top.recorder", f'Unknown recorder "mian" {DID} "main"?'),
        (aligned("tpo", "second"), ALIGN, 'Unknown channel "tpo" of recorder "main". Did you mean "top"?'),
        (aligned("second", "second"), ALIGN, 'Unknown channel "second" of recorder "main". Choose one of: "top".'),
        (aligned("top", "top"), ALIGN, 'Unknown channel "top" of recorder "daq2". Choose one of: "second".'),
        (
            document(channels={"a.b": OTHER, "A_b": OTHER}),
            f"{FRAME}.channels.A_b",
            "The id \"a.b\" is taken, and upper and lower case, '.', '-' and '_' do not tell ids apart. "
            "Choose another.",
        ),
        (document(recorders={"daq": {}, "DAQ": {}}), f"{FRAME}.recorders.DAQ", f'The id "daq" {CASE}'),
        (document(recorders={"Main": {}}), f"{FRAME}.recorders.Main", f'The id "main" {CASE}'),
        (document() | SPECIMENS, "specimens.Prism", f'The id "prism" {CASE}'),
        (document() | SETUPS, "setups.FRAME", f'The id "frame" {CASE}'),
    ],
)
def test_one_problem_is_told_at_its_place(written, place, told):
    ((where, said),) = dangling(written)
    assert (".".join(map(str, where)), said) == (place, told)


def test_names_of_recorders_may_differ_where_those_of_channels_may_not():
    assert (dangling(document(recorders={"daq.2": {}, "daq-2": {}}))) == []


def test_equal_ids_of_tests_clash():
    (test,) = document()["tests"]
    tests = [test | {"id": name} for name in ("a", "b", "a", "A")]
    assert dangling(document() | {"tests": tests}) == [
        (("tests", index, "id"), f'The id "a" {CASE}') for index in (2, 3)
    ]


@pytest.mark.parametrize(("shape", "count"), [("prism", 1), ("measured", 1), ("cylinder", 0), ("cone", 0)])
def test_a_face_without_normal_is_told_once_for_all_tests(shape, count):
    laser = {"column": 2, "quantity": "displacement", "unit": "mm", "on": "specimen", "direction": [1, 0, 0]}
    laser |= {"at": ["48 mm", "0 mm", "400 mm"], "relative_to": "table", "sensing": "surface"}
    place = ("setups", "frame", "channels", "laser", "normal")
    written = document(channels={"laser": laser, "wire": OTHER}, shape=shape)
    written["tests"] = [written["tests"][0] | {"id": name} for name in "abc"]
    assert [where for where, _ in dangling(written)] == [place] * count
    laser["normal"] = [1, 0, 0]
    assert dangling(written) == []
