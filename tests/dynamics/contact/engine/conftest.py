"""A small body for single kernels of the contact engine, with numbers that are easy to reckon with."""

from typing import NamedTuple

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import flight, force, kick, points, rings, sample, watch
from colonnade.dynamics.contact.engine.state import POINTS, Body, Near, State

MASS, GRAVITY = 8.0, 10.0
INERTIA = (2.0, 3.0, 0.5)
HALF_WIDTH, HALF_DEPTH, HEIGHT = 0.2, 0.3, 1.0
STIFFNESS, DAMPING, TANGENTIAL, TANGENTIAL_DAMPING = 1000.0, 20.0, 400.0, 10.0
FRICTION = 0.5


class Engine(NamedTuple):
    """What a kernel works on."""

    body: Body
    state: State
    near: Near


@pytest.fixture
def engine(interpreted):
    """A box on its four corners, its centre of mass at the height 1 m, as it stands; with one mode if asked for."""
    interpreted(flight, force, kick, points, rings, sample, watch)

    def make(*, frequency=None, propagators=None, velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0), sunk=0.0):
        nodes = [(x, y, -HEIGHT) for x in (-HALF_WIDTH, HALF_WIDTH) for y in (-HALF_DEPTH, HALF_DEPTH)]
        kept = 0 if frequency is None else 1
        modes = np.zeros((4, 3, kept))
        modes[:, 2] = 0.25
        body = Body(
            MASS,
            GRAVITY,
            np.array(INERTIA),
            np.array(nodes),
            modes,
            np.full(kept, frequency or 0.0),
            np.array(propagators or np.zeros(4 * kept)).reshape(4, kept),
            np.zeros(4),
            np.arange(5),
            np.array(np.polynomial.legendre.leggauss(POINTS)),
            HALF_WIDTH,
            HEIGHT,
            np.tile([STIFFNESS, DAMPING, TANGENTIAL, TANGENTIAL_DAMPING], (4, 1)),
            FRICTION,
        )
        rigid = [0.0, 0.0, HEIGHT - sunk, *velocity, 1.0, 0.0, 0.0, 0.0, *(np.array(INERTIA) * spin)]
        state = State.begin(body, np.array(rigid))
        flight.fill_rotation(state)
        return Engine(body, state, Near.room(body))

    return make
