"""The specimen in a view: outline, dimensions, centre of mass, poles, critical angle, table and ground."""

from __future__ import annotations

from math import atan2, cos, degrees, sin

import numpy as np

from colonnade.figures.drawing.view import LINE, NAMES, NORMAL, SMALL, Body, Point, Rocking, Spot, View, along
from colonnade.figures.style import FAINT, INK, SOFT

TABLE, GAP, GROUND = 0.42, 0.13, 0.1
"""Thickness of the table, its distance from the ground, and what is shown of the ground; inches."""

STEEL, WOOD = "#e8ecf1", "#f3f0ea"
"""Fill of the body, and of the table."""


def draw_table(view: View, half: float) -> None:
    """Draw the table, `half` (m) to either side, and the ground below it; from above the table alone."""
    inch = view.inch
    low, high = (-half, half) if view.up == 1 else (-TABLE * inch, 0.0)
    view.shape([(-half, low), (half, low), (half, high), (-half, high)], facecolor=WOOD, edgecolor=FAINT, zorder=0)
    if view.up == 1:
        return
    view.line((-half, 0.0), (half, 0.0), color=INK, linewidth=LINE, zorder=1)
    floor = low - GAP * inch
    view.line((-1.15 * half, floor), (1.15 * half, floor), color=INK, linewidth=LINE)
    for place in np.linspace(-1.1 * half, 1.1 * half, 14):
        view.line((place, floor), (place - 0.06 * inch, floor - GROUND * inch), color=FAINT)
    for place in (-0.6 * half, 0.6 * half):
        view.mark((place, (low + floor) / 2), "o", 5.0, FAINT, markerfacecolor="none")


def draw_body(view: View, body: Body, at: Point = (0.0, 0.0, 0.0)) -> None:
    """Draw the outline, and whether it stands in for one that is not known; of several bodies each, with its name."""
    for name, (part, place) in body.parts.items():
        draw_body(view, part, place)
        if view.up == 2 and view.across == 0:
            turn = 90 if part.height > 2 * part.width[0] else 0
            view.text((place[0], place[2] + 0.4 * part.height), name, rotation=turn, zorder=5)
    if body.parts:
        return
    outlines = [body.outline(view.across)]
    if view.up == 1:  # the top of a cone is seen within its base
        outlines = [_seen_from_above(body, end) for end in (0, 1)][: 1 + (body.width[0] != body.width[1])]
    for outline, fill in zip(outlines, (STEEL, "none"), strict=False):
        corners = [along(view.spot(at), corner, 1.0) for corner in outline]
        view.shape(corners, facecolor=fill, zorder=3, linestyle="-" if body.is_known else (0, (4.0, 2.0)))


def _seen_from_above(body: Body, end: int) -> list[Spot]:
    x, y = body.width[end] / 2, body.depth[end] / 2
    if body.base == "rectangle":
        return [(-x, -y), (x, -y), (x, y), (-x, y)]
    return [(x * cos(turn), y * sin(turn)) for turn in np.linspace(0.0, 2 * np.pi, 73)[:-1]]


def draw_dimensions(view: View, body: Body) -> None:
    """Give width and height in the elevation, of a cone both diameters; in the side view the depth, above the body."""
    inch, is_elevation = view.inch, view.across == 0
    sizes = body.width if is_elevation else body.depth
    sign = "⌀ " if body.base == "circle" else ""
    is_drawn = body.is_known or body.rocking is None

    def across(size: float, height: float, beside: Spot) -> None:
        written = f"{sign}{_millimetres(size)}" if body.is_known else "?"
        view.dimension((-size / 2, height), (size / 2, height), written, beside=beside)

    above = body.height + 0.09 * inch
    if is_elevation and sizes[1] != sizes[0]:
        across(sizes[1], above, (0.0, 0.1))
    if is_elevation and is_drawn:
        across(sizes[0], -0.13 * inch, (0.0, -0.1))
        left = -max(sizes) / 2 - 0.14 * inch
        height = _millimetres(body.height) if body.is_known else "?"
        view.dimension((left, 0.0), (left, body.height), height, beside=(-0.09, 0.0))
    # The narrow table has no room for it next to what is fixed to its middle. A round body is as deep as it is wide.
    if not is_elevation and is_drawn and body.base == "rectangle":
        across(sizes[1], above, (0.0, 0.1))


