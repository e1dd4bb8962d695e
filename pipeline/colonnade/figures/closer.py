"""A closer look at rocking: its phase portrait, and the steady state of a sine or the time about the largest angle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import ANGLE_LABEL, LARGEST_RATIO, scale_symmetric
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import BOTTOM, TOP, add_panel, legend_above, margins
from colonnade.figures.stored.record import measured_ratio, predicted_ratios
from colonnade.figures.style import LIMIT, MEASURED, SOFT, LineStyle, is_narrow, model_style, styled, width
from colonnade.store.records.stored import Stored

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
    axes.set(xlabel=ANGLE_LABEL, ylabel="θ′ / (p α)")


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
    axes.set(xlabel=enlarged.label, ylabel=ANGLE_LABEL)
    if enlarged.remark:
        axes.text(
            0.995, 1.01, enlarged.remark, transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color=SOFT
        )


def _largest(values: Array, most: float) -> float:
    finite = np.abs(values[np.isfinite(values)])
    return min(float(finite.max(initial=0.0)) or 1.0, most)


POINTS = 900
"""Samples of a curve in the portrait."""

CYCLES = 6
"""Last responses of a steady state that are drawn on each other."""

AROUND = 2.5
"""Time before and after the largest angle that is enlarged, over 2π/p."""


def picture(test: Test, record: TestSummary, stored: Stored, block: Block) -> Picture | None:
    """Draw a test that rocked more closely; None if nothing rocked."""
    measured = measured_ratio(stored, block)
    predicted = predicted_ratios(stored, block)
    if record.outcome == "no-rocking" or (measured is None and not predicted):
        return None
    enlarged, stretch = _steady(record, stored, measured, predicted), _steady_stretch(record, stored)
    if enlarged is None:
        stretch = _about_peak(record, measured, block)
        enlarged = None if stretch is None else _in_time(record, stretch, measured, predicted)
    phases = {
        name: _phase(curve, block, stretch) for name, curve in {"": measured, **predicted}.items() if curve is not None
    }
    phases = {name: phase for name, phase in phases.items() if phase.ratio.size > 2}
    if not phases:
        return None
    return Picture(
        closer_look(phases.pop("", None), phases, separatrix(block), enlarged),
        f"closer-{test.id}",
        f"{test.id}: phase portrait" + ("" if enlarged is None else f", and the rocking angle over {enlarged.label}"),
        "Angular velocity over p α against θ/α, measured and by model, with the separatrix of the free motion.",
        "" if enlarged is None else f"Right: the rocking angle, {enlarged.remark}.",
    )


def separatrix(block: Block) -> Phase:
    """
    Return the upper branch of the free motion that just reaches the critical angle.

    Its energy is that of the block standing on its edge: θ'² = 2 p² (1 − cos(α − |θ|)), with the angle of each side.
    """
    ratio = np.linspace(-1.0, 1.0, 81)
    critical = block.critical_angle_at(ratio)
    return Phase(ratio, np.sqrt(2 * (1 - np.cos(critical * (1 - np.abs(ratio))))) / critical)


def _phase(curve: Curve, block: Block, stretch: tuple[float, float] | None) -> Phase:
    """Return angle and angular velocity over p and α within a stretch of time, thinned."""
    first, last = stretch or (-np.inf, np.inf)
    known = np.flatnonzero(np.isfinite(curve.values) & (curve.time >= first) & (curve.time <= last))
    if known.size < 3:
        return Phase(np.empty(0), np.empty(0))
    inside = slice(int(known[0]), int(known[-1]) + 1)
    time, ratio = curve.time[inside], curve.values[inside]
    step = max(time.size // POINTS, 1)
    return Phase(ratio[::step], (np.gradient(ratio, time) / block.p)[::step])


def _steady_stretch(record: TestSummary, stored: Stored) -> tuple[float, float] | None:
    """Return the last periods of the steady part of a sine, s."""
    frequency, start, stop = (
        stored.value("compare", name) for name in ("forcing_frequency", "steady_start", "steady_stop")
    )
    if record.outcome == "overturned" or not np.isfinite((frequency, start, stop)).all():
        return None
    order = _order(record)
    periods = min(order * CYCLES, int((stop - start) * frequency) // order * order)
    return (stop - periods / frequency, stop) if periods >= order else None


def _order(record: TestSummary) -> int:
    return record.order if isinstance(record.order, int) else 1


def _steady(
    record: TestSummary, stored: Stored, measured: Curve | None, predicted: Mapping[str, Curve]
) -> Enlarged | None:
    """Return the last responses of the steady part of a sine on each other, over the phase of the base."""
    stretch = _steady_stretch(record, stored)
    if stretch is None:
        return None
    (first, stop), order, frequency = stretch, _order(record), stored.value("compare", "forcing_frequency")
    zero = _rising(
        stored.array("rocking", "elapsed"), stored.array("rocking", "base_acceleration"), frequency, first, stop
    )

    def cycles(curve: Curve) -> list[Curve]:
        phase = (curve.time - zero) * frequency
        inside = (curve.time >= first) & (curve.time <= stop)
        turn = np.floor(phase / order)
        return [
            Curve(phase[chosen] - order * each, curve.values[chosen])
            for each in np.unique(turn[inside])
            if (chosen := inside & (turn == each)).any()
        ]

    return Enlarged(
        "phase of the base (periods)",
        [] if measured is None else cycles(measured),
        {model: cycles(curve) for model, curve in predicted.items()},
        f"last {round((stop - first) * frequency)} periods of the steady part",
    )


def _rising(time: Array, base: Array, frequency: float, first: float, stop: float) -> float:
    """Return a time (s) at which the sine in the base acceleration rises through zero."""
    inside = (time >= first) & (time <= stop) & np.isfinite(base)
    amplitude = np.mean(base[inside] * np.exp(-2j * np.pi * frequency * (time[inside] - first)))
    return float(first - (np.angle(amplitude) + np.pi / 2) / (2 * np.pi * frequency))


def _about_peak(record: TestSummary, measured: Curve | None, block: Block) -> tuple[float, float] | None:
    """Return the time about the largest measured angle, s."""
    if record.peak_time is None or measured is None:
        return None
    reach = AROUND * 2 * np.pi / block.p
    return record.peak_time - reach, record.peak_time + reach


def _in_time(
    record: TestSummary, stretch: tuple[float, float], measured: Curve | None, predicted: Mapping[str, Curve]
) -> Enlarged:
    def near(curve: Curve) -> list[Curve]:
        inside = (curve.time >= stretch[0]) & (curve.time <= stretch[1])
        return [Curve(curve.time[inside], curve.values[inside])]

    name = "overturning" if record.outcome == "overturned" else "the largest angle"
    curves = {model: near(curve) for model, curve in predicted.items()}
    return Enlarged("time (s)", [] if measured is None else near(measured), curves, f"about {name}")
