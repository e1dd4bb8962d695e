"""A closer look at rocking: its phase portrait, and the steady state of a sine or the time about the largest angle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import ANGLE_LABEL, LARGEST_RATIO, largest_of, scale_symmetric
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import BOTTOM, TOP, add_row, legend_above, note
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import LIMIT, SOFT, LineStyle, is_narrow, name_of, style_of, styled, width
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

    `curves` are θ/α as "measured" and by model over what `label` says, cycles on each other with gaps between them:
    one path, however many they are. `remark` is written into the panel. `stretch` is the time (s), from and to.
    """

    label: str
    curves: Mapping[str, Curve]
    remark: str
    stretch: tuple[float, float]


@styled()
def closer_look(phases: Mapping[str, Phase], separatrix: Phase, enlarged: Enlarged | None) -> Figure:
    """
    Draw the phase portrait, "measured" and by model, and, if there is one, an enlarged part of the motion.

    `separatrix` is the upper branch of the free motion that just reaches the critical angle, from θ = −α to α.
    """
    panels = 1 if enlarged is None else 2
    rows = panels if is_narrow() else 1
    figure = Figure(figsize=(width(), TOP + rows * (HEIGHT + BOTTOM)))
    portrait, *others = add_row(figure, panels, TOP, HEIGHT, apart=APART, below=BOTTOM)
    _draw_portrait(portrait, phases, separatrix)
    if enlarged is not None:
        _draw_enlarged(others[0], enlarged)
    legend_above(figure, [portrait])
    return figure


def _draw_portrait(axes: Axes, phases: Mapping[str, Phase], separatrix: Phase) -> None:
    largest = min(largest_of(phase.ratio for phase in phases.values()) or 1.0, LARGEST_RATIO)
    for who, phase in phases.items():
        shown = np.clip(phase.ratio, -2 * largest, 2 * largest)
        axes.plot(shown, phase.velocity, label=name_of(who), **style_of(who, THINNESS))
    for sign in (1.0, -1.0):
        name = "separatrix" if sign > 0 else None
        axes.plot(separatrix.ratio, sign * separatrix.velocity, label=name, **SEPARATRIX)
    axes.set_xlim(-1.12 * largest, 1.12 * largest)
    axes.xaxis.set_major_locator(MaxNLocator(5))  # the panel is narrow, and its numbers may be long
    scale_symmetric(axes, largest_of(phase.velocity for phase in phases.values()) or 1.0)
    axes.set(xlabel=ANGLE_LABEL, ylabel="θ′ / (p α)")


def _draw_enlarged(axes: Axes, enlarged: Enlarged) -> None:
    for who, curve in enlarged.curves.items():
        axes.plot(*curve, **style_of(who, THINNESS))
    scale_symmetric(axes, min(largest_of(each.values for each in enlarged.curves.values()) or 1.0, LARGEST_RATIO))
    axes.set(xlabel=enlarged.label, ylabel=ANGLE_LABEL)
    note(axes, enlarged.remark, (0.995, 1.01), xycoords="axes fraction", ha="right", va="bottom", color=SOFT)


POINTS = 900
"""Samples of a curve in the portrait."""

CYCLES = 6
"""Last responses of a steady state that are drawn on each other."""

AROUND = 2.5
"""Time before and after the largest angle that is enlarged, over 2π/p."""


def picture(one: OfTest) -> Picture | None:
    """
    Phase portrait, and of a sine the steady state.

    Left: phase portrait of the same stretch; on the dotted line, the separatrix, the free motion just reaches the
    critical angle. The angular velocity is over pα.
    """
    record, block, curves = one.record, one.block, one.ratios()
    if record.outcome == "no-rocking" or not curves:
        return None
    enlarged = _steady(record, one.stored, curves) or _about_peak(record, curves, block)
    first, last = (-np.inf, np.inf) if enlarged is None else enlarged.stretch
    phases = {who: _phase(curve.within(first, last), block) for who, curve in curves.items()}
    phases = {who: phase for who, phase in phases.items() if phase.ratio.size > 2}
    if not phases:
        return None
    return Picture(
        closer_look(phases, separatrix(block), enlarged),
        f"closer-{one.test.id}",
        f"{one.test.id}: phase portrait"
        + ("" if enlarged is None else f", and the rocking angle over {enlarged.label}"),
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


def _phase(curve: Curve, block: Block) -> Phase:
    """Return angle and angular velocity over p and α, thinned."""
    known = np.flatnonzero(np.isfinite(curve.values))
    if known.size < 3:
        return Phase(np.empty(0), np.empty(0))
    inside = slice(int(known[0]), int(known[-1]) + 1)
    time, ratio = curve.time[inside], curve.values[inside]
    step = max(time.size // POINTS, 1)
    return Phase(ratio[::step], (np.gradient(ratio, time) / block.p)[::step])


def _steady(record: TestSummary, stored: Stored, curves: Mapping[str, Curve]) -> Enlarged | None:
    """Return the last responses of the steady part of a sine on each other, over the phase of the base."""
    frequency, start, stop = (
        stored.value("compare", name) for name in ("forcing_frequency", "steady_start", "steady_stop")
    )
    if record.outcome == "overturned" or not np.isfinite((frequency, start, stop)).all():
        return None
    order = record.order if isinstance(record.order, int) else 1
    periods = min(order * CYCLES, int((stop - start) * frequency) // order * order)
    if periods < order:
        return None
    first = stop - periods / frequency
    base = Curve(*(stored.array("rocking", name) for name in ("elapsed", "base_acceleration"))).within(first, stop)
    zero = _rising(base, frequency)

    def cycles(curve: Curve) -> Curve:
        phase = (curve.time - zero) * frequency
        turn = np.floor(phase / order)
        begins = np.flatnonzero(np.diff(turn)) + 1
        return Curve(np.insert(phase - order * turn, begins, np.nan), np.insert(curve.values, begins, np.nan))

    steady = {who: cycles(curve.within(first, stop)) for who, curve in curves.items()}
    remark = f"last {periods} periods of the steady part"
    return Enlarged("phase of the base (periods)", steady, remark, (first, stop))


def _rising(base: Curve, frequency: float) -> float:
    """Return a time (s) at which the sine in a base acceleration rises through zero."""
    known = np.isfinite(base.values)
    turns = np.exp(-2j * np.pi * frequency * (base.time[known] - base.time[0]))
    angle = np.angle(np.mean(base.values[known] * turns))
    return float(base.time[0] - (angle + np.pi / 2) / (2 * np.pi * frequency))


def _about_peak(record: TestSummary, curves: Mapping[str, Curve], block: Block) -> Enlarged | None:
    """Return the motion about the largest measured angle."""
    if record.peak_time is None or "measured" not in curves:
        return None
    reach = AROUND * 2 * np.pi / block.p
    stretch = record.peak_time - reach, record.peak_time + reach
    near = {who: curve.within(*stretch) for who, curve in curves.items()}
    name = "overturning" if record.outcome == "overturned" else "the largest angle"
    return Enlarged("time (s)", near, f"about {name}", stretch)
