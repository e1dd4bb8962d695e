"""The data of the contact engine: bodies, interfaces and nodes as arrays, their state, and work space for one step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array

Whole = NDArray[np.int64]

TABLE = -1
"""In the place of the body below an interface."""

POINTS = 8
"""At which a ring's arc of contact is integrated (Gauss and Legendre)."""

IMPACT = 11
"""Columns of the impacts: begin, angle, speed, base acceleration, pole (±1); end (NaN where it does not), angle, speed,
pole; largest |angle| since the impact before; joint. A speed is the angular momentum about the pole over the inertia
about it, which the contact's own vibration does not change."""


class System(NamedTuple):
    """
    What does not change.

    Of each body: mass; inertia, shape (b, 3); lowest: height of the centre of mass below which it has fallen.

    Of each interface: carrier of its nodes; target, whose face they meet; flip, −1 where that is its base; face, how
    far it is from the target's centre of mass, out of it; outline, shape (s, 4): half lengths along x and y, or the
    radius, width of the band within which a node at the edge fades, and 1 of a circle; friction; first, shape (s + 1,),
    where its nodes begin; reach, of the farthest one.

    Of each node: place in the carrier's axes; radius, 0 of a point; slots, shape (n + 1,), where its points begin, one
    of a point and as many as `arc` has of a ring; stiffness and damping, of a ring all around. arc, shape (2, k):
    places of a ring's points along half an arc either way, and their weights, which add up to 2.

    Of each joint, which is one interface or two: sides, shape (j + 1,), where they begin; poles, shape (j, 3): middle
    along x, half width and depth below the centre of mass in the upper body's axes.

    Of the elastic modes of a single body: modes, shape (n, 3, m); frequencies; propagators, shape (4, m), over half a
    step exactly: η → a η + b η̇ and η̇ → c η + d η̇; bend, the largest shape at a node.
    """

    gravity: float
    mass: Array
    inertia: Array
    lowest: Array
    carrier: Whole
    target: Whole
    flip: Array
    face: Array
    outline: Array
    friction: Array
    first: Whole
    reach: Array
    nodes: Array
    radii: Array
    slots: Whole
    stiffness: Array
    damping: Array
    arc: Array
    sides: Whole
    poles: Array
    modes: Array
    frequencies: Array
    propagators: Array
    bend: float


class State(NamedTuple):
    """
    What changes, and work space for a step.

    rigid, shape (b, 13): position, velocity, quaternion, angular momentum in the body's axes; matrix, shape (b, 3, 3):
    rotation, body to table; stands, shape (b,): 0 of a body that has fallen and is left where it lies; strain, shape
    (4, m): η, η̇, its gain in the step and its mean; slip, shape (p, 2): elastic slip of each point; touched, shape
    (p,): 1 where the point touched in the last step; entry, shape (p,): how deep it was as it came over the outline of
    a face from below (m), from where on it bears, and −1 less that where it is off the face; arcs, shape (n, 2):
    direction of a ring's lowest point in the carrier and half the arc (rad) that its points span, 0 where it is off the
    face; work: of the table and lost by the modes; lost, shape (s, 2): taken by contact and friction; force, shape (j,
    3): on the upper body in this step, in the table's axes; watch, shape (j, 6): pole rocked on (±1; 0 at first, 2 in
    an impact), its last impact, largest |angle| since then, steps without contact, angle and speed about the pole
    before the kick; hits: number of impacts of all joints. The rest is of one step.

    Of each interface: frame, shape (s, 3, 3): the target's axes to the table's; turned, shape (s, 3, 3), and apart,
    shape (s, 3): carrier to target, from the face's middle; twist, shape (s, 6): v and ω of the carrier relative to the
    target, in its axes; listed, shape (s + 1,): where its points begin in the list of those that may touch. Of each
    such point: node; slot; share of its node's stiffness and damping; lever, shape (p, 6): in the target's axes, in
    the carrier's; depth; load, shape (p, 14): force 0:3, its elastic normal part 3, slip left 4:6, whether it sticks 6,
    slip that the normal force still holds 7:9, velocity 9:12, the slip's increase over the step 12:14. Of each body:
    speeds, shape (b, 6): v and ω in the table's axes; change, shape (b, 6): of velocity and angular momentum; total,
    shape (b, 6): force and moment. carried: slip of a ring's points at their new places. pull: minus the table's
    acceleration.
    """

    rigid: Array
    matrix: Array
    stands: Whole
    strain: Array
    slip: Array
    touched: Whole
    entry: Array
    arcs: Array
    work: Array
    lost: Array
    force: Array
    watch: Array
    hits: Whole
    frame: Array
    turned: Array
    apart: Array
    twist: Array
    listed: Whole
    node: Whole
    slot: Whole
    share: Array
    lever: Array
    depth: Array
    load: Array
    speeds: Array
    change: Array
    total: Array
    carried: Array
    pull: Array

    @classmethod
    def begin(cls, system: System, rows: Array) -> State:
        """Give the state of bodies, by `Start.row`, that touch nothing yet and are not strained."""
        bodies, sides, joints = len(system.mass), len(system.carrier), len(system.poles)
        points = int(system.slots[-1])
        rigid = rows.copy()
        rigid[:, 10:] *= system.inertia
        return cls(
            rigid,
            np.zeros((bodies, 3, 3)),
            np.ones(bodies, np.int64),
            np.zeros((4, system.frequencies.size)),
            np.zeros((points, 2)),
            np.zeros(points, np.int64),
            np.zeros(points),
            np.zeros((len(system.nodes), 2)),
            np.zeros(2),
            np.zeros((sides, 2)),
            np.zeros((joints, 3)),
            np.zeros((joints, 6)),
            np.zeros(1, np.int64),
            np.zeros((sides, 3, 3)),
            np.zeros((sides, 3, 3)),
            np.zeros((sides, 3)),
            np.zeros((sides, 6)),
            np.zeros(sides + 1, np.int64),
            np.zeros(points, np.int64),
            np.zeros(points, np.int64),
            np.zeros(points),
            np.zeros((points, 6)),
            np.zeros(points),
            np.zeros((points, 14)),
            np.zeros((bodies, 6)),
            np.zeros((bodies, 6)),
            np.zeros((bodies, 6)),
            np.zeros((system.arc.shape[1], 2)),
            np.zeros(3),
        )
