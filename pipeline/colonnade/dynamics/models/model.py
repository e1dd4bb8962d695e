"""What a model of rocking is: its properties, and how it is run."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from math import tan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from colonnade.dynamics.block import Block, Sided
    from colonnade.dynamics.contact.law import ContactLaw
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
