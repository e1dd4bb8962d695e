"""A body refuses arrays that do not fit together."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.nodes import rigid_body
from every import every

GIVEN = vars(rigid_body(Block.prism(width=0.2, depth=0.3, height=0.9, mass=10.0)))


def test_arrays_are_kept_as_the_engine_takes_them():
    body = ContactBody(**{**GIVEN, "nodes": np.asfortranarray(GIVEN["nodes"]), "inertia": [1, 2, 3]})
    assert body.nodes.flags.c_contiguous
    assert body.inertia.dtype == np.float64
    assert body.height == pytest.approx(0.45)


@every(
    ("wrong", "message"),
    [
        ({"inertia": np.ones(2)}, r"inertia has shape \(2,\); \(3,\) was expected"),
        ({"node_mass": np.ones(3)}, r"node_mass has shape \(3,\); \(25,\)"),
        ({"nodes": np.full((25, 3), np.nan)}, "nodes holds a value that is not finite"),
        ({"mass": 0.0}, "mass is 0.0; positive"),
        ({"node_area": np.zeros(25)}, "node_area is"),
        ({"ring_radii": np.full(25, -1.0)}, r"ring_radii is \[-1"),
        ({"ring_radii": np.full(25, 0.1)}, r"not its point at \+x"),
        (
            {
                "modes": np.zeros((25, 3, 1)),
                "frequencies": [1.0],
                "modal_damping": [-0.1],
            },
            "modal_damping is",
        ),
        (
            {"nodes": np.zeros((0, 3)), "node_mass": [], "node_area": [], "modes": np.zeros((0, 3, 0))},
            "no base nodes",
        ),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_a_body_that_cannot_be_is_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        ContactBody(**{**GIVEN, **wrong})
