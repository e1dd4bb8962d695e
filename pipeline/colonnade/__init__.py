"""
From the recordings of a shake-table test on a free-standing column to predicted over measured.

Everything here is loaded when it is first used, so that `import colonnade` and the command start before numba does.
"""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from colonnade.assessment.fragility import Fragility as Fragility
    from colonnade.assessment.measures import IntensityMeasures as IntensityMeasures
    from colonnade.assessment.measures import intensity_measures as intensity_measures
    from colonnade.assessment.study import fragility as fragility
    from colonnade.dynamics.assembly import Assembly as Assembly
    from colonnade.dynamics.assembly import Placed as Placed
    from colonnade.dynamics.block import Block as Block
    from colonnade.dynamics.contact.history import AssemblyHistory as AssemblyHistory
    from colonnade.dynamics.ensemble import Ensemble as Ensemble
    from colonnade.dynamics.ensemble import ensemble as ensemble
    from colonnade.dynamics.history import History as History
    from colonnade.dynamics.maps import StabilityMap as StabilityMap
    from colonnade.dynamics.maps import stability_map as stability_map
    from colonnade.dynamics.motion import Motion as Motion
    from colonnade.dynamics.plane.reactions import Reactions as Reactions
    from colonnade.dynamics.plane.reactions import reactions as reactions
    from colonnade.dynamics.pulses import OverturningSpectrum as OverturningSpectrum
    from colonnade.dynamics.pulses import overturning_spectrum as overturning_spectrum
    from colonnade.dynamics.rock import RestitutionLaw as RestitutionLaw
    from colonnade.dynamics.rock import rock as rock
    from colonnade.dynamics.spectra import RockingSpectrum as RockingSpectrum
    from colonnade.dynamics.spectra import rocking_spectrum as rocking_spectrum
    from colonnade.dynamics.uncertainty import Uncertainty as Uncertainty
    from colonnade.errors import ColonnadeError as ColonnadeError
    from colonnade.figures.plot import animate as animate
    from colonnade.figures.plot import plot as plot
    from colonnade.identification.fusion.pose import rocking_angle as rocking_angle
    from colonnade.identification.restitution.identify import identify_restitution as identify_restitution
    from colonnade.identification.restitution.result import Restitution as Restitution
    from colonnade.readers.motion import read_motion as read_motion
    from colonnade.workflow.run import run as run

__version__ = "0.1.0"

# Editors and mypy read the names above; so does a running program, which loads each with its module when it is used.
_OFFERED = re.compile(r"^    from (\S+) import (\w+) as", re.MULTILINE)
_ROOMS = {name: room for room, name in _OFFERED.findall(Path(__file__).read_text(encoding="utf-8"))}

__all__ = ["__version__", *_ROOMS]


def __getattr__(name: str) -> Any:
    if name not in _ROOMS:
        raise AttributeError(f"module 'colonnade' has no attribute {name!r}")
    value = getattr(import_module(_ROOMS[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
