"""Ensembles of the contact model: what is drawn, that it can be drawn anywhere, and what it does to the motion."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import spearmanr

from colonnade.dynamics.contact.body import ContactLaw, InSpace, rigid_body
from colonnade.dynamics.contact.calibration import free_restitution
from colonnade.dynamics.contact.ensemble import ContactPlan
from colonnade.dynamics.contact.simulate import plane_block, simulate
from colonnade.dynamics.motion import at_rest
from prism import PRISM

BODY = rigid_body(PRISM, grid=3)
LAW = ContactLaw(penetration=1e-5).bearing(BODY, PRISM.gravity)
BLOCK = plane_block(BODY, PRISM.gravity)
PLAN = ContactPlan(
    block=BLOCK,
    motion=at_rest(BLOCK, 0.5),
    space=InSpace(BODY, LAW, 5e-5),
    ranges={"friction": (0.3, 0.9), "damping_fraction": (0.1, 1.0), "out_of_plane": (0.0, 0.01 * PRISM.critical_angle)},
    theta0=0.4 * PRISM.critical_angle,
    count=12,
    seed=5,
)


@pytest.fixture(scope="module")
def ensemble():
    return PLAN.run()


def test_inputs_stay_in_their_ranges_and_differ(ensemble):
    for name, values in zip(PLAN.names, ensemble.inputs.T, strict=True):
        low, high = PLAN.ranges[name]
        assert low <= values.min() < values.max() <= high
        assert np.unique(values).size == PLAN.count


def test_a_member_is_the_run_with_what_it_drew_whoever_runs_it_and_when():
    (inputs, again), (_, first) = PLAN.member(7), replace(PLAN, count=8).member(7)
    friction, fraction, out_of_plane = inputs
    law = replace(LAW, friction=friction, damping_fraction=fraction)
    single = simulate(BODY, law=law, theta0=PLAN.theta0, duration=0.5, step=5e-5, out_of_plane=out_of_plane)
    np.testing.assert_array_equal(again.angle, single.angle)
    np.testing.assert_array_equal(again.angle, first.angle)
    assert replace(PLAN, seed=6).member(7)[0][0] != friction


def test_more_damping_takes_more_at_an_impact():
    plan = replace(PLAN, ranges=PLAN.ranges | {"friction": (0.6, 0.6), "out_of_plane": (0.0, 0.0)})
    inputs, histories = zip(*(plan.member(member) for member in range(plan.count)), strict=True)
    restitution = np.array([free_restitution(history) for history in histories])
    assert spearmanr(restitution, np.array(inputs)[:, 1]).statistic < -0.99
    assert np.all((restitution > 0.94) & (restitution < 0.99))


def test_bands_lie_in_their_order_about_the_run_with_nothing_varied(ensemble):
    plain = simulate(
        BODY, law=LAW, theta0=PLAN.theta0, duration=0.5, step=5e-5, out_of_plane=PLAN.ranges["out_of_plane"][1] / 2
    )
    np.testing.assert_array_equal(ensemble.central, plain.angle)
    np.testing.assert_array_equal(ensemble.time, plain.time)
    assert np.all(np.diff(ensemble.bands, axis=0) >= 0.0)
    np.testing.assert_allclose(ensemble.bands[:, 0], PLAN.theta0, atol=1e-6)
    assert np.ptp(ensemble.bands[:, -1]) > 1e-3 * PRISM.critical_angle


def test_a_block_released_past_its_critical_angle_overturns_in_every_member():
    ensemble = replace(PLAN, theta0=1.05 * PRISM.critical_angle, motion=at_rest(BLOCK, 2.0), count=2).run()
    assert ensemble.overturning_probability == 1.0
    assert np.all((ensemble.overturning_time >= 0.0) & (ensemble.overturning_time < 2.0))
    assert np.isnan(ensemble.peak_ratio).all()


def test_an_ensemble_without_members_is_refused():
    with pytest.raises(ValueError, match="at least one member"):
        replace(PLAN, count=0)
