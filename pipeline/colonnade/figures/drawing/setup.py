"""A specimen with the transducers of a setup in three views: a wrong sign or place is seen at once."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import NamedTuple

from matplotlib.figure import Figure, FigureBase

from colonnade.figures.drawing.body import (
    GAP,
    GROUND,
    TABLE,
    draw_axes,
    draw_body,
    draw_dimensions,
    draw_rocking,
    draw_senses,
    draw_table,
)
from colonnade.figures.drawing.parts import Body, Transducer
from colonnade.figures.drawing.transducers import draw_transducer, places_of
from colonnade.figures.drawing.view import FINE, SMALL, View
from colonnade.figures.style import INK, SOFT, WIDTH, styled, width

HEIGHT = 4.85
"""Of the drawing of one setup, inches."""

ELEVATION, SIDE, PLAN = (0, 2, -1), (1, 2, 1), (0, 1, 1)
"""Axes to the right and up, and whether the third points to the viewer."""

BASE = TABLE + GAP + GROUND + 0.65
"""Height of the table's top in the elevation and the side view, inches: below are table, ground and axes."""

LETTERS = 32
"""Of a line of the text below the plan."""

MARGIN, NARROW = 1.22, 0.22
"""Margins for labels in the elevation, and for numbers in the other views, inches."""


class Drawn(NamedTuple):
    """What is drawn once: its title, the specimen and its transducers."""

    title: str
    body: Body
    transducers: Sequence[Transducer]


@styled()
def setup_drawings(drawn: Sequence[Drawn]) -> Figure:
    """
    Draw specimens with their transducers, each to scale in elevation, from the side and from above.

    Parameters
    ----------
    drawn : sequence of Drawn
        One below the other.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is nothing to draw.

    Notes
    -----
    An arrow points in the direction of a positive reading, or along the axis of a rotation (two heads). A circle with a
    dot is an arrow towards the viewer, one with a cross an arrow away. A transducer whose place is not given is hollow
    and drawn on the +x face.
    """
    if not drawn:
        raise ValueError("no specimen was given; at least one with a setup was expected")
    figure = Figure(figsize=(width(), width() / WIDTH * HEIGHT * len(drawn)))
    parents = figure.subfigures(len(drawn), 1, squeeze=False)[:, 0]
    for parent, each in zip(parents, drawn, strict=True):
        _draw(parent, each)
    return figure


def _draw(parent: FigureBase, drawn: Drawn) -> None:
    body, transducers = drawn.body, drawn.transducers
    size = (WIDTH, HEIGHT)
    high = HEIGHT - BASE - 0.2
    inch = _inch(drawn, high - 0.55)
    half = max(*body.width, *body.depth) / 2 + 0.44 * inch
    elevation = View.within(parent, (0.0, 0.0, 3.9, HEIGHT - 0.2), size, ELEVATION, inch, (1.95, BASE))
    side = View.within(parent, (3.9, 0.0, 1.4, HEIGHT - 0.2), size, SIDE, inch, (0.7, BASE))
    plan = View.within(parent, (5.3, HEIGHT - 2.35, 1.9, 2.15), size, PLAN, inch, (0.95, 1.35))
    places = places_of(transducers, body, half, inch)
    for view, corner in ((elevation, (-0.2, -BASE + 0.14)), (side, (-0.2, -BASE + 0.14)), (plan, (-0.6, -1.23))):
        draw_table(view, min(half, (0.5 if view is side else 0.9) * inch))
        draw_body(view, body)
        if view is not plan:
            draw_dimensions(view, body)
        if body.rocking is not None:
            draw_rocking(view, body.rocking)
        for number, (one, place) in enumerate(zip(transducers, places, strict=True), start=1):
            draw_transducer(view, number, one, place, named=view is elevation)
        view.write_labels(MARGIN if view is elevation else NARROW)
        draw_axes(view, (corner[0] * inch, corner[1] * inch))
    draw_senses(elevation, body, half)
    for left, name, points, colour in (
        (0.05, drawn.title, 9.0, INK),
        (4.0, "from the side", SMALL, SOFT),
        (5.5, "from above", SMALL, SOFT),
    ):
        parent.text(left / WIDTH, 1 - 0.05 / HEIGHT, name, va="top", fontsize=points, color=colour)
    lines = "\n".join(line for word in body.words for line in wrap(word, LETTERS) or [""])
    parent.text(5.5 / WIDTH, (HEIGHT - 2.5) / HEIGHT, lines, va="top", fontsize=FINE, color=INK, linespacing=1.4)


def _inch(drawn: Drawn, high: float) -> float:
    """Return how many m an inch of paper shows, so that all of the body and of its transducers is seen in each view."""
    body = drawn.body
    points = [point for each in drawn.transducers for point in (each.at, each.anchor) if point is not None]
    across = max([*body.width, *(2 * abs(point[0]) for point in points)])
    deep = max([*body.depth, *(2 * abs(point[1]) for point in points)])
    top = max([body.height, *(point[2] for point in points)])
    return max(top / high, across / 1.3, deep / 0.96)
