"""The models of rocking and their properties. A new one is an entry here and a branch of `rock`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import tan

from colonnade.errors import nearest
from colonnade.validation import instance


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


@dataclass(frozen=True, kw_only=True)
class Model:
    """
    A model of rocking; `rock` runs it.

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
        Whether its restitution follows from a law of contact, and a run takes some thousand times as long; if not, it
        needs e.
    is_linearised : bool
        Whether its equation is linear in θ.
    map_points : tuple of int
        Default number of Ω and of A of a stability map.
    """

    name: str
    line: Line
    definition: str
    reference: str = ""
    engine: str = "colonnade.dynamics.plane.run"
    in_space: bool = False
    is_linearised: bool = False
    map_points: tuple[int, int] = (24, 150)

    def uplift_threshold(self, critical_angle: float) -> float:
        """Return a/g of the base above which a block at rest uplifts: α, or tan α."""
        return critical_angle if self.is_linearised else tan(critical_angle)


LINEAR = Model(
    name="linear",
    line=Line("#d1490f", (5.0, 1.6), 1.1),
    definition="θ̈ = p² (θ − α sgn θ − a/g), solved exactly between samples",
    reference="spanos",
    is_linearised=True,
)
NONLINEAR = Model(
    name="nonlinear",
    line=Line("#0b6bb0", (7.0, 1.6, 1.6, 1.6), 1.1),
    definition="θ̈ = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)], integrated with impacts located in time",
    reference="housner",
)
CONTACT = Model(
    name="contact",
    line=Line("#0a8a5f", (2.2, 1.4), 1.2),
    definition="a body in space on base nodes, with penalty stiffness, critical damping fraction and Coulomb friction",
    engine="colonnade.dynamics.contact",
    in_space=True,
    map_points=(14, 31),
)

MODELS: dict[str, Model] = {model.name: model for model in (LINEAR, NONLINEAR, CONTACT)}
"""All models, in the order of tables and figures."""

PLANE_MODELS = {model.name: model for model in (LINEAR, NONLINEAR)}
"""Those that kernels solve, also under harmonic motion; a campaign uses them unless its settings name others."""

DEFAULT = LINEAR.name
"""Default model of a single run of the library: the fastest."""


def model_of(name: str, known: Mapping[str, Model] = MODELS, kind: str = "model") -> Model:
    """
    Return a model by its name, among all or those of a kind.

    Raises
    ------
    ValueError
        If the name is unknown; the message gives the nearest one.
    """
    if instance("model", name, str, "the name of a model") not in known:
        raise ValueError(f'Unknown {kind} "{name}".{nearest(name, known)}')
    return known[name]


def plane_model_of(name: str) -> Model:
    """Return a model with kernels in the plane by its name; errors as of `model_of`."""
    return model_of(name, PLANE_MODELS, "plane model")
