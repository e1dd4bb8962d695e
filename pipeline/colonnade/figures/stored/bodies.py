"""The bodies of an assembly: the angle in each joint over time, and where each stands at the end, seen from above."""

from __future__ import annotations

from math import cos, sin

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from colonnade.arrays import Array
from colonnade.campaign import Test
from colonnade.campaign.forms.summary import BodyPrediction
from colonnade.dynamics.assembly import Assembly
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import Panel, draw_panel
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import legend_above, legend_outside, stacked_panels
from colonnade.figures.style import SOFT, blank_figure, name_of, style_of, styled
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import bodies_of
from colonnade.units.text import joined, number, quantity

PANEL, SQUARE = 0.9, 1.9
"""Height of a joint's panel, and of a plan, inches."""

MOST_PLANS = 4
"""Plans side by side."""

CIRCLE = 48
"""Corners of a round base as it is drawn."""


def histories(stored: Stored, place: int, name: str) -> dict[str, Curve]:
    """Return what was measured, and what each model predicts, of the body at a place: `body_…` over time, SI."""
    found = {"measured": ("rocking", None)} | {model: ("predict", model) for model in stored.models("predict")}
    curves = {
        who: Curve(stored.array(stage, "elapsed", model), stored.array(stage, name, model)[place])
        for who, (stage, model) in found.items()
        if stored.has(stage, name, model)
    }
    return {who: curve for who, curve in curves.items() if np.isfinite(curve.values).any()}


def joints(test: Test, stored: Stored) -> Picture | None:
    """Draw the rocking angle in the joint below each body, the upper ones above; None without several bodies."""
    records = bodies_of(stored)
    if not records:
        return None
    said = [f"{name}: {_said(record.outcome, record.opening)}" for name, record in records.items()]
    title = f"{test.id}: rocking angle in the joint below each body, measured and predicted"
    return Picture(_joints(stored, list(records)), f"joints-{test.id}", title, f"{'; '.join(said)}.")


def _said(outcome: str | None, opening: float | None) -> str:
    far = "" if opening is None else f", joint open by up to {quantity(opening, 'mm')}"
    return f"{outcome or 'not measured'}{far}"


@styled()
def _joints(stored: Stored, names: list[str]) -> Figure:
    figure, axes = stacked_panels([PANEL] * len(names))
    for panel, (place, name) in zip(axes, reversed(list(enumerate(names))), strict=True):
        found = histories(stored, place, "body_joint_angle")
        curves = {who: Curve(curve.time, 1e3 * curve.values) for who, curve in found.items()}
        draw_panel(panel, Panel(f"{name}\n(mrad)", curves))
    axes[-1].set_xlabel("time (s)")
    legend_above(figure, axes)
    return figure


def plan(test: Test, stored: Stored, assembly: Assembly) -> Picture | None:
    """Draw the base of each body from above, to scale: at rest, at the end, and as predicted; None without bodies."""
    shown: dict[str, dict[str, BodyPrediction]] = {}
    for name, record in bodies_of(stored).items():
        every = {"measured": record, **record.predicted}
        stands = {who: each for who, each in every.items() if each.outcome != "overturned"}
        ended = {who: each for who, each in stands.items() if each.residual_x is not None}
        if ended and record.outcome != "overturned":
            shown[name] = ended
    if not shown:
        return None
    far = {name: quantity(1e-3 * _distance(next(iter(every.values()))), "mm") for name, every in shown.items()}
    title = f"{test.id}: where each body stands at the end, from above, to scale"
    said = f"{joined([f'{name} {moved}' for name, moved in far.items()])} from where it stood."
    return Picture(_plan(shown, assembly), f"plan-{test.id}", title, said)


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
