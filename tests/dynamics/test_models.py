"""Models by their names: what each says of itself, runs, and draws."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.models import MODELS, model_of, plane_model_of
from colonnade.dynamics.rock import rock
from prism import PRISM


def test_models_look_different():
    lines = [model.line for model in MODELS.values()]
    assert len({line.color for line in lines}) == len({line.dash for line in lines}) == len(lines)


@pytest.mark.parametrize("name", MODELS)
def test_every_model_runs(name):
    history = rock(PRISM, theta0=0.3 * PRISM.critical_angle, duration=0.05, model=name)
    assert history.model == name
    assert history.outcome == "rocking"


@pytest.mark.parametrize(("asked", "hint"), [("nonlinaer", 'Did you mean "nonlinear"'), ("x", '"contact"')])
def test_an_unknown_model_is_refused_with_what_there_is(asked, hint):
    with pytest.raises(ValueError, match=f'Unknown model "{asked}".*{hint}'):
        model_of(asked)


def test_a_model_in_space_is_not_a_plane_one():
    with pytest.raises(ValueError, match='Unknown plane model "contact"'):
        plane_model_of("contact")


def test_the_registry_loads_no_library_of_numbers():
    code = "import sys, colonnade.dynamics.models; print({'numba', 'scipy', 'matplotlib'} & sys.modules.keys())"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "set()\n"


FREE = {"model": "contact", "theta0": 0.5 * PRISM.critical_angle, "duration": 0.02}


def test_without_a_law_the_table_is_stiff():
    law = ContactLaw().bearing(rigid_body(PRISM), PRISM.gravity)
    plain, named = rock(PRISM, **FREE), rock(PRISM, **FREE, contact=law)
    np.testing.assert_array_equal(plain.angle, named.angle)
    soft = rock(PRISM, **FREE, contact=replace(law, stiffness=law.stiffness / 100))
    assert not np.array_equal(soft.angle, plain.angle)


def test_it_starts_as_asked():
    history = rock(PRISM, **FREE, omega0=-0.1, out_of_plane=0.01)
    assert history.angle[0] == pytest.approx(FREE["theta0"])
    assert history.angular_velocity[0] == pytest.approx(-0.1)
    assert history.out_of_plane_angle[0] == pytest.approx(0.01)


def test_a_frame_is_refused_as_it_is_several_bodies():
    with pytest.raises(ValueError, match=r"block is a frame, .* build an `Assembly\.frame`"):
        rock(Block.frame(PRISM, beam_mass=50.0), **FREE)
