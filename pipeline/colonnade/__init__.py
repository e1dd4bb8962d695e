"""
From the recordings of a shake-table test on a free-standing column to measured over predicted.

Everything here is loaded when it is first used, so that `import colonnade` and the command start before numba does.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from colonnade.dynamics.block import Block
    from colonnade.dynamics.history import History
    from colonnade.dynamics.motion import Motion
    from colonnade.dynamics.rock import rock
    from colonnade.errors import ColonnadeError
    from colonnade.identification.angle import rocking_angle
    from colonnade.identification.restitution import Restitution, identify_restitution
    from colonnade.readers.motion import read_motion
    from colonnade.workflow.run import run

__version__ = "0.1.0"

__all__ = [
    "Block",
    "ColonnadeError",
    "History",
    "Motion",
    "Restitution",
    "__version__",
    "identify_restitution",
    "read_motion",
    "rock",
    "rocking_angle",
    "run",
]

_ROOMS = {
    "Block": "colonnade.dynamics.block",
    "ColonnadeError": "colonnade.errors",
    "History": "colonnade.dynamics.history",
    "Motion": "colonnade.dynamics.motion",
    "Restitution": "colonnade.identification.restitution",
    "identify_restitution": "colonnade.identification.restitution",
    "read_motion": "colonnade.readers.motion",
    "rock": "colonnade.dynamics.rock",
    "rocking_angle": "colonnade.identification.angle",
    "run": "colonnade.workflow.run",
}


def __getattr__(name: str) -> Any:
    if name not in _ROOMS:
        raise AttributeError(f"module 'colonnade' has no attribute {name!r}")
    value = getattr(import_module(_ROOMS[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
