"""A body as the contact engine sees it: rigid mass, base nodes and rings, and elastic modes at those nodes."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from math import cos, pi, sqrt
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.validation import number

if TYPE_CHECKING:
    from colonnade.dynamics.contact.history import AssemblyHistory, ContactHistory
    from colonnade.dynamics.motion import Motion

GRID = 5
"""Nodes along a side of a rectangular base."""

RINGS = 4
"""Whole circles of a round base."""


@dataclass(frozen=True, eq=False)
class Nodes:
    """
    Where a body can touch another, or the table.

    Attributes
    ----------
    nodes : ndarray, shape (n, 3)
        Relative to the centre of mass in the body's axes, m; z is upwards, the base at z = −h. Of a ring its point at
        +x.
    node_mass, node_area : ndarray, shape (n,)
        kg and m²: the mass and the area of the base that each node stands for.
    ring_radii : ndarray, shape (n,)
        m. Where positive, the node is a ring: a whole circle of this radius about the body's axis at the node's height,
        with its mass and area spread evenly around. 0 is a point. Rings are of rigid bodies only.
    """

    nodes: Array
    node_mass: Array
    node_area: Array
    ring_radii: Array

    def around(self, count: int) -> Array:
        """Give equal points on the circle of each node, shape (n, count, 3); of a point node it again and again."""
        turned = 2.0 * pi * (np.arange(count) + 0.5) / count
        circle = np.column_stack((np.cos(turned) - 1.0, np.sin(turned), np.zeros(count)))
        return np.asarray(self.nodes[:, None] + self.ring_radii[:, None, None] * circle)


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactBody(Nodes):
    """
    A body in its principal axes about the centre of mass, with the nodes at which it can touch the table.

    Attributes
    ----------
    mass : float
        kg.
    inertia : ndarray, shape (3,)
        Principal moments about the centre of mass, for the x, y and z axis of the body, kg m².
    modes : ndarray, shape (n, 3, m)
        Mass-normalised elastic mode shapes at the base nodes, kg^-½; m is 0 for a rigid body.
    frequencies, modal_damping : ndarray, shape (m,)
        rad/s; fraction of critical.
    description : str
        For people: shape, mesh, degrees of freedom, how reduced.

    Notes
    -----
    The modes carry no momentum and no angular momentum (mean axes), so that translation and rotation are those of the
    rigid body, and a uniform acceleration does not excite them; strains are small. Inertia forces of the rotation on
    the modes are neglected.
    """

    mass: float
    inertia: Array
    description: str
    modes: Array = field(default_factory=lambda: np.zeros((0, 3, 0)))
    frequencies: Array = field(default_factory=lambda: np.zeros(0))
    modal_damping: Array = field(default_factory=lambda: np.zeros(0))

    @property
    def height(self) -> float:
        """Height of the centre of mass above the base, m."""
        return float(-self.nodes[:, 2].min())

    @property
    def half_width(self) -> float:
        """Distance of the outermost base node from the centre of mass along x, m: of the pole of plane rocking."""
        return float(np.abs(self.nodes[:, 0]).max())


def rigid_body(block: Block, *, grid: int = GRID, rings: int = RINGS) -> ContactBody:
    """
    Place nodes on the base of a rigid block.

    Parameters
    ----------
    block : Block
        Half width, height of the centre of mass and inertia about y follow from its α, R and I₀ (of both sides, in the
        mean); depth and the other inertias from its `solid`.
    grid : int, optional
        Nodes along each side of a rectangular base, at least 2. Equal spacing with nodes on the edges; corners stand
        for a quarter of the area of an inner node.
    rings : int, optional
        Whole circles of a round base, equally spaced, the outermost on the rim.

    Returns
    -------
    body : ContactBody
        Without modes. Each node's mass is the body's, by its share of the area.

    Raises
    ------
    ValueError
        If the block has no shape, or its inertia about the pole is less than that of the mass at the pole distance.
    """
    solid, widths = block.solid, [side.half_width for side in block.sides]
    if solid is None:
        raise ValueError("block has no shape; a prism, a cylinder or a cone was expected by the contact model")
    height = 0.5 * sum(side.pole_distance * cos(side.critical_angle) for side in block.sides)
    about_y = 0.5 * sum(side.inertia - block.mass * side.pole_distance**2 for side in block.sides)
    if not about_y > 0.0:
        raise ValueError(
            f"I₀ − m R² is {about_y:.4g} kg m²; more than 0 was expected: the inertia about the pole "
            "has to exceed that of the mass at the pole distance"
        )
    if solid.base == "circle":
        about_x, (nodes, area) = about_y, round_nodes(0.5 * sum(widths), rings)
        radii, told = nodes[:, 0], f"round base, {rings} whole {'ring' if rings == 1 else 'rings'}"
    else:
        low, high = np.array([-widths[0], -solid.half_depth]), np.array([widths[1], solid.half_depth])
        about_x, (nodes, area) = solid.inertia_x, grid_nodes(low, high, grid)
        radii, told = np.zeros(len(nodes)), f"rectangular base, {len(nodes)} nodes"
    return ContactBody(
        nodes=np.column_stack((nodes, np.full(len(nodes), -height))),
        node_mass=block.mass * area / area.sum(),
        node_area=area,
        ring_radii=radii,
        mass=block.mass,
        inertia=np.array([about_x, about_y, solid.inertia_z]),
        description=f"rigid, {told}",
    )


def grid_nodes(low: Array, high: Array, count: int) -> tuple[Array, Array]:
    """Give equally spaced nodes of a rectangle, `count` along x and along y, shape (n, 2), and the area of each."""
    x, y = np.meshgrid(*np.linspace(low, high, count).T, indexing="ij")
    shares = np.ones(count)
    shares[[0, -1]] = 0.5
    shares /= shares.sum()
    return np.column_stack((x.ravel(), y.ravel())), np.outer(shares, shares).ravel() * np.prod(high - low)


def round_nodes(radius: float, rings: int) -> tuple[Array, Array]:
    """Give the points at +x of a disc's equally spaced rings, the outermost on its rim, and the area of each."""
    radii = radius * np.arange(1, rings + 1) / rings
    # A ring takes the area up to midway to its neighbours, the innermost all within, the outermost up to the rim.
    edges = np.concatenate(([0.0], 0.5 * (radii[:-1] + radii[1:]), [radius]))
    return np.column_stack((radii, np.zeros(rings))), pi * np.diff(edges**2)


