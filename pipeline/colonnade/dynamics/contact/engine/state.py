"""The data of the contact engine: the body and its law as arrays, its state, and work space for one step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array

Whole = NDArray[np.int64]

COLUMNS = 26
"""Of the samples: position 0:3, velocity 3:6, quaternion 6:10, angular velocity 10:13 (body axes), lowest point 13,
force on the body 14:17 (mean since the sample before), kinetic, potential, strain, contact energy 17:21, work of the
table 21, dissipated by contact, friction, bulk 22:25, time without contact 25."""

IMPACT = 10
"""Columns of the impacts: begin, angle, speed, base acceleration, pole (±1); end (NaN where it does not), angle, speed,
pole; largest |angle| since the impact before. A speed is the angular momentum about the pole over the inertia about it,
which the contact's own vibration does not change."""


POINTS = 8
"""At which a ring's arc of contact is integrated (Gauss and Legendre)."""


class Body(NamedTuple):
    """
    What does not change, as `ContactBody` and `ContactLaw` have it.

    propagators, shape (4, m): η → a η + b η̇ and η̇ → c η + d η̇ over half a step, exactly; radii, shape (n,): 0 of a
    point; slots, shape (n + 1,): where the points of each node begin, one of a point and `POINTS` of a ring; arc, shape
    (2, POINTS): places of a ring's points along half an arc either way, and their weights, which add up to 2; contact,
    shape (n, 4): normal stiffness and damping, tangential stiffness and damping of each node, of a ring all around.
    """

    mass: float
    gravity: float
    inertia: Array
    nodes: Array
    modes: Array
    frequencies: Array
    propagators: Array
    radii: Array
    slots: Whole
    arc: Array
    half_width: float
    height: float
    contact: Array
    friction: float


class State(NamedTuple):
    """
    What changes.

    rigid, shape (13,): position, velocity, quaternion, angular momentum in the body's axes; strain, shape (2, m): η
    and η̇; matrix, shape (3, 3): rotation, body to table; slip, shape (s, 2): elastic slip of each point; touched,
    shape (s,): 1 where the point touched in the last step; arcs, shape (n, 2): direction of a ring's lowest point in
    the body and half the arc (rad) that its points span, 0 where it is off the table; ledger: work of the table,
    dissipated by contact, friction, bulk; total: force and moment of the contact in this step; watch: pole rocked on
    (±1; 0 at first, 2 in an impact), impacts so far, largest |angle| since the last one, time without contact.
    """

    rigid: Array
    strain: Array
    matrix: Array
    slip: Array
    touched: Whole
    arcs: Array
    ledger: Array
    total: Array
    watch: Array

    @classmethod
    def begin(cls, body: Body, rigid: Array) -> State:
        """Give the state of a body that touches nothing yet and is not strained."""
        count = int(body.slots[-1])
        return cls(
            np.array(rigid, dtype=np.float64),
            np.zeros((2, body.frequencies.size)),
            np.zeros((3, 3)),
            np.zeros((count, 2)),
            np.zeros(count, np.int64),
            np.zeros((len(body.nodes), 2)),
            np.zeros(4),
            np.zeros(6),
            np.zeros(4),
        )


class Near(NamedTuple):
    """
    The points that may touch in a step, a row each, and room for the kick.

    node: of which; slot: which; share: of its node's stiffness and damping; lever, shape (s, 6): in table axes, in
    body axes; depth; load, shape (s, 14): force 0:3, its elastic normal part 3, slip left 4:6, whether it sticks 6,
    slip that the normal force still holds 7:9, velocity 9:12, the slip's increase over the step 12:14; speeds: mean v
    and ω in table axes; change: of velocity and angular momentum; gain: of η̇; rates: mean η̇; carried: slip of a
    ring's points at their new places.
    """

    node: Whole
    slot: Whole
    share: Array
    lever: Array
    depth: Array
    load: Array
    speeds: Array
    change: Array
    gain: Array
    rates: Array
    carried: Array

    @classmethod
    def room(cls, body: Body) -> Near:
        """Give room for all points of a body."""
        count, kept = int(body.slots[-1]), body.frequencies.size
        return cls(
            np.zeros(count, np.int64),
            np.zeros(count, np.int64),
            np.zeros(count),
            np.zeros((count, 6)),
            np.zeros(count),
            np.zeros((count, 14)),
            np.zeros(6),
            np.zeros(6),
            np.zeros(kept),
            np.zeros(kept),
            np.zeros((POINTS, 2)),
        )
