"""Room for one step: as much as the body has points."""

from __future__ import annotations

import numpy as np

from colonnade.dynamics.contact.engine.state import POINTS, Near, State


def test_a_state_begins_without_contact_and_keeps_its_own_numbers(engine):
    body, _, _ = engine(frequency=5.0)
    rigid = np.arange(13)
    state = State.begin(body, rigid)
    rigid[0] = 99
    np.testing.assert_array_equal(state.rigid, np.arange(13.0))
    assert not any(part.any() for part in state[1:])
    assert (state.strain.shape, state.slip.shape) == ((2, 1), (4, 2))


def test_a_ring_has_room_for_its_points(engine):
    body, _, _ = engine()
    ringed = body._replace(radii=np.array([0.0, 0.1, 0.0, 0.0]), slots=np.cumsum([0, 1, POINTS, 1, 1]))
    near = Near.room(ringed)
    assert near.depth.shape == (POINTS + 3,)
    assert near.load.shape == (POINTS + 3, 14)
    assert State.begin(ringed, np.zeros(13)).slip.shape == (POINTS + 3, 2)
