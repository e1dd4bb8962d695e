"""The models of rocking by name. A new one is a module of this folder and its entry here."""

from __future__ import annotations

from colonnade.dynamics.models.contact import CONTACT
from colonnade.dynamics.models.linear import LINEAR
from colonnade.dynamics.models.model import Model
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.models.plane import PlaneModel
from colonnade.errors import nearest
from colonnade.validation import text

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
