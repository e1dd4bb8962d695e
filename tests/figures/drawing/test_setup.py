"""The drawing shows each arrow where the campaign file says it is and in the direction of a positive reading."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from colonnade.campaign.channel import Channel
from colonnade.dynamics.block import Block
from colonnade.figures.drawing.setup import (
    COLOURS,
    ELEVATION,
    Drawn,
    draw_transducer,
    setup_drawings,
)
from colonnade.figures.drawing.view import Body, Rocking, View, _spaced
from every import every

BLOCK = Block.prism(width=0.086, depth=0.06, height=0.456, mass=26.1)
PRISM = Body("rectangle", (0.086, 0.086), (0.06, 0.06), 0.456, True, Rocking.of(BLOCK), ("prism",))
TOP = Channel.model_construct(
    quantity="displacement", on="specimen", direction=(1.0, 0.0, 0.0), at=(0.043, 0.0, 0.44), relative_to="table"
)


def views(body=PRISM, **transducers):
    return setup_drawings([Drawn("prism in frame", body, transducers)]).axes


def arrows(axes):
    """Start and end of each arrow of a reading; those of axes, dimensions and senses are grey or have no colour."""
    return [
        (text.xyann, text.xy)
        for text in axes.texts
        if getattr(text, "arrow_patch", None) is not None and text.arrow_patch.get_mutation_scale() == 9.0
    ]


def marks(axes):
    return [
        (line.get_marker(), float(line.get_xdata()[0]), float(line.get_ydata()[0]))
        for line in axes.lines
        if len(line.get_xdata()) == 1
    ]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_arrow_starts_at_the_point_and_has_the_sign_of_the_reading(sign):
    elevation, side, plan = views(top=TOP.model_copy(update={"direction": (sign, 0.0, 0.0)}))
    (start, end), *_ = [each for each in arrows(elevation) if each[0] == pytest.approx((0.043, 0.44))]
    assert sign * (end[0] - start[0]) > 0.03
    assert end[1] == start[1]
    assert [each for each in arrows(plan) if each[0] == pytest.approx((0.043, 0.0))]
    dot, cross = (marker in [mark for mark, *place in marks(side) if place == [0.0, 0.44]] for marker in (".", "x"))
    assert (dot, cross) == (sign > 0, sign < 0)


def test_poles_centre_of_mass_and_dimensions_are_to_scale():
    elevation, *_ = views()
    found = marks(elevation)
    assert [(mark, x) for mark, x, _ in found if mark == "^"] == [("^", -0.043), ("^", 0.043)]
    assert any(mark == "+" and (x, z) == (0.0, pytest.approx(0.228)) for mark, x, z in found)
    outline = next(patch.get_xy() for patch in elevation.patches if patch.get_xy()[:, 1].max() == 0.456)
    assert outline[:, 0].max() == 0.043
    assert {"86 mm", "456 mm", "α", "θ > 0", "a > 0"} <= {text.get_text() for text in elevation.texts}
    bounds = elevation.get_position()
    width, height = elevation.get_figure(root=True).get_size_inches()
    across, up = (abs(high - low) for low, high in (elevation.get_xlim(), elevation.get_ylim()))
    assert across / (bounds.width * width) == pytest.approx(up / (bounds.height * height))


def test_no_dimension_crosses_the_edge_of_the_table_or_of_the_body():
    round_one = Body("circle", (0.097, 0.0755), (0.097, 0.0755), 0.48, True, Rocking.of(BLOCK))
    for body, depths in ((PRISM, {"60 mm"}), (round_one, set())):
        _, side, plan = views(body, top=TOP)
        renderer = FigureCanvasAgg(side.get_figure(root=True)).get_renderer()
        for view in (side, plan):
            edges = [patch.get_window_extent(renderer) for patch in view.patches]
            written = [text for text in view.texts if text.get_text()]
            for text in written:
                box = text.get_window_extent(renderer)
                crossed = [edge for edge in edges if edge.overlaps(box) and not edge.contains(box.x0, box.y0)]
                assert not crossed, text.get_text()
        assert {text.get_text() for text in side.texts if "mm" in text.get_text()} == depths


def changed(**keys):
    return TOP.model_copy(update=keys)


def drawn(one, *, named=True):
    """A view with one transducer at its place."""
    view = View.within(Figure(figsize=(4, 4)), (0.0, 0.0, 4.0, 4.0), (4.0, 4.0), ELEVATION, 0.2, (2.0, 1.0))
    draw_transducer(view, 3, "top", one, one.at, named=named)
    return view


@given(st.lists(st.floats(-1.0, 11.0), max_size=9))
def test_labels_stay_apart_and_within_the_view(wanted):
    placed = _spaced(sorted(wanted), 1.0, 0.0, 10.0)
    assert len(placed) == len(wanted)
    assert all(after - before >= 1.0 - 1e-9 for before, after in pairwise(placed))
    assert all(-1e-9 <= each <= 10.0 + 1e-9 for each in placed)


@every(
    ("one", "detail", "relative_to"),
    [
        (TOP, "displacement, to table", "table"),
        (changed(quantity="angular_velocity", relative_to=None), "angular velocity", ""),
        (changed(on="ground", quantity="acceleration", relative_to=None), "acceleration of ground", ""),
        (changed(direction=None, relative_to="ground"), "displacement, to ground, direction ?", "ground"),
    ],
)
def test_its_label_says_what_it_reads_in_the_colour_of_what_that_is_relative_to(one, detail, relative_to):
    assert drawn(one).labels[0][1:] == ("3 top", detail, COLOURS[relative_to])
    assert drawn(one, named=False).labels[0][1:3] == ("3", "")


def test_a_wire_ends_at_its_anchor_and_a_laser_looks_along_its_direction_at_a_face():
    wire = drawn(changed(anchor=(0.3, 0.0, 0.42))).axes.lines[0]
    assert (list(wire.get_xdata()), list(wire.get_ydata())) == ([0.043, 0.3], [0.44, 0.42])
    view = drawn(changed(sensing="surface", direction=(-1.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0)))
    sight, face = view.axes.lines[:2]
    assert sight.get_xdata()[1] > 0.043  # from outside
    assert len(set(sight.get_ydata())) == 1
    assert face.get_xdata() == pytest.approx([0.043, 0.043])
    assert np.mean(face.get_ydata()) == pytest.approx(0.44)