def draw_rocking(view: View, rocking: Rocking) -> None:
    """Mark the centre of mass and, in the elevation, the poles with the critical angle at each side that differs."""
    if view.across != 0:
        _mark_centre(view, (0.0, rocking.centre[1]))
        return
    if view.up == 1:
        _mark_centre(view, (rocking.centre[0], 0.0))
        return
    for pole in rocking.poles:
        view.mark((pole, 0.0), "^", 5.5, INK, zorder=6, clip_on=False)
    (negative, positive), (low, high) = rocking.poles, rocking.critical_angles
    _draw_angle(view, positive, rocking.centre, "α" if low == high else "α, θ > 0", outside=low != high)
    if low != high:
        _draw_angle(view, negative, rocking.centre, "α, θ < 0", outside=True)
    _mark_centre(view, rocking.centre)


def _draw_angle(view: View, pole: float, centre: Spot, name: str, *, outside: bool) -> None:
    """Draw the line from the pole to the centre of mass, the vertical, and the critical angle between them."""
    view.line((pole, 0.0), centre, color=INK, zorder=4)
    view.line((pole, 0.0), (pole, 1.12 * centre[1]), color=INK, linestyle=(0, (3.0, 2.0)), zorder=4)
    radius, lean = 0.62 * centre[1], atan2(centre[0] - pole, centre[1])
    turns = np.linspace(0.0, lean, 20)
    view.line(*((pole + radius * sin(turn), radius * cos(turn)) for turn in turns), color=INK, linewidth=0.7, zorder=4)
    if outside:
        view.text((pole + (0.04 if pole > 0 else -0.04) * view.inch, radius), name, ha="left" if pole > 0 else "right")
        return
    beyond = radius + 0.09 * view.inch
    view.text((pole + beyond * sin(lean / 2), beyond * cos(lean / 2)), name, zorder=5)


def _mark_centre(view: View, spot: Spot) -> None:
    view.mark(spot, "o", 7.0, INK, markerfacecolor="white", zorder=5)
    view.mark(spot, "+", 7.0, INK, zorder=5)


def draw_senses(view: View, body: Body, half_table: float) -> None:
    """Draw which way θ and the base motion are positive."""
    inch = view.inch
    top = body.height + (0.3 if body.width[0] != body.width[1] else 0.12) * inch
    view.arrow((-0.24 * inch, top), (0.24 * inch, top), INK, connectionstyle="arc3,rad=-0.3")
    view.text((0.0, top + 0.16 * inch), "θ > 0", fontsize=NORMAL)
    low, edge = -0.7 * TABLE * inch, half_table + 0.06 * inch
    view.arrow((edge, low), (edge + 0.36 * inch, low), INK)
    view.text((edge, low - 0.09 * inch), "a > 0", ha="left", fontsize=NORMAL)
    view.text((half_table - 0.06 * inch, -0.8 * TABLE * inch), "table", ha="right", fontsize=SMALL)


def draw_axes(view: View, corner: Spot) -> None:
    """Draw the axes at a corner, the third towards or away from the viewer."""
    arm = 0.3 * view.inch
    x, y = corner
    view.arrow(corner, (x + arm, y), SOFT)
    view.arrow(corner, (x, y + arm), SOFT)
    view.through(corner, SOFT, towards=view.towards > 0)
    view.text((x + arm + 0.06 * view.inch, y), NAMES[view.across], fontsize=NORMAL)
    view.text((x, y + arm + 0.08 * view.inch), NAMES[view.up], fontsize=NORMAL)
    view.text((x - 0.1 * view.inch, y - 0.04 * view.inch), NAMES[3 - view.across - view.up], fontsize=NORMAL)


def words_of_angle(angle: float) -> str:
    """Write a critical angle in both units."""
    return f"{angle:.4g} rad = {degrees(angle):.4g}°"


def _millimetres(size: float) -> str:
    return f"{1e3 * size:.4g} mm" if size < 2.0 else f"{size:.4g} m"
