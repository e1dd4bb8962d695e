"""What every model says of itself."""

from __future__ import annotations

from math import tan

import pytest

from colonnade.dynamics.models.model import Line, Model


class Still(Model):
    """A model in which nothing moves."""

    def run(self, case):
        raise ValueError("nothing moves")


def still(**given):
    line = Line("#000000", (), 1.0)
    named = {"name": "still", "line": line, "definition": "θ = 0", "in_space": False, "is_default": False}
    return Still(**(named | {"map_points": (2, 2)} | given))


@pytest.mark.parametrize(("is_linearised", "threshold"), [(True, 0.2), (False, tan(0.2))])
def test_a_block_uplifts_where_its_equation_says(is_linearised, threshold):
    assert still(is_linearised=is_linearised).uplift_threshold(0.2) == threshold


def test_a_model_without_a_run_is_none():
    with pytest.raises(TypeError, match="abstract"):
        Model(name="x", line=None, definition="", in_space=False, is_default=False, map_points=(1, 1))
