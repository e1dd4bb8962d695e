"""The block itself as it rocks: measured and by each model, on the motion of its base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import ceil

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from colonnade.arrays import Array
from colonnade.figures.drawing.body import STEEL
from colonnade.figures.drawing.described import body_of
from colonnade.figures.drawing.view import Rocking, Spot
from colonnade.figures.files.output import Movie
from colonnade.figures.histories import time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import INK, SOFT, name_of, style_of, styled

RATE, MOST_FRAMES = 25.0, 250
"""Frames a second, and of a movie: a longer test is played faster."""

SIZE = (3.6, 4.0)
"""Of the picture, inches."""


@styled()
def rocking_block(
    angles: Mapping[str, Curve], corners: Sequence[Spot], poles: Spot, base: Curve | None = None, *, figure: Figure
) -> Movie:
    """
    Draw the rocking block, one outline for each history: "measured", and by model.

    `angles` are θ (rad) over time (s), `corners` x and z (m) of the block at rest, `poles` x of those that it rocks
    about with θ < 0 and θ > 0. A base whose displacement (m) is not known is drawn at rest. The movie is drawn into
    the empty `figure`.
    """
    times = _times(*time_limits(angles.values()))
    shift = np.zeros_like(times) if base is None else _at(base, times) - _at(base, times[:1])
    aside = np.column_stack((shift, np.zeros_like(shift)))[:, None]
    outlines = {who: turn(np.array(corners), _at(curve, times), poles) + aside for who, curve in angles.items()}
    table = shift[:, None] + 0.5 * max(high for _, high in corners) * np.array([-1.0, 1.0])
    movie = _movie(figure, outlines, times, table)
    for who, block in zip(angles, movie.figure.axes[0].patches, strict=True):
        style = style_of(who)
        block.set(edgecolor=style["color"], linestyle=style["linestyle"], label=name_of(who))
        block.set_facecolor(STEEL if who == "measured" else "none")
    movie.figure.legend(loc="upper left", ncols=2, fontsize=7, borderaxespad=0.3, columnspacing=1.0)
    return movie


@styled()
def moving_bodies(outlines: Mapping[str, Array], time: Array, figure: Figure) -> Movie:
    """
    Draw several bodies as they move, seen from the table, into an empty figure.

    `outlines` are x and z (m) of the corners of each, shape (n, k, 2), at the times `time` (s).
    """
    times = _times(float(time[0]), float(time[-1]))
    samples = np.clip(np.searchsorted(time, times), 0, time.size - 1)
    table = np.tile([-1e3, 1e3], (times.size, 1))
    return _movie(figure, {name: outline[samples] for name, outline in outlines.items()}, times, table)


def _times(first: float, last: float) -> Array:
    """Return the times of the frames; a long test has no more than others and is shown faster."""
    return np.linspace(first, last, min(max(ceil((last - first) * RATE), 2), MOST_FRAMES))


def _movie(figure: Figure, outlines: Mapping[str, Array], times: Array, table: Array) -> Movie:
    """Show outlines on the ends of a table (x, m), a frame each; the picture says how much faster it is."""
    corners = np.concatenate([outline.reshape(-1, 2) for outline in outlines.values()])
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin, speed = 0.1 * (high - low).max(), (times[-1] - times[0]) * RATE / times.size
    axes = figure.add_axes((0.0, 0.0, 1.0, 0.86))
    axes.set_axis_off()
    axes.set_aspect("equal")
    axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(min(0.0, low[1]) - margin, high[1] + margin))
    (ground,) = axes.plot([], [], color=INK, linewidth=2.0)
    blocks = [Polygon(each[0], edgecolor=INK, facecolor=STEEL) for each in outlines.values()]
    for block in blocks:
        axes.add_patch(block)
    clock = axes.text(0.98, 0.02, "", transform=axes.transAxes, ha="right", fontsize=8, color=SOFT)

    def show(frame: int) -> None:
        for block, outline in zip(blocks, outlines.values(), strict=True):
            block.set_xy(outline[frame])
        ground.set_data(table[frame], [0.0, 0.0])
        clock.set_text(f"{times[frame]:.2f} s" + (f", {speed:.2g} × faster" if speed > 1.01 else ""))

    return Movie(figure, show, times.size, RATE)


def turn(outline: Array, angle: Array, poles: Sequence[float]) -> Array:
    """
    Turn an outline about the pole that it rocks about.

    Parameters
    ----------
    outline : ndarray, shape (k, 2)
        x and z, m.
    angle : ndarray, shape (n,)
        θ, rad, positive when the top moves to +x: about the pole at +x.
    poles : (float, float)
        x of the poles for θ < 0 and θ > 0, m.

    Returns
    -------
    turned : ndarray, shape (n, k, 2)
    """
    angle = angle[:, None]
    pole = np.where(angle > 0, poles[1], poles[0])
    across, up = outline[:, 0] - pole, outline[:, 1]
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.stack((pole + across * cosine + up * sine, up * cosine - across * sine), axis=-1)


def _at(curve: Curve, times: Array) -> Array:
    known = np.isfinite(curve.values)
    if not known.any():
        return np.zeros_like(times)
    # Past its end a history keeps its last value: an overturned block stays where it fell.
    return np.interp(times, curve.time[known], curve.values[known])


def animation(one: OfTest) -> Movie | None:
    """The rocking block, measured and by each model, as a GIF."""
    angles, stored, block = dict[str, Curve](), one.stored, one.block
    for name, (stage, model) in one.sources.items():
        if stored.has(stage, "rocking_angle", model):
            times, values = (stored.array(stage, each, model) for each in ("elapsed", "rocking_angle"))
            angles[name] = Curve(times, one.true_angle(values) if stage == "rocking" else values)
    if not angles:
        return None
    base, how = one.base_displacement()
    said = "measured and predicted" if len(angles) > 1 else next(iter(angles))
    corners, poles = body_of(one.specimen, block).outline(), Rocking.of(block).poles
    movie = rocking_block(angles, corners, poles, base, figure=Figure(figsize=SIZE))
    return replace(movie, title=f"{one.test.id}: the rocking block", description=f"{said}; base: {how}.")
