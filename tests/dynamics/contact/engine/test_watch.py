"""Impacts: an arc about one pole ends where the body touches elsewhere, and the next begins about the other."""

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import flight, watch
from colonnade.dynamics.contact.engine.state import IMPACT

LEFT, RIGHT, MIDDLE = -0.2, 0.2, 0.0


def touching(near, *places):
    """Let points at these x of the base be pressed; return how many."""
    near.load[:], near.lever[:] = 0.0, 0.0
    for row, place in enumerate(places):
        near.load[row, 3], near.lever[row, 3] = 1.0, place
    return len(places)


def watched(made, history):
    """Give the impacts of a history: at each time the x at which the body touches."""
    body, state, near = made
    found = np.zeros((1, IMPACT))
    for time, places in enumerate(history):
        count = touching(near, *places)
        found = watch.watch_impacts(body, state, near, count, (0.01 * time, 0.1 * time), 2.0, float(time), found)
    return found[: int(state.watch[1])], state


def test_over_from_one_pole_to_the_other_is_one_impact(engine):
    found, _ = watched(engine(), [(RIGHT,), (RIGHT,), (RIGHT, LEFT), (LEFT,)])
    assert len(found) == 1
    begin, angle, speed, base, pole, end, _, _, after, _ = found[0]
    assert (begin, end, pole, after, base) == (2.0, 3.0, 1.0, -1.0, 2.0)
    assert (angle, speed) == (0.02, pytest.approx(0.2))


def test_an_impact_that_does_not_end_has_no_end(engine):
    found, _ = watched(engine(), [(LEFT,), (MIDDLE,), (LEFT, RIGHT)])
    assert np.isnan(found[0, 5])


def test_a_hop_about_the_same_pole_is_no_impact(engine):
    found, state = watched(engine(), [(RIGHT,), (), (RIGHT,), ()])
    assert len(found) == 0
    assert state.watch[3] == 2.0  # steps without contact


def test_there_is_room_for_as_many_impacts_as_come(engine):
    found, _ = watched(engine(), [(RIGHT,), (LEFT,)] * 5)
    assert list(found[:, 4]) == [1.0, -1.0] * 4 + [1.0]


@pytest.mark.parametrize("angle", [0.0, 0.15, -0.1])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_turning_about_a_pole_has_the_speed_of_the_turn(engine, angle, side):
    body, state, _ = engine(spin=(0.0, 0.7, 0.0))
    state.rigid[6:10] = np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0
    flight.fill_rotation(state)
    arm = -state.matrix @ [side * body.half_width, 0.0, -body.height]
    state.rigid[3:6] = np.cross([0.0, 0.7, 0.0], arm)
    assert watch.about_pole(body, state, side) == pytest.approx((angle, 0.7), abs=1e-14)
