"""The e of a specimen: pooled from its free vibrations, and the one rule for which e predictions use."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.findings import Severity
from colonnade.stages.specimen import SpecimenInputs, restitution_spread, specimen, taken
from every import every
from prism import PRISM

OTHER = Block.prism(width=0.086, depth=0.086, height=0.500, mass=26.10)


def identified(e, error=0.001, *, method="peaks"):
    """The result of `restitution` of a free vibration."""
    return xr.Dataset(
        {"restitution": e, "restitution_standard_error": error}, attrs={"method": method, "reason": "no reason"}
    )


def refused(reason):
    return xr.Dataset({"restitution": np.nan, "restitution_standard_error": np.nan}, attrs={"reason": reason})


def inputs(given=None, level=0.95, block=PRISM):
    return SpecimenInputs(block=block, given=given, level=level)


@pytest.mark.parametrize("level", [0.5, 0.9, 0.95])
def test_one_test_keeps_its_normal_interval_at_the_level(level):
    found = specimen({"a": identified(0.93, 0.002)}, inputs(level=level))
    half = stats.norm.ppf((1 + level) / 2) * 0.002
    limits = found["restitution_low"], found["restitution_high"]
    assert [float(each) for each in limits] == pytest.approx([0.93 - half, 0.93 + half], rel=1e-9)
    assert float(found["level"]) == level


@pytest.mark.parametrize(
    ("tests", "given_e", "spread"),
    [
        ({"a": identified(0.92, 1e-6), "b": identified(0.94, 1e-6)}, None, (np.sqrt(1.5) * 0.02 / np.sqrt(2), 1)),
        ({"a": identified(0.93, 0.003)}, None, (0.005, None)),
        ({"a": identified(0.93, 0.003)}, 0.95, (0.004, None)),
        ({}, None, (0.004, None)),
    ],
    ids=["two tests", "one test", "given", "rigid body"],
)
def test_predictions_take_e_of_a_new_test(tests, given_e, spread):
    found = restitution_spread(specimen(tests, inputs(given_e)), usual=0.004)
    assert found == (pytest.approx(spread[0], rel=1e-4), spread[1])


def test_a_refused_test_is_left_out_and_keeps_its_reason():
    tests = {"b": identified(0.93), "c": refused("no release"), "a": refused("no arc")}
    found, alone = specimen(tests, inputs()), specimen({"b": identified(0.93)}, inputs())
    assert found["test_id"].to_numpy().tolist() == ["b"]
    assert found.attrs["refused"] == ["a: no arc", "c: no release"]
    xr.testing.assert_equal(found, alone)
    assert found.attrs["warnings"] == []


@pytest.mark.parametrize(("count", "words"), [(1, "1 free vibration"), (2, "2 free vibrations")])
def test_the_method_names_that_of_the_tests_and_their_number(count, words):
    found = specimen({f"free-{number}": identified(0.93, method="peaks") for number in range(count)}, inputs())
    assert found.attrs["method"] == f"peaks; random effects over {words}"
    assert found.attrs["restitution_source"] == "identified"


def test_the_order_of_the_tests_does_not_matter():
    tests = {"b": identified(0.92), "a": identified(0.93, 0.003), "c": refused("x")}
    xr.testing.assert_identical(specimen(tests, inputs()), specimen(dict(reversed(tests.items())), inputs()))


@pytest.mark.parametrize(("given_e", "sides"), [(0.9, [0.9, 0.9]), ((0.9, 0.8), [0.9, 0.8])])
def test_a_given_e_comes_first_and_what_was_identified_is_kept(given_e, sides):
    found = specimen({"a": identified(0.93), "b": refused("no arc")}, inputs(given_e))
    assert found.attrs["restitution_source"] == "given"
    assert found["side_restitution"].to_numpy().tolist() == sides
    assert float(found["restitution"]) == pytest.approx(np.mean(sides))
    assert np.isnan(found["restitution_low"])
    assert np.isnan(found["restitution_high"])
    assert found["test_restitution"].to_numpy().tolist() == [0.93]
    assert found.attrs["refused"] == ["b: no arc"]
    assert found.attrs["warnings"] == []


REFUSED = {"b": refused("no arc"), "a": refused("no release")}


@every(
    ("tests", "severity", "why", "reason"),
    [
        ({}, Severity.NOTE, "because it has no free vibration", "no free vibration of this specimen was identified"),
        (REFUSED, Severity.WARNING, "because none of its free vibrations gives one", "a: no release; b: no arc"),
    ],
)
def test_else_the_rigid_body_gives_the_e_and_that_is_said(tests, severity, why, reason):
    found = specimen(tests, inputs())
    rigid = 1 - 1.5 * np.sin(PRISM.critical_angle) ** 2  # a rectangle: 2 m R b sin α / I₀ = 3/2 sin² α
    assert float(found["restitution"]) == pytest.approx(rigid)
    assert found.attrs["restitution_source"] == "rigid-body"
    assert found.attrs["reason"] == reason
    (finding,) = found.attrs["warnings"]
    assert (finding.kind, finding.severity) == ("rigid-body e", severity)
    assert f"{rigid:.4g}, {why}" in finding.text


STORED = {"a": identified(0.93), "b": identified(0.94, 0.002), "c": refused("no arc")}


@pytest.mark.parametrize("tests", [STORED, {"a": identified(0.93)}, {"c": refused("no arc")}], ids=len)
def test_a_stored_result_of_the_same_campaign_gives_itself(tests):
    stored = specimen(tests, inputs())
    xr.testing.assert_identical(taken(stored, inputs()), stored)


@pytest.mark.parametrize("now", [inputs(0.8), inputs(level=0.5)], ids=["given", "level"])
def test_a_stored_result_follows_the_campaign_of_now(now):
    xr.testing.assert_identical(taken(specimen(STORED, inputs()), now), specimen(STORED, now))


def test_an_e_that_is_not_given_any_more_is_the_identified_one_again():
    xr.testing.assert_identical(taken(specimen(STORED, inputs(0.8)), inputs()), specimen(STORED, inputs()))


def without_method(stored):
    return stored.drop_attrs().assign_attrs(refused=[])


@every("stored", [None, specimen(STORED, inputs(block=OTHER)), without_method(specimen(STORED, inputs()))])
def test_without_a_stored_result_of_this_block_the_rigid_body_gives_the_e(stored):
    found = taken(stored, inputs())
    assert found.attrs["restitution_source"] == "rigid-body"
    assert found.attrs["reason"] == "the free vibrations have not been identified"
    assert float(found["restitution"]) == pytest.approx(PRISM.restitution)
    assert found.sizes["test"] == 0


def test_the_properties_are_those_of_the_block():
    found = specimen({}, inputs(block=OTHER))
    for name in ("critical_angle", "pole_distance", "inertia", "p"):
        assert float(found[name]) == getattr(OTHER, name)
    assert float(found["rigid_restitution"]) == OTHER.restitution


def test_the_inputs_are_those_of_the_specimen(small_campaign):
    read = SpecimenInputs.of(small_campaign, "prism")
    assert read.block.critical_angle == pytest.approx(PRISM.critical_angle)
    assert (read.given, read.level) == (None, 0.95)
