"""What the contact engine works on: the body and its law as arrays, its state, and room for one step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

COLUMNS = 26
"""Of the samples: position 0:3, velocity 3:6, quaternion 6:10, angular velocity 10:13 (body axes), lowest point 13,
force on the body 14:17 (mean since the sample before), kinetic, potential, strain, contact energy 17:21, work of the
table 21, dissipated by contact, friction, bulk 22:25, time without contact 25."""

IMPACT = 10
"""Columns of the impacts: begin, angle, speed, base acceleration, pole (±1); end (NaN where it does not), angle, speed,
pole; largest |angle| since the impact before. A speed is the angular momentum about the pole over the inertia about it,
which the contact's own vibration does not change."""


class Body(NamedTuple):
    """
    What does not change, as `ContactBody` and `ContactLaw` have it.

    propagators, shape (4, m): η → a η + b η̇ and η̇ → c η + d η̇ over half a step, exactly; contact, shape (n, 4): normal
    stiffness and damping, tangential stiffness and damping of each node.
    """

    mass: float
    gravity: float
    inertia: Array
    nodes: Array
    modes: Array
    frequencies: Array
    propagators: Array
    rim: float
    half_width: float
    height: float
    contact: Array
    friction: float


class State(NamedTuple):
    """
    What changes.

    rigid, shape (13,): position, velocity, quaternion, angular momentum in the body's axes; strain, shape (2, m): η and
    η̇; matrix, shape (3, 3): rotation, body to table; slip, shape (n, 2): elastic slip; touched, shape (n,): 1 where the
    node touched in the last step; ledger: work of the table, dissipated by contact, friction, bulk; total: force and
    moment of the contact in this step; watch: pole rocked on (±1; 0 at first, 2 in an impact), impacts so far, largest
    |angle| since the last one, time without contact.
    """

    rigid: Array
    strain: Array
    matrix: Array
    slip: Array
    touched: Whole
    ledger: Array
    total: Array
    watch: Array

    @classmethod
    def begin(cls, body: Body, rigid: Array) -> State:
        """Give the state of a body that touches nothing yet and is not strained."""
        count, kept = len(body.nodes), body.frequencies.size
        return cls(
            np.array(rigid, dtype=np.float64),
            np.zeros((2, kept)),
            np.zeros((3, 3)),
            np.zeros((count, 2)),
            np.zeros(count, np.int64),
            np.zeros(4),
            np.zeros(6),
            np.zeros(4),
        )


class Near(NamedTuple):
    """
    The nodes that may touch in a step, a row each, and room for the kick.

    node: which; lever, shape (n, 6): in table axes, in body axes; depth; load, shape (n, 14): force 0:3, its elastic
    normal part 3, slip left 4:6, whether it sticks 6, slip that the normal force still holds 7:9, velocity 9:12, the
    slip's increase over the step 12:14; speeds: mean v and ω in table axes; change: of velocity and angular momentum;
    gain: of η̇; rates: mean η̇.
    """

    node: Whole
    lever: Array
    depth: Array
    load: Array
    speeds: Array
    change: Array
    gain: Array
    rates: Array

    @classmethod
    def room(cls, body: Body) -> Near:
        """Give room for all nodes of a body."""
        count, kept = len(body.nodes), body.frequencies.size
        return cls(
            np.zeros(count, np.int64),
            np.zeros((count, 6)),
            np.zeros(count),
            np.zeros((count, 14)),
            np.zeros(6),
            np.zeros(6),
            np.zeros(kept),
            np.zeros(kept),
        )
