"""The block itself as it rocks: measured and by each model, on the motion of its base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from colonnade.arrays import Array
from colonnade.campaign import Test
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block
from colonnade.figures.drawing.described import body_of
from colonnade.figures.drawing.view import Body
from colonnade.figures.files.output import Movie
from colonnade.figures.histories import time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.record import base_displacement, true_angle
from colonnade.figures.style import INK, MEASURED, SOFT, model_style, styled
from colonnade.store.records.stored import Stored

RATE, MOST_FRAMES = 25.0, 250
"""Frames a second, and of a movie: a longer test is played faster."""

FALLS = 0.5
"""rad: an angle beyond it needs room for a block that lies down."""

SIZE = (3.6, 4.0)
"""Of the picture, inches."""

FACE = "#e8ecf1"
"""Colour of a body."""


@styled()
def rocking_block(
    angles: Mapping[str, Curve],
    body: Body,
    base: Curve | None,
    *,
    title: str,
    description: str,
    figure: Figure | None = None,
) -> Movie:
    """
    Draw the rocking block, one outline for each history.

    Parameters
    ----------
    angles : mapping of str to Curve
        θ in rad over time (s): under "measured", and by model.
    body : Body
        With what it rocks about.
    base : Curve or None
        Displacement of the base, m, over time; None if it was not recorded: the base is then drawn at rest.
    title, description : str
    figure : Figure, optional
        To draw into, empty; a new one otherwise.

    Returns
    -------
    movie : Movie
        Of at most `MOST_FRAMES` frames; a long test is shown faster, and the picture says how much.

    Raises
    ------
    ValueError
        If there is no history or it is not known what the body rocks about.
    """
    if not angles or body.rocking is None:
        raise ValueError("no history of a body with poles was given; at least one was expected")
    first, last = time_limits(list(angles.values()))
    frames = min(max(ceil((last - first) * RATE), 2), MOST_FRAMES)
    times = np.linspace(first, last, frames)
    speed = (last - first) * RATE / frames
    shift = np.zeros(frames) if base is None else _at(base, times)
    shift = shift - shift[0]
    figure = figure or Figure(figsize=SIZE)
    axes = figure.add_axes((0.0, 0.0, 1.0, 0.86))
    axes.set_axis_off()
    axes.set_aspect("equal")
    falls = max(float(np.nanmax(np.abs(curve.values))) for curve in angles.values()) > FALLS
    wide = body.height * (1.15 if falls else 0.6) + float(np.abs(shift).max())
    axes.set_xlim(-wide, wide)
    axes.set_ylim(-0.15 * body.height, max(1.12 * body.height, body.height + 0.2 * max(body.width)))
    (table,) = axes.plot([], [], color=INK, linewidth=2.0)
    poles, corners = body.rocking.poles, _outline(body)
    blocks: list[tuple[Polygon, Array]] = []
    for name, curve in angles.items():
        look = MEASURED if name == "measured" else model_style(name)
        block = Polygon(corners, closed=True, label=_label(name), edgecolor=look["color"], linestyle=look["linestyle"])
        block.set_facecolor(FACE if name == "measured" else "none")
        axes.add_patch(block)
        blocks.append((block, _at(curve, times)))
    figure.legend(loc="upper left", ncols=2, fontsize=7, borderaxespad=0.3, columnspacing=1.0)
    clock = axes.text(0.98, 0.02, "", transform=axes.transAxes, ha="right", fontsize=8, color=SOFT)

    def show(frame: int) -> None:
        aside = np.array([shift[frame], 0.0])
        for block, turned in blocks:
            block.set_xy(turn(corners, float(turned[frame]), poles) + aside)
        table.set_data(shift[frame] + np.array([-0.5, 0.5]) * body.height, [0.0, 0.0])
        clock.set_text(f"{times[frame]:.2f} s" + (f", {speed:.2g} × faster" if speed > 1.01 else ""))

    return Movie(figure, show, frames, RATE, title, description)


@styled()
def moving_bodies(
    outlines: Mapping[str, Array], time: Array, *, title: str, description: str, figure: Figure | None = None
) -> Movie:
    """
    Draw several bodies as they move, each by its outline, seen from the table.

    Parameters
    ----------
    outlines : mapping of str to ndarray, shape (n, k, 2)
        By body, x and z of its corners, m.
    time : ndarray, shape (n,)
        s.
    title, description : str
    figure : Figure, optional
        To draw into, empty; a new one otherwise.

    Returns
    -------
    movie : Movie
        Of at most `MOST_FRAMES` frames.
    """
    lowest = np.min([outline.min(axis=(0, 1)) for outline in outlines.values()], axis=0)
    highest = np.max([outline.max(axis=(0, 1)) for outline in outlines.values()], axis=0)
    frames = min(max(ceil((time[-1] - time[0]) * RATE), 2), MOST_FRAMES)
    times = np.linspace(time[0], time[-1], frames)
    samples = np.clip(np.searchsorted(time, times), 0, time.size - 1)
    speed, margin = (times[-1] - times[0]) * RATE / frames, 0.1 * float((highest - lowest).max())
    figure = figure or Figure(figsize=SIZE)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_aspect("equal")
    axes.set(xlim=(lowest[0] - margin, highest[0] + margin), ylim=(min(0.0, lowest[1]) - margin, highest[1] + margin))
    axes.plot([lowest[0] - margin, highest[0] + margin], [0.0, 0.0], color=INK, linewidth=2.0)
    drawn = {name: Polygon(outline[0], edgecolor=INK, facecolor=FACE) for name, outline in outlines.items()}
    for block in drawn.values():
        axes.add_patch(block)
    clock = axes.text(0.98, 0.02, "", transform=axes.transAxes, ha="right", fontsize=8, color=SOFT)

    def show(frame: int) -> None:
        for name, body in drawn.items():
            body.set_xy(outlines[name][samples[frame]])
        clock.set_text(f"{times[frame]:.2f} s" + (f", {speed:.2g} × faster" if speed > 1.01 else ""))

    return Movie(figure, show, frames, RATE, title, description)


def turn(outline: Array, angle: float, poles: Sequence[float]) -> Array:
    """
    Turn an outline about the pole that it rocks about; an angle that is not known leaves nothing to draw.

    Parameters
    ----------
    outline : ndarray, shape (n, 2)
        x and z, m.
    angle : float
        θ, rad, positive when the top moves to +x: about the pole at +x.
    poles : (float, float)
        x of the poles for θ < 0 and θ > 0, m.

    Returns
    -------
    turned : ndarray, shape (n, 2)
    """
    pole = np.array([poles[1] if angle > 0 else poles[0], 0.0])
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.asarray((outline - pole) @ np.array([[cosine, -sine], [sine, cosine]]) + pole)


def _outline(body: Body) -> Array:
    base, top = (size / 2 for size in body.width)
    return np.array([(-base, 0.0), (base, 0.0), (top, body.height), (-top, body.height)])


def _at(curve: Curve, times: Array) -> Array:
    known = np.isfinite(curve.values)
    if not known.any():
        return np.zeros_like(times)
    # Past its end a history keeps its last value: an overturned block stays where it fell.
    return np.interp(times, curve.time[known], curve.values[known])


def _label(name: str) -> str:
    return name if name == "measured" else f"{name} model"


def animation(test: Test, specimen: Specimen, stored: Stored, block: Block) -> Movie | None:
    """Draw the block of a test as it rocks, measured and by each model; None without an angle."""
    angles: dict[str, Curve] = {}
    histories = [("measured", "rocking", None), *((model, "predict", model) for model in stored.models("predict"))]
    for name, stage, model in histories:
        if stored.has(stage, "rocking_angle", model):
            times, values = (stored.array(stage, each, model) for each in ("elapsed", "rocking_angle"))
            angles[name] = Curve(times, true_angle(stored, values) if stage == "rocking" else values)
    if not angles:
        return None
    base, how = base_displacement(stored)
    title = f"{test.id}: the rocking block"
    said = "measured and predicted" if len(angles) > 1 else next(iter(angles))
    return rocking_block(angles, body_of(specimen, block), base, title=title, description=f"{said}; base: {how}.")