def rotation_matrices(orientation: Array) -> Array:
    """Return the rotation matrices, shape (…, 3, 3), of unit quaternions, shape (…, 4)."""
    from scipy.spatial.transform import Rotation  # the check of a campaign file must not load it

    # Its quaternions have the scalar last.
    turned = Rotation.from_quat(np.roll(orientation, -1, axis=-1).reshape(-1, 4))
    return np.asarray(turned.as_matrix()).reshape(*orientation.shape[:-1], 3, 3)


def propagators(body: ContactBody, step: float) -> Array:
    """Exact free motion of each mode over a step: η → a η + b η̇, η̇ → c η + d η̇; rows a, b, c, d, shape (4, m)."""
    frequency, damping = body.frequencies, body.modal_damping
    turning = frequency * np.sqrt((1.0 - damping**2).astype(complex))
    turning = np.where(np.abs(turning) < 1e-9 * frequency, 1e-9 * frequency, turning)
    fading = np.exp(-damping * frequency * step)
    cosine, sine = np.cos(turning * step), np.sin(turning * step) / turning
    rows = (cosine + damping * frequency * sine, sine, -(frequency**2) * sine, cosine - damping * frequency * sine)
    return np.ascontiguousarray(np.real(np.array(rows) * fading).reshape(4, -1))


STATIC_PENETRATION = 1e-7
"""Of the default law: how deep the standing body sinks, in heights of its centre of mass. On a softer contact a block
leans on its springs by enough to rock below A = 1."""

DEFAULT_STEP = 5e-6
"""s, of runs with the default law; shorter where the contact is too stiff for it."""


