"""The e of a specimen: pooled from its free vibrations, and the one rule for which e predictions use."""

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign.settings import PlaneEnsembleSettings
from colonnade.dynamics.block import Block
from colonnade.stages.specimen import SpecimenInputs, centre, specimen, spread_of, taken
from every import every
from prism import PRISM

OTHER = Block.prism(width=0.086, depth=0.086, height=0.500, mass=26.10)


def identified(e, error=0.001, *, method="peaks"):
    """The result of `restitution` of a free vibration."""
    joint = {
        "joint_mean": ("joint", np.array([np.log(e), 0.0, 0.0])),
        "joint_covariance": (("joint", "joint_column"), np.diag([(error / e) ** 2, 0.0, 0.0])),
    }
    found = {"restitution": e, "restitution_standard_error": error, **joint}
    return xr.Dataset(found, attrs={"method": method, "reason": "no reason"})


def jointly(e, mean, covariance):
    """The result of a free vibration that says what it does of e, α and p together."""
    found = identified(e, float(e * covariance[0][0] ** 0.5), method="history")
    return found.assign(joint_mean=("joint", mean), joint_covariance=(("joint", "joint_column"), np.array(covariance)))


def refused(reason):
    return xr.Dataset({"restitution": np.nan, "restitution_standard_error": np.nan}, attrs={"reason": reason})


def inputs(given=None, level=0.95, block=PRISM):
    return SpecimenInputs(block=block, given=given, level=level)


def test_a_refused_test_is_left_out_and_keeps_its_reason():
    tests = {"b": identified(0.93), "c": refused("no release"), "a": refused("no arc")}
    found, alone = specimen(tests, inputs()), specimen({"b": identified(0.93)}, inputs())
    assert found["test_id"].to_numpy().tolist() == ["b"]
    assert found.attrs["refused"] == ["a: no arc", "c: no release"]
    xr.testing.assert_equal(found, alone)
    assert found.attrs["warnings"] == []


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


@every(
    ("tests", "kinds", "reason"),
    [
        ({}, [], "no free vibration of this specimen was identified"),
        ({"b": refused("no arc"), "a": refused("no release")}, ["rigid-body e"], "a: no release; b: no arc"),
    ],
)
def test_else_the_rigid_body_gives_the_e_and_that_is_said_if_free_vibrations_should_have(tests, kinds, reason):
    found = specimen(tests, inputs())
    rigid = 1 - 1.5 * np.sin(PRISM.critical_angle) ** 2  # a rectangle: 2 m R b sin α / I₀ = 3/2 sin² α
    assert float(found["restitution"]) == pytest.approx(rigid)
    assert found.attrs["restitution_source"] == "rigid-body"
    assert found.attrs["reason"] == reason
    assert [each.kind for each in found.attrs["warnings"]] == kinds
    assert all(f"{rigid:.4g}, because none of its free vibrations gives one" in str(e) for e in found.attrs["warnings"])


STORED = {"a": identified(0.93), "b": identified(0.94, 0.002), "c": refused("no arc")}


@every(
    ("before", "now"),
    [(inputs(), inputs()), (inputs(), inputs(0.8)), (inputs(), inputs(level=0.5)), (inputs(0.8), inputs())],
)
def test_a_stored_result_follows_the_campaign_of_now(before, now):
    xr.testing.assert_identical(taken(specimen(STORED, before), now), specimen(STORED, now))


@every("stored", [None, specimen(STORED, inputs(block=OTHER)), specimen(STORED, inputs()).drop_vars("known")])
def test_without_a_stored_result_of_this_block_the_rigid_body_gives_the_e(stored):
    found = taken(stored, inputs())
    assert found.attrs["restitution_source"] == "rigid-body"
    assert found.attrs["reason"] == "the free vibrations have not been identified"
    assert float(found["restitution"]) == pytest.approx(PRISM.restitution)
    assert found.sizes["test"] == 0


COVARIANCE = 1e-6 * np.array([[4.0, 1.8, -2.4], [1.8, 9.0, -3.0], [-2.4, -3.0, 16.0]])
MEAN = np.array([np.log(0.93), 0.002, -0.003])
USUAL = PlaneEnsembleSettings(restitution=0.004, critical_angle=0.01, p=0.02)
KNOWN = inputs().model_copy(update={"known": (0.01, 0.02)})


def test_one_record_gives_the_centre_of_predictions_and_what_varies_together():
    found = specimen({"a": jointly(0.93, MEAN, COVARIANCE)}, KNOWN)
    block, spread = centre(found, PRISM), spread_of(found, USUAL)
    assert block.critical_angle / PRISM.critical_angle == pytest.approx(np.exp(0.002))
    assert block.p / PRISM.p == pytest.approx(np.exp(-0.003))
    assert (spread.critical_angle, spread.p) == (pytest.approx(0.003), pytest.approx(0.004))
    assert spread.restitution == pytest.approx(np.hypot(0.93 * 0.002, 0.004))
    # A new test's e scatters beside what it shares with α and p, which leaves the covariances as they are.
    assert spread.correlations[0] * spread.restitution / 0.93 * spread.critical_angle == pytest.approx(1.8e-6)
    assert spread.correlations[1] * spread.restitution / 0.93 * spread.p == pytest.approx(-2.4e-6)
    assert spread.correlations[2] * spread.critical_angle * spread.p == pytest.approx(-3.0e-6)


@every(("tests", "given_e"), [({"a": jointly(0.93, MEAN, COVARIANCE)}, 0.95), ({}, None)])
def test_where_e_is_not_identified_the_settings_vary_by_themselves(tests, given_e):
    found = specimen(tests, KNOWN.model_copy(update={"given": given_e}))
    spread = spread_of(found, USUAL)
    assert centre(found, PRISM) is PRISM
    assert (spread.critical_angle, spread.p, spread.correlations) == (0.01, 0.02, (0.0, 0.0, 0.0))
