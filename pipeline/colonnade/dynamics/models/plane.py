"""What the models in the plane have in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from colonnade.dynamics.models.model import Case, Model

if TYPE_CHECKING:
    from colonnade.dynamics.history import History


@dataclass(frozen=True, kw_only=True)
class PlaneModel(Model):
    """A model of rocking in the plane."""

    in_space: bool = False
    members: int = 100
    map_points: tuple[int, int] = (100, 150)

    def run(self, case: Case) -> History:
        """Run it; see `plane.run`."""
        from colonnade.dynamics.plane.run import run

        return run(self, case)
