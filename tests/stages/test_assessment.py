"""The answer of an assessment, and the real column that it is of."""

import json
from math import sqrt

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import norm, t

from assessing import RATE, ground_motion
from colonnade.assessment.cases import run_cases
from colonnade.campaign.assessment import Assessment, Prototype
from colonnade.campaign.forms.assessed import UNCORRECTED, AssessmentSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import StageError
from colonnade.readers.record_set import GroundMotion, RecordSet
from colonnade.stages.assessment import assessment
from colonnade.stages.assessment_plan import AssessmentInputs, ColumnInputs, plan_assessment, real_column
from colonnade.stages.specimen import SpecimenInputs, taken
from colonnade.store import files
from colonnade.store.layout import Layout
from every import every
from prism import PRISM


@pytest.fixture(scope="module")
def stored(assessed):
    return files.read(Layout(assessed).stage("site", "assessment"))


@pytest.fixture(scope="module")
def answer(stored):
    return AssessmentSummary.model_validate_json(stored.attrs["answer"])


def test_shares_and_sliding_are_those_of_the_histories(stored, answer):
    assert (stored["case_outcome"].to_numpy()[..., 0] >= 0).all()
    overturned = stored["case_overturned"].to_numpy()[:, :, 1:, 0, 0]
    isotonic = stored["isotonic_probability"].to_numpy()
    assert isotonic.mean() == pytest.approx(overturned.mean())
    assert (np.diff(isotonic) >= 0).all()
    needed, friction = stored["case_friction"].to_numpy()[:, :, 0, 0], stored["drawn_friction"].to_numpy()[:, 1:]
    assert answer.sliding == pytest.approx((needed[:, :, None] > friction[:, None]).mean())


def test_a_stiffer_rebound_overturns_earlier_or_later_and_is_listed(answer):
    names = [each.name for each in answer.variants]
    assert names[0] == "nothing varied"
    assert len(names) == 4
    smaller, larger = answer.variants[2].restitution, answer.variants[3].restitution
    assert (smaller, larger) == pytest.approx((answer.restitution.value - 0.02, answer.restitution.value + 0.02))


def test_west_is_exact_without_vertical_motion(answer):
    west = next(each for each in answer.criteria if each.criterion == "west")
    assert (west.false_alarms, west.missed) == (0, 0)
    assert west.right_overturned + west.right_stands == 8 * 5


def test_the_result_holds_what_it_was_made_from(stored, answer):
    assert [each.record for each in answer.records_used] == stored["record"].to_numpy().tolist()
    used = answer.records_used[0]
    assert used.measures["pga"] == pytest.approx(3.0, rel=1e-6)
    assert json.loads(stored.attrs["settings"])["asked"]["records"] == "records"


def _plan(records, restitution="rigid-body", **keys):
    asked = Assessment.model_validate({"specimen": "prism", "records": "records", "draws": 1, "resamples": 100, **keys})
    prototype = Prototype.model_validate({"restitution": restitution})
    inputs = AssessmentInputs(block=PRISM, scale=20.0, prototype=prototype, specimen="prism", asked=asked)
    return plan_assessment(taken(None, SpecimenInputs(block=PRISM, given=None, level=0.95)), records, None, inputs)


def _answered(plan):
    outcomes = {name: run_cases(study.cases) for name, study in plan.studies.items()}
    return AssessmentSummary.model_validate_json(assessment(plan, outcomes).attrs["answer"])


def _records(offset):
    motions = [Motion(ground_motion(seed) + offset * (seed > 0), 1 / RATE) for seed in range(6)]
    records = (GroundMotion(f"r{seed}", each, ("x",), ()) for seed, each in enumerate(motions))
    return RecordSet(tuple(records), {}, ("cut",))


@pytest.mark.whole
def test_records_that_drift_have_an_answer_when_corrected_and_a_reason_as_they_are():
    plan = _plan(_records(0.05), "identified", baseline="linear", levels=["1 m/s", "2 m/s", "4 m/s"])
    assert "1 ground motion with a peak ground velocity; at least 2" in plan.without_correction
    assert plan.without_correction.count("the record drifts, by") == 3
    with pytest.raises(StageError, match=r'taken off by baseline = "linear" \(--baseline linear\)'):
        _plan(_records(0.05))
    found = _answered(plan)
    assert found.baseline == "linear"
    assert (found.variants[-1].name, found.variants[-1].reason) == (UNCORRECTED, plan.without_correction)
    assert "cut" in found.notes
    assert any("of a rigid body is assumed" in said for said in found.warnings)
    assert found.variants[0].records == 6


