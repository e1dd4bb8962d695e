"""A specimen in its views: outline and dimensions to scale, poles, angles, senses, table and axes."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from colonnade.dynamics.block import Block
from colonnade.figures.drawing import body as drawing
from colonnade.figures.drawing.setup import ELEVATION, PLAN, SIDE
from colonnade.figures.drawing.view import Body, Rocking, View

BLOCK = Block.prism(width=0.086, depth=0.06, height=0.456, mass=26.1)
PRISM = Body("rectangle", (0.086, 0.086), (0.06, 0.06), 0.456, True, Rocking.of(BLOCK))
CONE = Body("circle", (0.097, 0.0755), (0.097, 0.0755), 0.48, True, None)


def view(orientation=ELEVATION):
    return View.within(Figure(figsize=(4, 4)), (0.0, 0.0, 4.0, 4.0), (4.0, 4.0), orientation, 0.2, (2.0, 1.0))


def written(one):
    return {text.get_text() for text in one.axes.texts} - {""}


@pytest.mark.parametrize(
    ("orientation", "body", "largest"),
    [
        (ELEVATION, PRISM, [[0.043, 0.456]]),
        (SIDE, PRISM, [[0.03, 0.456]]),
        (PLAN, PRISM, [[0.043, 0.03]]),
        (ELEVATION, CONE, [[0.0485, 0.48]]),
        (PLAN, CONE, [[0.0485, 0.0485], [0.03775, 0.03775]]),
    ],
)
def test_an_outline_is_as_wide_and_high_as_the_view_sees_it(orientation, body, largest):
    one = view(orientation)
    drawing.draw_body(one, body)
    corners = [patch.get_xy() for patch in one.axes.patches]
    np.testing.assert_allclose([np.abs(each).max(axis=0) for each in corners], largest, rtol=1e-3)
    if body is CONE and orientation is ELEVATION:
        assert np.abs(corners[0][corners[0][:, 1] > 0.4, 0]) == pytest.approx(0.03775)


def test_an_outline_that_is_not_known_is_dashed_and_its_sizes_are_asked_for():
    one, stand_in = view(), PRISM._replace(is_known=False, rocking=None)
    drawing.draw_body(one, stand_in)
    drawing.draw_dimensions(one, stand_in)
    assert one.axes.patches[0].get_linestyle() != "-"
    assert written(one) == {"?"}


@pytest.mark.parametrize(
    ("orientation", "body", "sizes"),
    [
        (ELEVATION, PRISM, {"86 mm", "456 mm"}),
        (SIDE, PRISM, {"60 mm"}),
        (ELEVATION, CONE, {"⌀ 97 mm", "⌀ 75.5 mm", "480 mm"}),
        (ELEVATION, PRISM._replace(height=2.5), {"86 mm", "2.5 m"}),
    ],
    ids=["width and height", "depth", "both diameters", "metres"],
)
def test_each_view_gives_the_sizes_that_it_sees(orientation, body, sizes):
    one = view(orientation)
    drawing.draw_dimensions(one, body)
    assert written(one) == sizes