@dataclass(frozen=True)
class ContactLaw:
    """
    Force of the table on one base node: a point, or a whole ring with each of its points.

    Attributes
    ----------
    stiffness : float or None, optional
        Normal penalty stiffness k per area of the base, N/m³. Default: at each interface by the weight above it, which
        sinks by `penetration`, so that bodies of all sizes are served alike.
    damping_fraction : float
        ξ, the critical damping fraction: 2 ξ sqrt(m k) v acts while the node is in contact, m the node's mass.
    friction : float
        Coulomb's coefficient µ; `math.inf` for no sliding.
    penetration : float, optional
        Depth under what stands on an interface, over the height of its centre of mass.

    Notes
    -----
    The normal force is max(0, k δ + 2 ξ sqrt(m k) dδ/dt) for a depth δ > 0: the table never pulls. The tangential force
    follows the elastic slip s, −k s − 2 ξ sqrt(m k) ds/dt, and where k |s| would exceed µ N the node slides undamped
    and s stays at µ N / k.

    A ring of radius r has its stiffness k and its mass m spread evenly around: by length k' = k / 2πr, m' = m / 2πr and
    the damping 2 ξ sqrt(m' k'), each the limit of more and more nodes; k is the stiffness times the area of the
    annulus that the ring stands for.
    """

    stiffness: float | None = None
    damping_fraction: float = 0.4
    friction: float = 0.6
    penetration: float = STATIC_PENETRATION

    def __post_init__(self) -> None:
        number("penetration", self.penetration, "a positive number", above=0.0)
        if self.stiffness is not None:
            number("stiffness", self.stiffness, "a positive number", above=0.0)
        number("damping_fraction", self.damping_fraction, "a number from 0 on", low=0.0)
        number("friction", self.friction, "a number from 0 on", low=0.0, finite=False)

    def bearing(self, body: ContactBody, gravity: float) -> ContactLaw:
        """Return the law with its stiffness under a body that stands on the table."""
        return self.under(body.mass * gravity / float(body.node_area.sum()), body.height)

    def under(self, pressure: float, height: float) -> ContactLaw:
        """Return the law with its stiffness under a pressure (Pa) by what has its centre of mass at a height (m)."""
        return self if self.stiffness is not None else replace(self, stiffness=pressure / (self.penetration * height))

    def node_stiffness(self, body: Nodes) -> Array:
        """Normal stiffness of each base node, N/m, shape (n,)."""
        if self.stiffness is None:
            raise ValueError("The law has no stiffness yet; `under` gives it one, or `bearing` a body")
        return self.stiffness * body.node_area

    def node_damping(self, body: Nodes) -> Array:
        """Normal damping 2 ξ sqrt(m k) of each base node, N s/m, shape (n,)."""
        return np.asarray(2.0 * self.damping_fraction * np.sqrt(body.node_mass * self.node_stiffness(body)))

    def effective_damping(self, body: ContactBody) -> float:
        """
        Damping fraction ξ_eff of the whole body that bounces on all its nodes, Σc / (2 sqrt(M Σk)).

        What compares meshes: for nodes that carry the base layer of a mesh of first-order elements of length L,
        ξ_eff = ξ sqrt(L / 2 H), H the height of the body.
        """
        stiffness = float(self.node_stiffness(body).sum())
        return float(self.node_damping(body).sum()) / (2.0 * sqrt(body.mass * stiffness))


class Tilts(TypedDict, total=False):
    """How bodies on the table start, each 0 by default: angle and rate (rad/s) about y, rotation about x, rad."""

    theta0: float
    omega0: float
    out_of_plane: float


@dataclass(frozen=True)
class InSpace:
    """
    What the contact model moves.

    Attributes
    ----------
    body : ContactBody or Assembly
    law : ContactLaw
        Of an assembly, that of all its interfaces.
    step : float, optional
        s; of an assembly not given.
    """

    body: ContactBody | Assembly
    law: ContactLaw
    step: float | None = None

    @property
    def options(self) -> dict[str, Any]:
        """What a run depends on beside its motion, by name."""
        body = repr(self.body.bodies) if isinstance(self.body, Assembly) else self.body.description
        return {"body": body, **asdict(self.law), "contact_step": self.step}

    def run(self, motion: Motion, gravity: float, **tilts: Unpack[Tilts]) -> ContactHistory | AssemblyHistory:
        """Run a base motion, as `simulate` or `simulate_assembly`; gravity (m/s²) is that of a single body."""
        # The engine is compiled on import.
        from colonnade.dynamics.contact.simulate import simulate, simulate_assembly

        if isinstance(self.body, Assembly):
            return simulate_assembly(self.body, motion, law=self.law, **tilts)
        return simulate(self.body, motion, law=self.law, gravity=gravity, step=self.step, **tilts)
