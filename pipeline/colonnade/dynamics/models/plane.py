"""The models in the plane that the kernels of `dynamics.plane` solve: the linear and the nonlinear one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, final

from colonnade.dynamics.models.model import Case, Model

if TYPE_CHECKING:
    from colonnade.dynamics.history import History


@final
@dataclass(frozen=True, kw_only=True)
class PlaneModel(Model):
    """
    A model that has kernels in the plane.

    Maps call the kernels and not `run`, so a model with another `run` is a subclass of `Model`.
    """

    in_space: bool = False
    map_points: tuple[int, int] = (24, 150)

    def run(self, case: Case) -> History:
        """Run it; see `plane.run`."""
        from colonnade.dynamics.plane.run import run

        return run(self, case)
