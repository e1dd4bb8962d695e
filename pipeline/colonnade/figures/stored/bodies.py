"""The bodies of an assembly: the angle in each joint over time, and where each stands at the end, seen from above."""

from __future__ import annotations

from math import cos, sin

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from colonnade.arrays import Array
from colonnade.campaign.assembly import Whole
from colonnade.campaign.forms.summary import BodyPrediction
from colonnade.dynamics.assembly import Assembly
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import Panel, draw_panel
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import legend_above, legend_outside, stacked_panels
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import SOFT, blank_figure, name_of, style_of, styled
from colonnade.units.text import joined, number, quantity

HEIGHT, SQUARE = 0.9, 1.9
"""Height of a joint's panel, and of a plan, inches."""

MOST_PLANS = 4
"""Plans side by side."""

CIRCLE = 48
"""Corners of a round base as it is drawn."""


def panels(one: OfTest) -> list[Panel]:
    """Return the panel of the joint below each body, the upper ones first."""
    found = []
    for place, name in reversed(list(enumerate(one.stored.array("rocking", "body")))):
        angles = one.bodies(place, "body_joint_angle")
        curves = {who: Curve(curve.time, 1e3 * curve.values) for who, curve in angles.items()}
        found.append(Panel(f"Rocking angle in the joint below {name}", str(name), "mrad", curves))
    return found


@styled()
def joints(one: OfTest) -> Picture | None:
    """
    Angle in the joint below each body over time.

    Rocking angle of each body relative to the first that it stands on, or to the table.
    """
    shown = panels(one)
    if not shown:
        return None
    figure, axes = stacked_panels([HEIGHT] * len(shown))
    for place, panel in zip(axes, shown, strict=True):
        draw_panel(place, panel)
    axes[-1].set_xlabel("time (s)")
    legend_above(figure, axes)
    said = [f"{name}: {_said(record.outcome, record.opening)}" for name, record in one.record.bodies.items()]
    title = f"{one.test.id}: rocking angle in the joint below each body, measured and predicted"
    return Picture(figure, f"joints-{one.test.id}", title, f"{'; '.join(said)}.")


def _said(outcome: str | None, opening: float | None) -> str:
    far = "" if opening is None else f", joint open by up to {quantity(opening, 'mm')}"
    return f"{outcome or 'not measured'}{far}"


def plan(one: OfTest) -> Picture | None:
    """
    Where each body stands at the end, from above.

    The base of each body from above, to scale: at rest, at the end as measured, and as each model has it.
    """
    shown: dict[str, dict[str, BodyPrediction]] = {}
    for name, record in one.record.bodies.items():
        every = {"measured": record, **record.predicted}
        stands = {who: each for who, each in every.items() if each.outcome != "overturned"}
        ended = {who: each for who, each in stands.items() if each.residual_x is not None}
        if ended and record.outcome != "overturned":
            shown[name] = ended
    whole = one.specimen
    if not shown or not isinstance(whole, Whole):
        return None
    far = {name: quantity(1e-3 * _distance(next(iter(every.values()))), "mm") for name, every in shown.items()}
    title = f"{one.test.id}: where each body stands at the end, from above, to scale"
    said = f"{joined([f'{name} {moved}' for name, moved in far.items()])} from where it stood."
    return Picture(_plan(shown, whole.assembly(one.campaign.gravity)), f"plan-{one.test.id}", title, said)


def _distance(record: BodyPrediction) -> float:
    """Of the end from where the body stood, mm."""
    return 1e3 * float(np.hypot(record.residual_x or 0.0, record.residual_y or 0.0))


@styled()
def _plan(shown: dict[str, dict[str, BodyPrediction]], assembly: Assembly) -> Figure:
    columns = min(len(shown), MOST_PLANS)
    rows = -(-len(shown) // columns)
    figure = blank_figure(SQUARE * rows + 0.3)
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for panel in axes[len(shown) :]:
        panel.set_axis_off()
    for panel, (name, every) in zip(axes, shown.items(), strict=False):
        outline = 1e3 * _base(assembly, name)
        panel.add_patch(Polygon(outline, fill=False, edgecolor=SOFT, linestyle=(0, (1, 2)), label="at rest"))
        for who, record in every.items():
            cosine, sine = cos(record.residual_yaw or 0.0), sin(record.residual_yaw or 0.0)
            place = 1e3 * np.array([record.residual_x or 0.0, record.residual_y or 0.0])
            corners = outline @ np.array([[cosine, sine], [-sine, cosine]]) + place
            label = "at the end" if who == "measured" else f"at the end, {name_of(who)}"
            panel.add_patch(Polygon(corners, fill=False, label=label, **style_of(who)))
        panel.set_aspect("equal", adjustable="datalim")
        panel.autoscale_view()
        panel.margins(0.12)
        panel.set_title(f"{name}: {number(_distance(next(iter(every.values()))))} mm", fontsize=8)
        panel.tick_params(labelsize=7)
    axes[0].set(ylabel="y (mm)", xlabel="x (mm)")
    legend_outside(figure, list(axes))
    return figure


def _base(assembly: Assembly, name: str) -> Array:
    """Corners of a body's base from above, about its centre, m."""
    block = assembly.bodies[name].block
    half, solid = block.governing.half_width, block.solid
    if solid is not None and solid.base == "circle":
        around = np.linspace(0, 2 * np.pi, CIRCLE, endpoint=False)
        return half * np.column_stack((np.cos(around), np.sin(around)))
    deep = half if solid is None else solid.half_depth
    return np.array([(-half, -deep), (half, -deep), (half, deep), (-half, deep)])
