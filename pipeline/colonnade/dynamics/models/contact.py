"""The contact model: a body in space on nodes that touch the table, step by step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from colonnade.dynamics.models.model import Case, Line, Model

if TYPE_CHECKING:
    from colonnade.dynamics.contact.history import ContactHistory


@dataclass(frozen=True, kw_only=True)
class ContactModel(Model):
    """A rigid body on a law of contact; a run takes some thousand times as long as that of a model in the plane."""

    in_space: bool = True
    map_points: tuple[int, int] = (14, 31)

    def run(self, case: Case) -> ContactHistory:
        """Run a rigid body on the law of contact, that of a stiff table unless one is given; see `simulate`."""
        # Its engine is compiled on import.
        from colonnade.dynamics.contact.law import ContactLaw
        from colonnade.dynamics.contact.nodes import rigid_body
        from colonnade.dynamics.contact.simulate import simulate

        if case.restitution is not None:
            raise ValueError(
                f"Do not give `restitution` to the {self.name} model: it follows from `contact`, the law of contact"
            )
        body = rigid_body(case.block)
        return simulate(
            body,
            case.motion,
            law=ContactLaw.stiff(body, case.block.gravity) if case.contact is None else case.contact,
            gravity=case.block.gravity,
            duration=case.duration,
            theta0=case.theta0,
            omega0=case.omega0,
            out_of_plane=case.out_of_plane,
        )


CONTACT = ContactModel(
    name="contact",
    line=Line("#0a8a5f", (2.2, 1.4), 1.2),
    definition="a body in space on base nodes, with penalty stiffness, critical damping fraction and Coulomb friction",
    is_default=False,
)
