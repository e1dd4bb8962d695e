"""A specimen in its views: outline and dimensions to scale, poles, angles, senses, table and axes."""

from math import degrees

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


def outlines(one):
    """Corners of the closed outlines, without the first that comes again at the end."""
    return [patch.get_xy()[:-1] for patch in one.axes.patches]


@pytest.mark.parametrize(("orientation", "half"), [(ELEVATION, 0.043), (SIDE, 0.03)], ids=["elevation", "side"])
def test_a_prism_is_as_wide_as_the_view_sees_it_and_as_high_as_it_is(orientation, half):
    one = view(orientation)
    drawing.draw_body(one, PRISM)
    (outline,) = outlines(one)
    np.testing.assert_allclose(outline, [(-half, 0), (half, 0), (half, 0.456), (-half, 0.456)])


def test_a_cone_is_narrower_at_its_top_and_two_circles_from_above():
    one = view()
    drawing.draw_body(one, CONE)
    (outline,) = outlines(one)
    np.testing.assert_allclose(outline[2:], [(0.03775, 0.48), (-0.03775, 0.48)])
    above = view(PLAN)
    drawing.draw_body(above, CONE)
    radii = [np.unique(np.hypot(*circle.T).round(9)).tolist() for circle in outlines(above)]
    assert radii == [[0.0485], [0.03775]]


def test_a_prism_from_above_is_one_rectangle_of_width_and_depth():
    one = view(PLAN)
    drawing.draw_body(one, PRISM)
    (outline,) = outlines(one)
    assert np.abs(outline).max(axis=0).tolist() == [0.043, 0.03]


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


def test_the_critical_angle_is_drawn_from_the_vertical_to_the_centre_of_mass():
    one = view()
    drawing.draw_rocking(one, Rocking.of(BLOCK))
    arc = next(line for line in one.axes.lines if len(line.get_xdata()) == 20)
    across, up = arc.get_xdata() - 0.043, arc.get_ydata()
    turns = np.arctan2(-across, up)
    assert (turns[0], turns[-1]) == pytest.approx((0.0, BLOCK.critical_angle))
    np.testing.assert_allclose(np.hypot(across, up), 0.62 * 0.228)
    assert written(one) == {"α"}


@pytest.mark.parametrize(("orientation", "place"), [(SIDE, (0.0, 0.228)), (PLAN, (0.0, 0.0))], ids=["side", "plan"])
def test_the_other_views_mark_the_centre_of_mass_alone(orientation, place):
    one = view(orientation)
    drawing.draw_rocking(one, Rocking.of(BLOCK))
    places = {(float(line.get_xdata()[0]), round(float(line.get_ydata()[0]), 9)) for line in one.axes.lines}
    assert places == {place}
    assert written(one) == set()


@pytest.mark.parametrize(
    ("orientation", "names"), [(ELEVATION, "xzy"), (SIDE, "yzx"), (PLAN, "xyz")], ids=["elevation", "side", "plan"]
)
def test_the_axes_of_a_view_are_named_across_up_and_through(orientation, names):
    one = view(orientation)
    drawing.draw_axes(one, (0.1, 0.1))
    places = {text.get_text(): text.get_position() for text in one.axes.texts if text.get_text()}
    across, up, through = (places[name] for name in names)
    assert across[0] > 0.1 == across[1]
    assert up[1] > 0.1 == up[0]
    assert through[0] < 0.1


def test_an_angle_is_written_in_both_units():
    assert drawing.words_of_angle(0.1864) == f"0.1864 rad = {degrees(0.1864):.4g}°"
