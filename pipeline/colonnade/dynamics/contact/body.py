"""A body as the contact engine sees it: rigid mass, base nodes, and elastic modes at those nodes."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from colonnade.arrays import Array


@dataclass(frozen=True, eq=False)
class ContactBody:
    """
    A body in its principal axes about the centre of mass, with the nodes at which it can touch the table.

    Attributes
    ----------
    mass : float
        kg.
    inertia : ndarray, shape (3,)
        Principal moments about the centre of mass, for the x, y and z axis of the body, kg m².
    nodes : ndarray, shape (n, 3)
        Base nodes relative to the centre of mass in the body's axes, m; z is upwards, the base at z = −h. Of a ring its
        point at +x.
    node_mass, node_area : ndarray, shape (n,)
        kg and m²: the mass and the area of the base that each node stands for.
    modes : ndarray, shape (n, 3, m)
        Mass-normalised elastic mode shapes at the base nodes, kg^-½; m is 0 for a rigid body.
    frequencies, modal_damping : ndarray, shape (m,)
        rad/s; fraction of critical.
    description : str
        For people: shape, mesh, degrees of freedom, how reduced.
    ring_radii : ndarray, shape (n,)
        m. Where positive, the node is a ring: a whole circle of this radius about the body's axis at the node's height,
        with its mass and area spread evenly around. 0, the default, is a point. Rings are of rigid bodies only.

    Notes
    -----
    The modes carry no momentum and no angular momentum (mean axes), so that translation and rotation are those of the
    rigid body, and a uniform acceleration does not excite them; strains are small. Inertia forces of the rotation on
    the modes are neglected.
    """

    mass: float
    inertia: Array
    nodes: Array
    node_mass: Array
    node_area: Array
    modes: Array
    frequencies: Array
    modal_damping: Array
    description: str
    ring_radii: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        count, kept = len(self.nodes), len(self.frequencies)
        if count == 0:
            raise ValueError("The body has no base nodes; at least one was expected")
        if len(self.ring_radii) == 0:
            object.__setattr__(self, "ring_radii", np.zeros(count))
        shapes = {
            "inertia": (3,),
            "nodes": (count, 3),
            "node_mass": (count,),
            "node_area": (count,),
            "ring_radii": (count,),
            "modes": (count, 3, kept),
            "frequencies": (kept,),
            "modal_damping": (kept,),
        }
        for name, shape in shapes.items():
            values = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            if values.shape != shape:
                raise ValueError(f"{name} has shape {values.shape}; {shape} was expected")
            if not np.isfinite(values).all():
                raise ValueError(f"{name} holds a value that is not finite")
            object.__setattr__(self, name, values)
        for name in ("mass", "inertia", "node_mass", "node_area", "frequencies"):
            if not np.all(getattr(self, name) > 0.0):
                raise ValueError(f"{name} is {getattr(self, name)}; positive values were expected")
        if np.any(self.modal_damping < 0.0):
            raise ValueError(f"modal_damping is {self.modal_damping}; values from 0 on were expected")
        if np.any(self.ring_radii < 0.0) or (kept > 0 and self.has_rings):
            raise ValueError(
                f"ring_radii is {self.ring_radii} m with {kept} modes; radii from 0 on were expected, 0 with modes"
            )
        offset = np.hypot(*(self.nodes[:, :2] - np.column_stack((self.ring_radii, np.zeros(count)))).T)
        if np.any((self.ring_radii > 0.0) & (offset > 1e-9 * self.ring_radii)):
            raise ValueError("A ring's node is not its point at +x; (radius, 0, −h) was expected")

    @property
    def height(self) -> float:
        """Height of the centre of mass above the base, m."""
        return float(-self.nodes[:, 2].min())

    @property
    def half_width(self) -> float:
        """Distance of the outermost base node from the centre of mass along x, m: of the pole of plane rocking."""
        return float(np.abs(self.nodes[:, 0]).max())

    @property
    def has_rings(self) -> bool:
        """Whether the base touches along whole circles."""
        return bool(np.any(self.ring_radii > 0.0))
