"""A specimen with the transducers of a setup in three views: a wrong sign or place is seen at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from textwrap import wrap
from typing import NamedTuple

from matplotlib.figure import Figure, FigureBase

from colonnade.campaign.channel import Channel
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
from colonnade.figures.drawing.view import FINE, SMALL, Body, Label, Point, Spot, View, along
from colonnade.figures.style import INK, SOFT, WIDTH, styled, width

MARKS = {"displacement": "o", "velocity": "^", "acceleration": "s", "angle": "D", "angular_velocity": "d"}

COLOURS = {"table": "#0b6bb0", "ground": "#b55d00", "": INK}
"""By what a reading is relative to."""

ARROW, SHORT = 0.42, 0.28
"""Length of the arrow of a direction in the plane of the paper, in the elevation and in the other views, inches."""

END_ON = 0.2
"""Share of a direction in the plane of the paper below which it is drawn as one towards the viewer or away."""


MARKER = "marker"
"""Quantity of a point that is followed along three axes."""


def places_of(transducers: Mapping[str, Channel], body: Body, half_table: float, inch: float) -> dict[str, Point]:
    """
    Return where each transducer is drawn: as given, or one below the other where it is fixed.

    That is the +x face of the specimen, the face of the table, of accelerometers its top, or the ground. The table
    reaches `half_table` (m) to either side; `inch` is m on an inch of paper.
    """
    groups: dict[tuple[str | None, bool], list[str]] = {}
    for name, each in transducers.items():
        if each.at is None:
            groups.setdefault((each.on, each.quantity == "acceleration"), []).append(name)
    edge = max(body.width) / 2
    aside = -half_table + (ARROW + 0.04) * inch  # an arrow to either side stays on the table
    places = {name: each.at or (aside, 0.0, -(TABLE + GAP) * inch) for name, each in transducers.items()}
    for (on, accelerates), names in groups.items():
        for index, name in enumerate(names):
            share = (index + 0.5) / len(names)
            if on == "specimen":
                places[name] = (edge, 0.0, body.height * (1.0 - share))
            elif on == "table" and accelerates:
                places[name] = (-half_table + share * (half_table - edge - 0.1 * inch), 0.0, 0.05 * inch)
            elif on == "table":
                places[name] = (aside, 0.0, -(0.5 + 0.4 * share) * TABLE * inch)
    return places


def draw_transducer(view: View, number: int, name: str, one: Channel, place: Point, *, named: bool) -> None:
    """Draw one transducer and ask for its label: number, name and what it reads, or its number alone."""
    spot, colour = view.spot(place), COLOURS.get(one.relative_to or "", COLOURS["table"])
    if one.anchor is not None:
        end = view.spot(one.anchor)
        view.line(spot, end, color=colour, linestyle=(0, (5.0, 1.5)), zorder=5)
        view.mark(end, "s", 5.0, colour, markerfacecolor="white", zorder=6)
    tip, is_seen_end_on = spot, False
    if one.direction is not None:
        flat, size = view.spot(one.direction), hypot(*one.direction)
        if one.sensing == "surface":
            _draw_sight(view, flat, one.normal, spot, colour)
        is_seen_end_on = hypot(*flat) < END_ON * size
        if is_seen_end_on:
            view.through(spot, colour, towards=view.depth(one.direction) > 0)
        else:
            step = (ARROW if named else SHORT) * view.inch / size
            tip = along(spot, flat, step)
            view.arrow(spot, tip, colour)
            if one.quantity in ("angle", "angular_velocity"):  # a second head: the arrow is an axis
                view.arrow(spot, along(spot, flat, 0.75 * step), colour)
    if not is_seen_end_on:
        fill = colour if one.at is not None or one.on != "specimen" else "white"
        view.mark(spot, MARKS.get(one.quantity, "o"), 4.5, colour, markerfacecolor=fill, zorder=8)
    outer = (max if spot[0] >= 0 else min)(spot, tip, key=lambda each: each[0])
    label = (f"{number} {name}", _detail(one)) if named else (str(number), "")
    view.labels.append(Label(outer, *label, colour))


def _draw_sight(view: View, flat: Spot, normal: Point | None, spot: Spot, colour: str) -> None:
    """Draw the line of sight of a laser in a direction, and the face that it looks at, by its normal."""
    if hypot(*flat) < 1e-6:
        return
    outward = 1.0 if flat[0] * spot[0] + flat[1] * spot[1] >= 0 else -1.0
    seen = along(spot, flat, 0.75 * view.inch * outward / hypot(*flat))
    view.line(spot, seen, color=colour, linestyle=(0, (6, 2, 1, 2)))
    across, up = view.spot(normal or (0.0, 0.0, 0.0))
    if hypot(across, up) > 1e-6:
        face, half = (-up, across), 0.14 * view.inch / hypot(across, up)
        view.line(along(spot, face, -half), along(spot, face, half), color=colour, linewidth=2.0, zorder=7)


def _detail(one: Channel) -> str:
    said = one.quantity.replace("_", " ")
    said += f", to {one.relative_to}" if one.relative_to else f" of {one.on}" if one.on != "specimen" else ""
    return said if one.direction is not None or one.quantity == MARKER else f"{said}, direction ?"


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
    transducers: Mapping[str, Channel]


@styled()
def setup_drawings(drawn: Sequence[Drawn]) -> Figure:
    """
    Draw specimens with their transducers below each other, each to scale in elevation, from the side and from above.

    An arrow points in the direction of a positive reading, or along the axis of a rotation (two heads). A circle with a
    dot is an arrow towards the viewer, one with a cross an arrow away. A transducer whose place is not given is hollow
    and drawn on the +x face.
    """
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
        for number, (name, one) in enumerate(transducers.items(), start=1):
            draw_transducer(view, number, name, one, places[name], named=view is elevation)
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
    points = [point for each in drawn.transducers.values() for point in (each.at, each.anchor) if point is not None]
    across = max([*body.width, *(2 * abs(point[0]) for point in points)])
    deep = max([*body.depth, *(2 * abs(point[1]) for point in points)])
    top = max([body.height, *(point[2] for point in points)])
    return max(top / high, across / 1.3, deep / 0.96)
