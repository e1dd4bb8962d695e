"""Studies of a column: records scaled to levels of a measure, and outcomes judged."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assessing import RATE, ground_motion
from colonnade.assessment.cases import in_plane, run_cases
from colonnade.assessment.hazard import hazard_curve
from colonnade.assessment.intervals import Resampling
from colonnade.assessment.measures import intensity_measures
from colonnade.assessment.real_column import RealColumn
from colonnade.assessment.study import judge, plan_study
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion

COLUMN = RealColumn(Block.prism(width=1.7, depth=1.7, height=9.1, mass=1000.0), 0.9, restitution_range=(0.85, 0.95))
MOTIONS = {f"r{seed}": Motion(ground_motion(seed), 1 / RATE) for seed in range(6)}
LEVELS = {"pgv": [0.8, 1.5, 3.0], "pga": [3.0, 6.0, 12.0], "arias": [0.5, 2.0, 8.0], "sa(0.5 s)": [2.0, 5.0]}


@pytest.mark.whole
@settings(max_examples=8)
@given(st.sampled_from(list(LEVELS)), st.integers(0, 5))
def test_a_scaled_record_has_the_level_of_its_measure(measure, record):
    study = plan_study(COLUMN, MOTIONS, measure=measure, levels=LEVELS[measure], draws=1)
    for place, level in enumerate(study.levels):
        scaled = in_plane(study.cases.motions[record], 0, float(study.cases.factors[record, place, 0]))
        found = intensity_measures(scaled, measures=[measure], gravity=COLUMN.block.gravity)
        assert found.values[study.measure.id] == pytest.approx(level, rel=1e-9)


def test_a_record_that_drifts_has_no_velocity_and_is_left_out_unless_it_is_corrected():
    drifting = MOTIONS | {"drifts": Motion(ground_motion(7) + 0.05, 1 / RATE)}
    study = plan_study(COLUMN, drifting, levels=[1.0], draws=1)
    assert study.left_out.keys() == {"drifts"}
    assert "drifts" not in study.names
    corrected = plan_study(COLUMN, drifting, levels=[1.0], draws=1, baseline="linear")
    assert "drifts" in corrected.names
    assert corrected.drift[corrected.names.index("drifts")] < 0.1
    with pytest.raises(ValueError, match="No record has a peak ground velocity"):
        plan_study(COLUMN, {"drifts": drifting["drifts"]}, levels=[1.0])


def test_chosen_levels_go_from_nothing_to_everything():
    study = plan_study(COLUMN, MOTIONS, draws=1)
    shares = run_cases(study.cases).exceeds()[:, :, 0, 0, 0].mean(axis=0)
    assert shares[0] == 0.0
    assert shares[-1] == 1.0


def test_outcomes_are_judged_as_they_are():
    study = plan_study(COLUMN, MOTIONS, measure="pga", levels=[3.0, 6.0, 9.0, 15.0, 25.0], draws=2, measures=["pga"])
    outcomes = run_cases(study.cases)
    hazard = hazard_curve([1.0, 20.0], [1e-2, 1e-6])
    found = judge(study, outcomes, Resampling(100), hazard=hazard)
    assert found.isotonic.probability.value.mean() == pytest.approx(outcomes.exceeds()[:, :, 1:, :, 0].mean())
    assert found.uplift.threshold == pytest.approx((COLUMN.block.uplift_acceleration,) * 2, rel=1e-9)
    assert found.rate is not None
    stricter = judge(study, outcomes, Resampling(100), overturned=0.2)
    assert stricter.outcomes.overturned.sum() > found.outcomes.overturned.sum()


def test_a_measure_that_does_not_grow_is_refused():
    with pytest.raises(ValueError, match="does not grow"):
        plan_study(COLUMN, MOTIONS, measure="d5_95")


def test_a_component_that_drifts_is_named_while_its_record_is_run():
    still, drifts = ground_motion(7), ground_motion(6) + 0.05
    motions = MOTIONS | {"half": Motion(still, 1 / RATE, transverse=drifts)}
    study = plan_study(COLUMN, motions, levels=[1.0], draws=1)
    assert study.left_out.keys() == {"half, component y"}
    assert "half" in study.names


def test_a_record_whose_base_falls_away_at_all_levels_is_named_and_the_rest_is_judged():
    motion = MOTIONS["r0"]
    motions = MOTIONS | {"falls": Motion(motion.acceleration, motion.dt, vertical=20.0 * motion.acceleration)}
    study = plan_study(COLUMN, motions, levels=[2.0, 4.0], draws=1)
    assert study.left_out.keys() == {"falls"}
    assert "falls faster" in study.left_out["falls"]
    assert study.names == tuple(MOTIONS)
    assert len(study.drift) == len(study.values["pgv"]) == len(study.cases.draws) == len(MOTIONS)
    assert judge(study, run_cases(study.cases), Resampling(20)).outcomes.records == study.names
