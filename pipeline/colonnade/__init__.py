"""
From the recordings of a shake-table test on a free-standing column to predicted over measured.

Everything here is loaded when it is first used, so that `import colonnade` and the command start before numba does.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from colonnade.assessment.fragility.summary import Fragility
    from colonnade.assessment.intensity.measured import IntensityMeasures, intensity_measures
    from colonnade.assessment.on_motions import fragility
    from colonnade.dynamics.block import Block
    from colonnade.dynamics.ensembles.ensemble import ensemble
    from colonnade.dynamics.ensembles.outcome import Ensemble
    from colonnade.dynamics.ensembles.uncertainty import Uncertainty
    from colonnade.dynamics.history import History
    from colonnade.dynamics.maps.chart import StabilityMap, stability_map
    from colonnade.dynamics.motion import Motion
    from colonnade.dynamics.plane.reactions import Reactions, reactions
    from colonnade.dynamics.restitution_law import RestitutionLaw
    from colonnade.dynamics.rock import rock
    from colonnade.dynamics.spectra.overturning import OverturningSpectrum, overturning_spectrum
    from colonnade.dynamics.spectra.spectrum import RockingSpectrum, rocking_spectrum
    from colonnade.errors import ColonnadeError
    from colonnade.figures.plot import animate, plot
    from colonnade.identification.fusion.angle import rocking_angle
    from colonnade.identification.restitution.identify import identify_restitution
    from colonnade.identification.restitution.result import Restitution
    from colonnade.readers.motion import read_motion
    from colonnade.workflow.run import run

__version__ = "0.1.0"

__all__ = [
    "Block",
    "ColonnadeError",
    "Ensemble",
    "Fragility",
    "History",
    "IntensityMeasures",
    "Motion",
    "OverturningSpectrum",
    "Reactions",
    "Restitution",
    "RestitutionLaw",
    "RockingSpectrum",
    "StabilityMap",
    "Uncertainty",
    "__version__",
    "animate",
    "ensemble",
    "fragility",
    "identify_restitution",
    "intensity_measures",
    "overturning_spectrum",
    "plot",
    "reactions",
    "read_motion",
    "rock",
    "rocking_angle",
    "rocking_spectrum",
    "run",
    "stability_map",
]

_ROOMS = {
    "Block": "colonnade.dynamics.block",
    "ColonnadeError": "colonnade.errors",
    "Ensemble": "colonnade.dynamics.ensembles.outcome",
    "Fragility": "colonnade.assessment.fragility.summary",
    "History": "colonnade.dynamics.history",
    "IntensityMeasures": "colonnade.assessment.intensity.measured",
    "Motion": "colonnade.dynamics.motion",
    "OverturningSpectrum": "colonnade.dynamics.spectra.overturning",
    "Reactions": "colonnade.dynamics.plane.reactions",
    "Restitution": "colonnade.identification.restitution.result",
    "RestitutionLaw": "colonnade.dynamics.restitution_law",
    "RockingSpectrum": "colonnade.dynamics.spectra.spectrum",
    "StabilityMap": "colonnade.dynamics.maps.chart",
    "Uncertainty": "colonnade.dynamics.ensembles.uncertainty",
    "animate": "colonnade.figures.plot",
    "ensemble": "colonnade.dynamics.ensembles.ensemble",
    "fragility": "colonnade.assessment.on_motions",
    "identify_restitution": "colonnade.identification.restitution.identify",
    "intensity_measures": "colonnade.assessment.intensity.measured",
    "overturning_spectrum": "colonnade.dynamics.spectra.overturning",
    "plot": "colonnade.figures.plot",
    "reactions": "colonnade.dynamics.plane.reactions",
    "read_motion": "colonnade.readers.motion",
    "rock": "colonnade.dynamics.rock",
    "rocking_angle": "colonnade.identification.fusion.angle",
    "rocking_spectrum": "colonnade.dynamics.spectra.spectrum",
    "run": "colonnade.workflow.run",
    "stability_map": "colonnade.dynamics.maps.chart",
}


def __getattr__(name: str) -> Any:
    if name not in _ROOMS:
        raise AttributeError(f"module 'colonnade' has no attribute {name!r}")
    value = getattr(import_module(_ROOMS[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
