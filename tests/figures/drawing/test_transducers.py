"""Where a transducer is drawn that has no place, and what its mark, arrow, wire and label say."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from colonnade.campaign.channel import Channel
from colonnade.figures.drawing.body import GAP, TABLE
from colonnade.figures.drawing.setup import ARROW, COLOURS, ELEVATION, SIDE, draw_transducer, places_of
from colonnade.figures.drawing.view import Body, View

BODY = Body("rectangle", (0.086, 0.086), (0.06, 0.06), 0.456, True, None)
TOP = Channel.model_construct(
    quantity="displacement", on="specimen", direction=(1.0, 0.0, 0.0), at=(0.043, 0.0, 0.44), relative_to="table"
)
INCH = 0.2


def changed(**keys):
    return TOP.model_copy(update=keys)


def drawn(one, orientation=ELEVATION, *, named=True):
    """A view with one transducer, at its place or at the middle of the specimen."""
    figure = Figure(figsize=(4, 4))
    view = View.within(figure, (0.0, 0.0, 4.0, 4.0), (4.0, 4.0), orientation, INCH, (2.0, 1.0))
    draw_transducer(view, 3, "top", one, one.at or (0.0, 0.0, 0.2), named=named)
    return view


def arrows(view):
    return [np.subtract(text.xy, text.xyann) for text in view.axes.texts if text.get_text() == ""]


def without_place(*, on, quantity="displacement", number=1):
    one = Channel.model_construct(quantity=quantity, on=on, direction=(1.0, 0.0, 0.0))
    return dict.fromkeys(map(str, range(number)), one)


def test_on_the_specimen_they_are_one_below_the_other_on_its_face():
    places = places_of(without_place(on="specimen", number=2), BODY, 0.15, INCH)
    assert places["0"] == pytest.approx((0.043, 0.0, 0.75 * 0.456))
    assert places["1"] == pytest.approx((0.043, 0.0, 0.25 * 0.456))


def test_on_the_table_accelerometers_are_on_top_of_it_and_others_on_its_face():
    ((across, _, up),) = places_of(without_place(on="table", quantity="acceleration"), BODY, 0.15, INCH).values()
    assert -0.15 < across < -0.043
    assert 0 < up < 0.1 * INCH
    ((_, _, low),) = places_of(without_place(on="table"), BODY, 0.15, INCH).values()
    assert -TABLE * INCH < low < 0


def test_on_the_ground_they_are_below_the_table():
    ((_, _, low),) = places_of(without_place(on="ground", quantity="acceleration"), BODY, 0.15, INCH).values()
    assert low == pytest.approx(-(TABLE + GAP) * INCH)


def test_a_direction_out_of_the_paper_is_shorter_and_one_at_right_angles_is_a_mark():
    (arrow,) = arrows(drawn(changed(direction=(0.6, 0.8, 0.0))))
    assert arrow == pytest.approx((0.6 * ARROW * INCH, 0.0))
    through = drawn(TOP, SIDE)
    assert arrows(through) == []
    assert "." in [line.get_marker() for line in through.axes.lines]


def test_the_axis_of_a_rotation_has_a_second_head():
    turn = changed(quantity="angular_velocity", direction=(0.0, 0.0, 1.0))
    long, short = arrows(drawn(turn))
    assert short == pytest.approx(0.75 * long)


@pytest.mark.parametrize("relative_to", ["table", "ground", None])
def test_its_colour_says_what_a_reading_is_relative_to(relative_to):
    view = drawn(changed(relative_to=relative_to))
    assert view.axes.lines[-1].get_color() == COLOURS[relative_to or ""]
    assert view.labels[0][3] == COLOURS[relative_to or ""]


def test_a_place_that_is_guessed_is_hollow():
    assert drawn(TOP).axes.lines[-1].get_markerfacecolor() == COLOURS["table"]
    assert drawn(changed(at=None)).axes.lines[-1].get_markerfacecolor() == "white"


@pytest.mark.parametrize(
    ("one", "detail"),
    [
        (TOP, "displacement, to table"),
        (changed(quantity="angular_velocity", relative_to=None), "angular velocity"),
        (changed(on="ground", quantity="acceleration", relative_to=None), "acceleration of ground"),
        (changed(direction=None), "displacement, to table, direction ?"),
    ],
    ids=["to the table", "absolute", "of the ground", "without a direction"],
)
def test_its_label_says_what_it_reads(one, detail):
    assert drawn(one).labels[0][1:3] == ("3 top", detail)
    assert drawn(one, named=False).labels[0][1:3] == ("3", "")


def test_a_wire_ends_at_its_anchor():
    view = drawn(changed(anchor=(0.3, 0.0, 0.42)))
    wire = view.axes.lines[0]
    assert (list(wire.get_xdata()), list(wire.get_ydata())) == ([0.043, 0.3], [0.44, 0.42])


def test_a_laser_looks_along_its_direction_at_a_face():
    view = drawn(changed(sensing="surface", direction=(-1.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0)))
    sight, face = view.axes.lines[:2]
    assert sight.get_xdata()[1] > 0.043  # from outside
    assert len(set(sight.get_ydata())) == 1
    assert face.get_xdata() == pytest.approx([0.043, 0.043])
    assert np.mean(face.get_ydata()) == pytest.approx(0.44)
