"""From dimensions to a reduced elastic body."""

import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.elastic.model import elastic_body, mesh_of

PRISM = {"width": 0.086, "depth": 0.086, "height": 0.456}


@pytest.mark.parametrize(
    ("sizes", "block"),
    [
        (PRISM, Block.prism(**PRISM, mass=26.1)),
        ({"diameter": 0.097, "height": 0.455}, Block.cylinder(diameter=0.097, height=0.455, mass=26.3)),
        (
            {"base_diameter": 0.097, "top_diameter": 0.0755, "height": 0.48},
            Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.48, mass=21.94),
        ),
    ],
    ids=["prism", "cylinder", "cone"],
)
def test_the_coarse_body_has_the_blocks_mass_and_inertia(sizes, block):
    body = elastic_body(sizes, block.mass, mesh="coarse")
    assert body.mass == pytest.approx(block.mass)
    about_pole = body.inertia[1] + body.mass * (body.half_width**2 + body.height**2)
    # The polygon of a coarse round mesh has its matter nearer to the axis than the disc.
    assert about_pole == pytest.approx(block.inertia, rel=0.01)
    assert body.frequencies.size > 0


def test_the_papers_coarse_mesh_is_met():
    assert mesh_of(PRISM, "coarse").degrees_of_freedom == 1224


@pytest.mark.parametrize(
    ("sizes", "mesh", "told"), [(PRISM, "corse", 'Did you mean "coarse"'), ({"height": 1.0}, "coarse", "dimensions")]
)
def test_what_cannot_be_meshed_is_refused(sizes, mesh, told):
    with pytest.raises(ValueError, match=told):
        mesh_of(sizes, mesh)
