"""A closer look at rocking: its phase portrait, and the steady state of a sine or the time about the largest angle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.figures.histories import ANGLE_LABEL, LARGEST_RATIO, scale_symmetric
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import BOTTOM, TOP, legend_above, margins
from colonnade.figures.panels.lean import add_panel
from colonnade.figures.style import LIMIT, MEASURED, SOFT, LineStyle, is_narrow, model_style, styled, width

HEIGHT, APART = 2.5, 0.75
"""Of both panels, and the room between them; inches."""

SEPARATRIX: LineStyle = {**LIMIT, "color": SOFT}

THINNESS = 0.7
"""Of the models' lines beside their usual width."""


class Phase(NamedTuple):
    """θ/α and θ'/(p α) of one motion, both shape (n,)."""

    ratio: Array
    velocity: Array


class Enlarged(NamedTuple):
    """
    A part of the motion, enlarged.

    `measured` and `predicted` are stretches (cycles on each other, or one stretch of time) of θ/α over what `label`
    says; `remark` is written into the panel.
    """

    label: str
    measured: Sequence[Curve]
    predicted: Mapping[str, Sequence[Curve]]
    remark: str = ""


@styled()
def closer_look(
    measured: Phase | None, predicted: Mapping[str, Phase], separatrix: Phase, enlarged: Enlarged | None
) -> Figure:
    """
    Draw the phase portrait and, if there is one, an enlarged part of the motion.

    Parameters
    ----------
    measured : Phase or None
    predicted : mapping of str to Phase
        By model.
    separatrix : Phase
        Upper branch of the free motion that just reaches the critical angle, from θ = −α to α.
    enlarged : Enlarged or None

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no motion.
    """
    phases = [phase for phase in (measured, *predicted.values()) if phase is not None]
    if not phases:
        raise ValueError("no motion was given; a measured or a predicted one was expected")
    left, right = margins()
    columns = 1 if enlarged is None else 2
    beside = 1 if is_narrow() else columns
    panel = (width() - left - right - APART * (beside - 1)) / beside
    figure = Figure(figsize=(width(), TOP + columns // beside * (HEIGHT + BOTTOM)))
    portrait, *others = (
        add_panel(figure, left + place * (panel + APART), TOP + row * (HEIGHT + BOTTOM), panel, HEIGHT)
        for row, place in (divmod(column, beside) for column in range(columns))
    )
    _draw_portrait(portrait, measured, predicted, separatrix, phases)
    if enlarged is not None:
        _draw_enlarged(others[0], enlarged)
    legend_above(figure, [portrait])
    return figure


def _draw_portrait(
    axes: Axes, measured: Phase | None, predicted: Mapping[str, Phase], separatrix: Phase, phases: Sequence[Phase]
) -> None:
    largest = _largest(np.concatenate([phase.ratio for phase in phases]), LARGEST_RATIO)
    fastest = _largest(np.concatenate([phase.velocity for phase in phases]), np.inf)
    lines: list[tuple[Phase | None, str, LineStyle]] = [(measured, "measured", MEASURED)]
    lines += [(phase, f"{model} model", model_style(model, THINNESS)) for model, phase in predicted.items()]
    for phase, label, style in lines:
        if phase is not None:
            axes.plot(np.clip(phase.ratio, -2 * largest, 2 * largest), phase.velocity, label=label, **style)
    for sign in (1.0, -1.0):
        name = "separatrix" if sign > 0 else None
        axes.plot(separatrix.ratio, sign * separatrix.velocity, label=name, **SEPARATRIX)
    axes.set_xlim(-1.12 * largest, 1.12 * largest)
    axes.xaxis.set_major_locator(MaxNLocator(5))  # the panel is narrow, and its numbers may be long
    scale_symmetric(axes, fastest)
    axes.set_xlabel(ANGLE_LABEL)
    axes.set_ylabel("θ′ / (p α)")


def _draw_enlarged(axes: Axes, enlarged: Enlarged) -> None:
    drawn: list[tuple[Sequence[Curve], LineStyle]] = [(enlarged.measured, MEASURED)]
    drawn += [(curves, model_style(model, THINNESS)) for model, curves in enlarged.predicted.items()]
    every = [curve.values for curves, _ in drawn for curve in curves]
    for curves, style in drawn:
        # Cycles on each other are one line with gaps: one path, however many they are.
        gap = np.array([np.nan])
        if curves:
            axes.plot(
                np.concatenate([part for curve in curves for part in (curve.time, gap)]),
                np.concatenate([part for curve in curves for part in (curve.values, gap)]),
                **style,
            )
    largest = _largest(np.concatenate(every), LARGEST_RATIO) if every else 1.0
    scale_symmetric(axes, largest)
    axes.set_xlabel(enlarged.label)
    axes.set_ylabel(ANGLE_LABEL)
    if enlarged.remark:
        axes.text(
            0.995, 1.01, enlarged.remark, transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color=SOFT
        )


def _largest(values: Array, most: float) -> float:
    finite = np.abs(values[np.isfinite(values)])
    return min(float(finite.max(initial=0.0)) or 1.0, most)
