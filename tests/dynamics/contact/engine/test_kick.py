"""The impulse of the contact: momentum by the forces, energy by the ledger."""

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import kick, points

STEP = 1e-3


def kicked(made, nodes=None):
    """Kick by the corners given, or all that are at most 1 m above the table."""
    body, state, near = made
    count = points.place_nodes(body, state, near, 1.0)
    if nodes is not None:
        for row, node in enumerate(nodes):
            near.node[row], near.slot[row] = node, node
            near.lever[row], near.depth[row] = near.lever[node].copy(), near.depth[node]
        count = len(nodes)
    kick.kick(body, state, near, count, STEP)
    return state


def energy(made):
    body, state, _ = made
    moving = 0.5 * body.mass * (state.rigid[3:6] ** 2).sum() + 0.5 * (state.rigid[10:13] ** 2 / body.inertia).sum()
    slip = 0.5 * body.contact[:, 2] @ (state.slip**2).sum(axis=1)
    return moving + slip + 0.5 * (state.strain[1] ** 2).sum()


def test_without_contact_nothing_changes(engine):
    made = engine(velocity=(1.0, 2.0, 3.0), spin=(1.0, 0.0, 0.0))
    before = made.state.rigid.copy()
    kick.kick(*made, 0, STEP)
    np.testing.assert_array_equal(made.state.rigid, before)
    assert not made.state.ledger.any()


def test_four_springs_push_up_and_do_not_turn(engine):
    made = engine(sunk=0.01)
    state = kicked(made)
    # Each damper already acts on the mean velocity of the step, which the kick itself makes.
    push, damping, mass = 4 * 1000.0 * 0.01, 4 * 20.0, made.body.mass
    assert state.rigid[5] == pytest.approx(STEP * push / (mass + 0.5 * STEP * damping), rel=1e-6)
    np.testing.assert_allclose(state.rigid[[3, 4, 10, 11, 12]], 0.0, atol=1e-15)
    assert state.total[2] == pytest.approx(mass * state.rigid[5] / STEP)


def test_one_corner_turns_the_body_by_its_lever(engine):
    made = engine(sunk=0.01)
    state = kicked(made, nodes=[3])
    x, y = made.body.nodes[3, :2]
    np.testing.assert_allclose(state.rigid[10:13], STEP * state.total[3:6], rtol=1e-12)
    upward = state.total[2]
    assert upward == pytest.approx(1000.0 * 0.01, rel=2e-2)
    lever = np.cross([x, y, -1.0], state.total[:3])
    np.testing.assert_allclose(state.total[3:6], lever, atol=1e-12)


@pytest.mark.parametrize(
    ("speed", "within", "elastic"),
    [(0.05, 1e-2, {}), (40.0, 1e-9, {}), (40.0, 1e-9, {"frequency": 50.0})],
    ids=["sticks", "slides", "slides and swings"],
)
def test_what_the_body_loses_is_in_the_ledger(engine, speed, within, elastic):
    """
    Kinetic energy and that of the slip, less the work of the normal springs, is what damping and friction took.

    Of a point that sticks to the order of the step: its slip grows by the velocity before the kick.
    """
    made = engine(sunk=0.01, velocity=(speed, 0.3 * speed, -0.2), spin=(0.1, 0.2, -0.3), **elastic)
    made.state.touched[:] = 1
    made.state.strain[1] = 0.3
    before = energy(made)
    state = kicked(made)
    load = made.near.load[:4]
    springs = STEP * (load[:, 3] * load[:, 11]).sum()
    assert state.ledger[1] > 0.0
    assert (state.ledger[2] > 0.0) == (not load[:, 6].any()) == (speed > 1.0)
    assert energy(made) - before == pytest.approx(springs - state.ledger[1:3].sum(), rel=within)


def test_a_mode_takes_its_share_of_the_impulse(engine):
    made = engine(sunk=0.01, frequency=50.0)
    state = kicked(made)
    assert state.strain[1, 0] == pytest.approx(0.25 * STEP * state.total[2], rel=1e-12)


def test_a_point_that_just_arrived_has_no_slip(engine):
    made = engine(sunk=0.01, velocity=(0.1, 0.0, 0.0))
    assert not kicked(made).slip.any()
    assert made.state.touched.all()
    assert (kicked(made).slip[:, 0] > 0.0).all()
