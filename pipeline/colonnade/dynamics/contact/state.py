"""The data of the contact engine: bodies, interfaces and nodes as arrays, their state, and work space for one step."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple, get_args, get_type_hints

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import rotation_matrices

Whole = NDArray[np.int64]

TABLE = -1
"""In the place of a body: of all that is kept of bodies, the table is the last row, which stays where it is."""

POINTS = 8
"""At which a ring's arc of contact is integrated (Gauss and Legendre)."""


class System(NamedTuple):
    """
    What does not change.

    Of each body: mass; inertia, shape (b, 3); lowest: height of the centre of mass below which it has fallen.

    Of each interface: carrier of its nodes; target, whose face they meet, the base of it if that is the upper body;
    face, shape (s, 5): half lengths along x and y, or the radius, width of the band within which a node at the edge
    fades, 1 of a circle, and how far it is from the target's centre of mass, out of it; first, shape (s + 1,), where
    its nodes begin; reach, of the farthest one.

    Of each node: place in the carrier's axes; radius, 0 of a point; slots, shape (n + 1,), where its points begin, one
    of a point and as many as `arc` has of a ring; stiffness and damping, of a ring all around. arc, shape (2, k):
    places of a ring's points along half an arc either way, and their weights, which add up to 2.

    Of the elastic modes of a single body: modes, shape (n, 3, m); frequencies; propagators, shape (4, m), over half a
    step exactly: η → a η + b η̇ and η̇ → c η + d η̇; bend, the largest shape at a node.
    """

    gravity: float
    friction: float
    mass: Array
    inertia: Array
    lowest: Array
    carrier: Whole
    target: Whole
    face: Array
    first: Whole
    reach: Array
    nodes: Array
    radii: Array
    slots: Whole
    stiffness: Array
    damping: Array
    arc: Array
    modes: Array
    frequencies: Array
    propagators: Array
    bend: float


class State(NamedTuple):
    """
    What changes, and work space for a step; of b bodies and the table, s interfaces, n nodes, p points, k
    points of a ring, m modes.

    rigid: position, velocity, quaternion, angular momentum in the body's axes; matrix: rotation, body to table; stands:
    0 of a body that has fallen and is left where it lies; strain: η, η̇, its gain in the step and its mean; slip:
    elastic slip of each point; touched: 1 where the point touched in the last step; entry: how deep it was as it came
    over the outline of a face from below (m), from where on it bears, and −1 less that where it is off the face; arcs:
    direction of a ring's lowest point in the carrier and half the arc (rad) that its points span, 0 where it is off the
    face; work: of the table, taken by contact, friction and the modes, and held by the slip. The rest is of one step.

    Of each interface: frame: the target's axes to the table's; turned and apart: carrier to target, from the face's
    middle; twist: v and ω of the carrier relative to the target, in its axes; listed: where its points begin in the
    list of those that may touch. Of each such point: node; slot; its share of the node's stiffness and damping; lever:
    in the target's axes, in the carrier's; depth; load: force 0:3, its elastic normal part 3, slip left 4:6, whether it
    sticks 6, slip that the normal force still holds 7:9, velocity 9:12, the slip's increase over the step 12:14. Of
    each body: speeds: v and ω in the table's axes; change: of velocity and angular momentum; total: force and moment.
    carried: slip of a ring's points at their new places. pull: minus the table's acceleration.
    """

    rigid: Annotated[Array, "b", 13]
    matrix: Annotated[Array, "b", 3, 3]
    stands: Annotated[Whole, "b"]
    strain: Annotated[Array, 4, "m"]
    slip: Annotated[Array, "p", 2]
    touched: Annotated[Whole, "p"]
    entry: Annotated[Array, "p"]
    arcs: Annotated[Array, "n", 2]
    work: Annotated[Array, 3]
    frame: Annotated[Array, "s", 3, 3]
    turned: Annotated[Array, "s", 3, 3]
    apart: Annotated[Array, "s", 3]
    twist: Annotated[Array, "s", 6]
    listed: Annotated[Whole, "s + 1"]
    node: Annotated[Whole, "p"]
    slot: Annotated[Whole, "p"]
    stiffness: Annotated[Array, "p"]
    damping: Annotated[Array, "p"]
    lever: Annotated[Array, "p", 6]
    depth: Annotated[Array, "p"]
    load: Annotated[Array, "p", 14]
    speeds: Annotated[Array, "b", 6]
    change: Annotated[Array, "b", 6]
    total: Annotated[Array, "b", 6]
    carried: Annotated[Array, "k", 2]
    pull: Annotated[Array, 3]

    @classmethod
    def begin(cls, system: System, rows: Array) -> State:
        """Give the state of bodies, by `Start.row`, that touch nothing yet and are not strained."""
        lengths = {
            "b": len(system.mass) + 1,
            "s": len(system.carrier),
            "s + 1": len(system.first),
            "n": len(system.nodes),
            "p": int(system.slots[-1]),
            "k": system.arc.shape[1],
            "m": system.frequencies.size,
        }
        arrays: dict[str, Any] = {}
        for name, hint in get_type_hints(cls, include_extras=True).items():
            kind, *shape = get_args(hint)
            dtype = np.int64 if kind == Whole else np.float64
            arrays[name] = np.zeros([lengths.get(length, length) for length in shape], dtype)
        state = cls(**arrays)
        state.stands[:], state.rigid[TABLE, 6], state.rigid[:TABLE] = 1, 1.0, rows
        state.rigid[:TABLE, 10:] *= system.inertia
        state.matrix[:] = rotation_matrices(state.rigid[:, 6:10])
        return state
