"""One module a model says what it needs, gives, costs and looks like, and everything else asks the registry."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from colonnade.dynamics.models import registry
from colonnade.dynamics.models.registry import MODELS, PLANE_MODELS, model_of, plane_model_of
from colonnade.dynamics.rock import rock
from prism import PRISM

FOLDER = Path(registry.__file__).parent


def test_every_module_of_the_folder_is_in_the_registry_under_its_name():
    modules = {path.stem for path in FOLDER.glob("*.py")} - {"__init__", "model", "plane", "registry"}
    assert set(MODELS) == modules
    assert all(name == model.name for name, model in MODELS.items())


def test_models_look_different():
    lines = [model.line for model in MODELS.values()]
    assert len({line.color for line in lines}) == len({line.dash for line in lines}) == len(lines)


@pytest.mark.parametrize("name", MODELS)
def test_every_model_runs(name):
    history = rock(PRISM, theta0=0.3 * PRISM.critical_angle, duration=0.05, model=name)
    assert history.model == name
    assert history.outcome == "rocking"


@pytest.mark.parametrize("name", PLANE_MODELS)
def test_a_plane_model_is_not_in_space(name):
    assert not plane_model_of(name).in_space


@pytest.mark.parametrize(("asked", "hint"), [("nonlinaer", 'Did you mean "nonlinear"'), ("x", '"contact"')])
def test_an_unknown_model_is_refused_with_what_there_is(asked, hint):
    with pytest.raises(ValueError, match=f'Unknown model "{asked}".*{hint}'):
        model_of(asked)


def test_a_model_in_space_is_not_a_plane_one():
    with pytest.raises(ValueError, match='Unknown plane model "contact"'):
        plane_model_of("contact")


def test_the_registry_loads_no_library_of_numbers():
    code = (
        "import sys, colonnade.dynamics.models.registry; print({'numba', 'scipy', 'matplotlib'} & sys.modules.keys())"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "set()\n"