@pytest.mark.whole
@every(("levels", "side"), [(["0.01 m/s", "0.02 m/s"], "above"), (["80 m/s", "90 m/s"], "below")])
def test_what_is_beyond_the_levels_is_so_on_its_side(levels, side):
    found = _answered(_plan(_records(0.0), levels=levels))
    assert (found.five_percent.value, found.five_percent.beyond) == (None, side)
    assert side == "above" or not any("resamples" in said for said in found.warnings)


def pooled(e=(0.976, 0.976), tests=(0.975, 0.977), source="identified"):
    of_tests = {"test_restitution": ("test", np.array(tests))}
    of_tests["test_restitution_standard_error"] = ("test", np.full(len(tests), 1e-6))
    of_tests["test_joint_mean"] = (("test", "joint"), np.outer(np.log(tests), [1.0, 0.0, 0.0]))
    of_tests["test_joint_covariance"] = (("test", "joint", "column"), np.full((len(tests), 3, 3), 1e-12))
    of_tests["known"] = ("property", np.zeros(2))
    return xr.Dataset({"side_restitution": ("side", np.array(e)), "level": 0.95} | of_tests).assign_attrs(
        restitution_source=source
    )


GIVEN = pooled(tests=(), source="given")
OF_TWO = t.ppf(0.975, 1) * np.sqrt(1.5) * np.std([0.975, 0.977], ddof=1)
OF_ONE = norm.ppf(0.975) * 0.005  # the usual scatter between tests


def column(scale=20.0, stored=None, **written):
    inputs = ColumnInputs(block=PRISM, scale=scale, prototype=Prototype.model_validate(written))
    return real_column(inputs, pooled() if stored is None else stored)


@given(st.floats(0.1, 1000.0))
def test_a_larger_column_is_the_one_of_its_own_dimensions(scale):
    found, _ = column(scale, restitution=0.9)
    same = Block.prism(width=0.086 * scale, depth=0.086 * scale, height=0.456 * scale, mass=26.1 * scale**3)
    assert found.block.critical_angle == pytest.approx(same.critical_angle)
    assert found.block.p == pytest.approx(same.p)
    assert found.block.p == pytest.approx(PRISM.p / sqrt(scale))
    assert found.block.inertia == pytest.approx(same.inertia)


def test_what_is_given_replaces_what_follows_from_the_model():
    given_friction = {"friction": 0.6, "friction_range": [0.5, 0.7]}
    found, _ = column(restitution=0.9, critical_angle="0.17 rad", p="1.3 rad/s", **given_friction)
    assert (found.block.critical_angle, found.block.p) == pytest.approx((0.17, 1.3))
    assert (found.friction, found.friction_range) == (0.6, (0.5, 0.7))


@every(
    ("written", "stored", "value", "limits", "source"),
    [
        ({"restitution": "identified"}, pooled(), 0.976, (0.976 - OF_TWO, 0.976 + OF_TWO), "identified"),
        ({"restitution": "identified"}, pooled(tests=[0.976]), 0.976, (0.976 - OF_ONE, 0.976 + OF_ONE), "identified"),
        ({"restitution": "identified"}, GIVEN, 0.976, (0.956, 0.996), "given"),
        ({"restitution": "identified", "restitution_range": [0.9, 0.99]}, pooled(), 0.976, (0.9, 0.99), "identified"),
        ({"restitution": 0.95}, pooled(), 0.95, (0.93, 0.97), "given"),
        ({"restitution": 0.99}, pooled(), 0.99, (0.97, 1.0), "given"),
        ({"restitution": "rigid-body"}, pooled(), PRISM.restitution, None, "rigid-body"),
    ],
)
def test_e_is_the_one_that_is_stated(written, stored, value, limits, source):
    found, came_from = column(stored=stored, **written)
    limits = limits or (value - 0.02, value + 0.02)
    assert (found.restitution, came_from) == (pytest.approx(value), source)
    assert found.restitution_range == pytest.approx(limits)


def test_two_sides_keep_their_own_e():
    found, _ = column(stored=pooled((0.96, 0.98)), restitution="identified")
    assert found.restitution == (0.96, 0.98)
