"""Transducers in a view: a mark where each is, an arrow for its positive reading, its wire or line of sight."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

import numpy as np

from colonnade.figures.drawing.body import GAP, TABLE
from colonnade.figures.drawing.parts import MARKER, Body, Point, Transducer
from colonnade.figures.drawing.view import Spot, View
from colonnade.figures.style import INK

MARKS = {"displacement": "o", "velocity": "^", "acceleration": "s", "angle": "D", "angular_velocity": "d"}

COLOURS = {"table": "#0b6bb0", "ground": "#b55d00", "": INK}
"""By what a reading is relative to."""

ARROW, SHORT = 0.42, 0.28
"""Length of the arrow of a direction in the plane of the paper, in the elevation and in the other views, inches."""

END_ON = 0.2
"""Share of a direction in the plane of the paper below which it is drawn as one towards the viewer or away."""


def places_of(transducers: Sequence[Transducer], body: Body, half_table: float, inch: float) -> list[Point]:
    """
    Return where each transducer is drawn.

    Parameters
    ----------
    transducers : sequence of Transducer
    body : Body
    half_table : float
        m.
    inch : float
        m on an inch of paper.

    Returns
    -------
    places : list of Point
        As given; if not given, one below the other on the +x face of the specimen or on the face of the table, of
        accelerometers on its top, or at the ground.
    """
    groups: dict[tuple[str, bool], list[int]] = {}
    places: list[Point] = [each.at or (0.0, 0.0, 0.0) for each in transducers]
    for index, each in enumerate(transducers):
        if each.at is None:
            groups.setdefault((each.on, each.quantity == "acceleration"), []).append(index)
    edge = max(body.width) / 2
    aside = -half_table + (ARROW + 0.04) * inch  # an arrow to either side stays on the table
    for (on, accelerates), members in groups.items():
        shares = (np.arange(len(members)) + 0.5) / len(members)
        for index, share in zip(members, shares.tolist(), strict=True):
            if on == "specimen":
                places[index] = (edge, 0.0, body.height * (1.0 - share))
            elif on == "table" and accelerates:
                places[index] = (-half_table + share * (half_table - edge - 0.1 * inch), 0.0, 0.05 * inch)
            elif on == "table":
                places[index] = (aside, 0.0, -(0.5 + 0.4 * share) * TABLE * inch)
            else:
                places[index] = (aside, 0.0, -(TABLE + GAP) * inch)
    return places


def draw_transducer(view: View, number: int, one: Transducer, place: Point, *, named: bool) -> None:
    """Draw one transducer and ask for its label: number, name and what it reads, or its number alone."""
    spot, colour = view.spot(place), COLOURS.get(one.relative_to, COLOURS["table"])
    if one.anchor is not None:
        end = view.spot(one.anchor)
        view.line(spot, end, color=colour, linestyle=(0, (5.0, 1.5)), zorder=5)
        view.axes.plot(*end, "s", markersize=5.0, color=colour, markerfacecolor="white", zorder=6)
    if one.is_laser and one.direction is not None:
        _draw_sight(view, one, spot, colour)
    tip, is_seen_end_on = spot, False
    if one.direction is not None:
        flat = view.spot(one.direction)
        size = hypot(*flat) / max(float(np.linalg.norm(one.direction)), 1e-12)
        is_seen_end_on = size < END_ON
        if is_seen_end_on:
            view.through(spot, colour, towards=view.depth(one.direction) > 0)
        else:
            step = (ARROW if named else SHORT) * view.inch / max(hypot(*flat), 1e-12) * size
            tip = (spot[0] + step * flat[0], spot[1] + step * flat[1])
            view.arrow(spot, tip, colour)
            if one.is_turn:  # a second head: the arrow is an axis
                view.arrow(spot, (spot[0] + 0.75 * (tip[0] - spot[0]), spot[1] + 0.75 * (tip[1] - spot[1])), colour)
    if not is_seen_end_on:
        fill = colour if one.at is not None or one.on != "specimen" else "white"
        view.axes.plot(
            *spot, MARKS.get(one.quantity, "o"), markersize=4.5, color=colour, markerfacecolor=fill, zorder=8
        )
    outer = max(spot, tip, key=lambda each: each[0]) if spot[0] >= 0 else min(spot, tip, key=lambda each: each[0])
    anchor = outer if (outer[0] < 0) == (spot[0] < 0) else spot
    view.label(anchor, f"{number} {one.name}" if named else str(number), _detail(one) if named else "", colour)


def _draw_sight(view: View, one: Transducer, spot: Spot, colour: str) -> None:
    """Draw the line of sight of a laser, and the face that it looks at."""
    flat = view.spot(one.direction or (0.0, 0.0, 0.0))
    if hypot(*flat) < 1e-6:
        return
    across = (flat[0] / hypot(*flat), flat[1] / hypot(*flat))
    outward = 1.0 if across[0] * spot[0] + across[1] * spot[1] >= 0 else -1.0
    reach = 0.75 * view.inch * outward
    view.line(
        spot, (spot[0] + reach * across[0], spot[1] + reach * across[1]), color=colour, linestyle=(0, (6, 2, 1, 2))
    )
    normal = view.spot(one.normal) if one.normal is not None else None
    if normal is not None and hypot(*normal) > 1e-6:
        half = 0.14 * view.inch / hypot(*normal)
        along = (-normal[1] * half, normal[0] * half)
        ends = ((spot[0] - along[0], spot[1] - along[1]), (spot[0] + along[0], spot[1] + along[1]))
        view.line(*ends, color=colour, linewidth=2.0, zorder=7)


def _detail(one: Transducer) -> str:
    said = one.quantity.replace("_", " ")
    said += f", to {one.relative_to}" if one.relative_to else f" of {one.on}" if one.on != "specimen" else ""
    return said if one.direction is not None or one.quantity == MARKER else f"{said}, direction ?"
