"""The models of rocking: their properties, and how each is run. A new one is a subclass of `Model` and its entry."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from math import tan
from typing import TYPE_CHECKING, final

from colonnade.errors import nearest
from colonnade.validation import text

if TYPE_CHECKING:
    from colonnade.dynamics.block import Block, Sided
    from colonnade.dynamics.contact.body import ContactLaw
    from colonnade.dynamics.contact.history import ContactHistory
    from colonnade.dynamics.history import History
    from colonnade.dynamics.motion import Motion
    from colonnade.dynamics.restitution_law import RestitutionLaw


@dataclass(frozen=True)
class Line:
    """
    How a model's line looks in every figure.

    Attributes
    ----------
    color : str
        As in HTML; colour-blind readers can distinguish the models (after Okabe and Ito).
    dash : tuple of float
        Lengths of dashes and gaps in turn, over the width of the line; distinct on a grey print.
    width : float
        Points.
    """

    color: str
    dash: tuple[float, ...]
    width: float


@dataclass(frozen=True)
class Case:
    """What a model has to run; the arguments of `rock`, already checked."""

    block: Block
    motion: Motion | None
    restitution: Sided | RestitutionLaw | Callable[[float], float] | None
    theta0: float
    omega0: float
    duration: float | None
    rest_angle: float
    contact: ContactLaw | None
    out_of_plane: float


@dataclass(frozen=True, kw_only=True)
class Model(ABC):
    """
    A model of rocking.

    Attributes
    ----------
    name : str
        Its name in settings, files and figures.
    line : Line
    definition : str
        Its equation, or what it is, for the report; how it is solved.
    reference : str
        Key of its source among the report's references; empty if it has none.
    engine : str
        Module or folder that runs it and no model of another engine: their results do not depend on its code.
    in_space : bool
        Whether its restitution follows from a law of contact; if not, it needs e.
    is_linearised : bool
        Whether its equation is linear in θ.
    is_default : bool
        Whether a campaign uses it unless its settings name others.
    map_points : tuple of int
        Default number of Ω and of A of a stability map.
    """

    name: str
    line: Line
    definition: str
    reference: str = ""
    engine: str
    in_space: bool
    is_linearised: bool = False
    is_default: bool
    map_points: tuple[int, int]

    @abstractmethod
    def run(self, case: Case) -> History:
        """
        Run the model.

        Raises
        ------
        ValueError
            If the case has an argument that the model does not support.
        """

    def uplift_threshold(self, critical_angle: float) -> float:
        """Return a/g of the base above which a block at rest uplifts: α, or tan α."""
        return critical_angle if self.is_linearised else tan(critical_angle)


@final
@dataclass(frozen=True, kw_only=True)
class PlaneModel(Model):
    """
    A model that has kernels in the plane.

    Maps call the kernels and not `run`, so a model with another `run` is a subclass of `Model`.
    """

    engine: str = "colonnade.dynamics.plane.run"
    in_space: bool = False
    map_points: tuple[int, int] = (24, 150)

    def run(self, case: Case) -> History:
        """Run it; see `plane.run`."""
        from colonnade.dynamics.plane.run import run

        return run(self, case)


@dataclass(frozen=True, kw_only=True)
class ContactModel(Model):
    """A rigid body on a law of contact; a run takes some thousand times as long as that of a model in the plane."""

    engine: str = "colonnade.dynamics.contact"
    in_space: bool = True
    map_points: tuple[int, int] = (14, 31)

    def run(self, case: Case) -> ContactHistory:
        """Run a rigid body on the law of contact, that of a stiff table unless one is given; see `simulate`."""
        # Its engine is compiled on import.
        from colonnade.dynamics.contact.body import ContactLaw, rigid_body
        from colonnade.dynamics.contact.simulate import simulate

        if case.restitution is not None:
            raise ValueError(
                f"Do not give `restitution` to the {self.name} model: it follows from `contact`, the law of contact"
            )
        if case.block.beam_ratio:
            raise ValueError(
                "block is a frame, which rocks as one block in the plane only; a single body was expected. On contact "
                "its columns and its beam are bodies: build an `Assembly.frame`"
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


LINEAR = PlaneModel(
    name="linear",
    line=Line("#d1490f", (5.0, 1.6), 1.1),
    definition="θ̈ = p² (θ − α sgn θ − a/g), solved exactly between samples",
    reference="spanos",
    is_linearised=True,
    is_default=True,
)
NONLINEAR = PlaneModel(
    name="nonlinear",
    line=Line("#0b6bb0", (7.0, 1.6, 1.6, 1.6), 1.1),
    definition="θ̈ = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)], integrated with impacts located in time",
    reference="housner",
    is_default=True,
)
CONTACT = ContactModel(
    name="contact",
    line=Line("#0a8a5f", (2.2, 1.4), 1.2),
    definition="a body in space on base nodes, with penalty stiffness, critical damping fraction and Coulomb friction",
    is_default=False,
)

MODELS: dict[str, Model] = {model.name: model for model in (LINEAR, NONLINEAR, CONTACT)}
"""All models, in the order of tables and figures."""

PLANE_MODELS: dict[str, PlaneModel] = {name: model for name, model in MODELS.items() if isinstance(model, PlaneModel)}
"""Those that kernels solve, also under harmonic motion."""

DEFAULT = LINEAR.name
"""Default model of a single run of the library: the fastest."""


def model_of(name: str) -> Model:
    """
    Return a model by its name.

    Raises
    ------
    ValueError
        If the name is unknown; the message gives the nearest one.
    """
    if text("model", name, "the name of a model") not in MODELS:
        raise ValueError(f'Unknown model "{name}".{nearest(name, MODELS)}')
    return MODELS[name]


def plane_model_of(name: str) -> PlaneModel:
    """
    Return a model with kernels in the plane by its name.

    Raises
    ------
    ValueError
        If the name is unknown; the message gives the nearest one.
    """
    if text("model", name, "the name of a model") not in PLANE_MODELS:
        raise ValueError(f'Unknown plane model "{name}".{nearest(name, PLANE_MODELS)}')
    return PLANE_MODELS[name]
