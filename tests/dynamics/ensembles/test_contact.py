"""Ensembles of the contact model: what is drawn, that it can be drawn anywhere, and what it does to the motion."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.ensembles.contact import INPUTS, ContactPlan, gather, run_member
from prism import PRISM

BODY = rigid_body(PRISM, grid=(3, 3))
LAW = ContactLaw.stiff(BODY, PRISM.gravity, penetration=1e-5)
PLAN = ContactPlan(
    BODY,
    LAW,
    friction=(0.3, 0.9),
    damping_fraction=(0.1, 1.0),
    out_of_plane=(0.0, 0.01 * PRISM.critical_angle),
    duration=0.5,
    theta0=0.4 * PRISM.critical_angle,
    step=5e-5,
    count=12,
    seed=5,
)


@pytest.fixture(scope="module")
def ensemble():
    return gather(PLAN, [run_member(PLAN, member) for member in range(PLAN.count)])


def test_inputs_stay_in_their_ranges_and_differ(ensemble):
    for name, values in zip(INPUTS, ensemble.inputs.T, strict=True):
        low, high = getattr(PLAN, name)
        assert low <= values.min() < values.max() <= high
        assert np.unique(values).size == PLAN.count


def test_a_member_is_the_run_with_what_it_drew_whoever_runs_it_and_when():
    again, first = run_member(PLAN, 7), run_member(replace(PLAN, count=8), 7)
    friction, fraction, out_of_plane = again.inputs
    law = replace(LAW, friction=friction, damping_fraction=fraction)
    single = simulate(BODY, law=law, theta0=PLAN.theta0, duration=0.5, step=5e-5, out_of_plane=out_of_plane)
    np.testing.assert_array_equal(again.angle, single.angle)
    np.testing.assert_array_equal(again.angle, first.angle)
    assert run_member(replace(PLAN, seed=6), 7).inputs[0] != friction


def test_more_damping_takes_more_at_an_impact(ensemble):
    correlations = ensemble.correlations(ensemble.restitution)
    assert correlations.keys() == set(INPUTS)
    assert correlations["damping_fraction"] < -0.9
    assert np.all((ensemble.restitution > 0.94) & (ensemble.restitution < 0.99))


def test_bands_lie_in_their_order_about_the_run_with_nothing_varied(ensemble):
    plain = simulate(BODY, law=LAW, theta0=PLAN.theta0, duration=0.5, step=5e-5, out_of_plane=PLAN.out_of_plane[1] / 2)
    np.testing.assert_array_equal(ensemble.central, plain.angle)
    np.testing.assert_array_equal(ensemble.time, plain.time)
    assert np.all(np.diff(ensemble.bands, axis=0) >= 0.0)
    np.testing.assert_allclose(ensemble.bands[:, 0], PLAN.theta0, atol=1e-6)
    assert np.ptp(ensemble.bands[:, -1]) > 1e-3 * PRISM.critical_angle


def test_a_block_released_past_its_critical_angle_overturns_in_every_member():
    plan = replace(PLAN, theta0=1.05 * PRISM.critical_angle, duration=2.0, count=2)
    ensemble = gather(plan, [run_member(plan, member) for member in range(2)])
    assert ensemble.overturning_probability == 1.0
    assert np.all((ensemble.overturning_time >= 0.0) & (ensemble.overturning_time < 2.0))
    assert np.isnan(ensemble.peak_ratio).all()


@pytest.mark.parametrize(
    ("change", "told"),
    [({"count": 0}, "at least one member"), ({"friction": (0.9, 0.3)}, "friction is .0.9, 0.3.")],
    ids=["no members", "a range upside down"],
)
def test_a_plan_that_cannot_be_is_refused(change, told):
    with pytest.raises(ValueError, match=told):
        replace(PLAN, **change)


def test_a_member_beyond_the_plan_is_refused():
    with pytest.raises(IndexError, match="member is 12"):
        run_member(PLAN, 12)
    with pytest.raises(ValueError, match="0 members; 12 were expected"):
        gather(PLAN, [])
