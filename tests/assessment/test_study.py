"""Studies of a column: records scaled to levels of a measure, and outcomes judged."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assessing import RATE, ground_motion
from colonnade.assessment.cases import OnContact, in_plane, run_cases
from colonnade.assessment.hazard import hazard_curve
from colonnade.assessment.intervals import Resampling
from colonnade.assessment.measures import intensity_measures
from colonnade.assessment.real_column import RealColumn
from colonnade.assessment.study import fragility, judge, plan_study
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import OVERTURNS, ROCKS
from colonnade.dynamics.rock import rock

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
        found = intensity_measures(scaled, COLUMN.block, measures=[measure])
        assert found.values[study.measure.id] == pytest.approx(level, rel=1e-9)


def test_a_record_that_drifts_has_no_velocity_and_is_left_out_unless_it_is_corrected():
    off = ground_motion(7) + 0.05
    half = Motion(ground_motion(6), 1 / RATE, transverse=off)
    drifting = MOTIONS | {"drifts": Motion(off, 1 / RATE), "half": half}
    study = plan_study(COLUMN, drifting, levels=[1.0], draws=1)
    assert study.left_out.keys() == {"drifts, component x", "half, component y"}
    assert ("drifts" in study.names, "half" in study.names) == (False, True)
    corrected = plan_study(COLUMN, drifting, levels=[1.0], draws=1, baseline="linear")
    assert "drifts" in corrected.names
    assert corrected.drift[corrected.names.index("drifts")] < 0.1
    with pytest.raises(ValueError, match="No record has a peak ground velocity"):
        plan_study(COLUMN, {"drifts": drifting["drifts"]}, levels=[1.0])


def test_outcomes_are_judged_as_they_are():
    study = plan_study(COLUMN, MOTIONS, measure="pga", levels=[3.0, 6.0, 9.0, 15.0, 25.0], draws=2, measures=["pga"])
    outcomes = run_cases(study.cases)
    hazard = hazard_curve([1.0, 20.0], [1e-2, 1e-6])
    found = judge(study, outcomes, Resampling(100), hazard=hazard)
    assert found.isotonic.probability.value.mean() == pytest.approx(outcomes.exceeds()[:, :, 1:, :, 0].mean())
    assert found.uplift.reason == "always"
    assert found.rate is not None
    stricter = judge(study, outcomes, Resampling(100), overturned=0.2)
    assert stricter.outcomes.overturned.sum() > found.outcomes.overturned.sum()


def test_a_measure_that_does_not_grow_is_refused():
    with pytest.raises(ValueError, match="does not grow"):
        plan_study(COLUMN, MOTIONS, measure="d5_95")


def test_records_without_a_history_leave_no_answer_if_there_are_no_others():
    motions = {
        name: Motion(each.acceleration, each.dt, vertical=20.0 * each.acceleration) for name, each in MOTIONS.items()
    }
    study = plan_study(COLUMN, motions | {"still": Motion(np.zeros(400), 1 / RATE)}, levels=[2.0, 4.0], draws=1)
    assert study.left_out == {"still, component x": "it does not move"}
    with pytest.raises(ValueError, match="No record can be run"):
        judge(study, run_cases(study.cases), Resampling(20))


DRUM = Block.prism(width=0.2, depth=0.2, height=0.2, mass=20.0)
PILLAR = Block.prism(width=0.1, depth=0.1, height=0.5, mass=10.0)
LAW = ContactLaw(penetration=1e-4, damping_fraction=1.0)
TIME = np.arange(0.0, 1.2, 0.005)


def pulse(frequency):
    """One period of a sine."""
    inside = (TIME > 0.1) & (0.1 + 1 / frequency > TIME)
    return Motion(np.where(inside, np.sin(2 * np.pi * frequency * (TIME - 0.1)), 0.0), 0.005)


@pytest.mark.whole
def test_several_bodies_overturn_or_end_too_far_from_their_places():
    column, motions = Assembly.stack(a=DRUM, b=DRUM, c=DRUM), [pulse(1.7), pulse(2.0)]
    found = fragility(column, motions, levels=[0.6, 2.0], contact=LAW, displaced=1e-3, draws=1, resamples=100)
    assert found.outcomes.overturned[:, :, 0, 0].tolist() == [[False, True], [True, True]]
    factor = 0.6 / intensity_measures(motions[0], measures=["pgv"]).values["pgv"]
    history = rock(column, Motion(factor * motions[0].acceleration, 0.005), model="contact", contact=LAW)
    assert found.outcomes.peak[0, 0, 0, 0] == pytest.approx(history.peak_ratio, rel=1e-6)


@pytest.mark.whole
def test_friction_is_that_of_the_draw():
    column, strong = (
        OnContact(Assembly.stack(a=DRUM, b=DRUM), LAW, displaced=1e-3),
        Motion(3 * pulse(2.0).acceleration, 0.005),
    )
    assert [column.end(strong, friction)[0] for friction in (0.1, np.nan)] == [OVERTURNS, ROCKS]


def test_bodies_that_mirror_each_other_are_run_with_one_sign():
    portal = Assembly.frame(PILLAR, Block.prism(width=1.0, depth=0.1, height=0.1, mass=20.0), span=0.8)
    assert OnContact(portal, LAW).is_symmetric
    aside = {name: replace(body, position=(body.position[0] + 0.1, 0.0)) for name, body in portal.bodies.items()}
    assert not OnContact(Assembly(aside), LAW).is_symmetric


def test_what_is_for_several_bodies_is_refused_for_one_and_the_reverse():
    with pytest.raises(ValueError, match="are for an Assembly; a Block was found"):
        fragility(DRUM, [pulse(1.0)] * 2, displaced=0.01)
    with pytest.raises(ValueError, match="a ContactLaw was expected"):
        fragility(Assembly.stack(a=DRUM, b=DRUM), [pulse(1.0)] * 2, contact="soft")
    with pytest.raises(ValueError, match="levels are needed for several bodies"):
        fragility(Assembly.stack(a=DRUM, b=DRUM), [pulse(1.0)] * 2)
