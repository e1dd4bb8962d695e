"""Draw the figures of docs/explanation/: `python reports/explanation_figures.py [FOLDER]`."""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import cos, sin
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Polygon

import colonnade
from colonnade import figures
from colonnade.figures.style import BASE, FAINT, INK, LIMIT, MEASURED, SOFT, blank_figure, model_style, styled
from faults.sound import PRISM, earthquake

DOCUMENTS = Path(__file__).resolve().parents[1] / "docs" / "explanation"

ANGLE, HALF_WIDTH, HALF_HEIGHT = 0.16, 0.42, 1.15
"""rad, and lengths of the sketch."""

RESTITUTIONS = (0.9, 0.976)
FREQUENCY_RATIOS = np.linspace(1.0, 6.0, 41)
STRENGTH = 0.55
CHANGES = (0.0, 1e-9, 1e-6, 1e-3)
"""Relative changes of the base motion."""


@styled()
def sketch() -> Figure:
    """Draw the block at rest and turned to θ > 0, with its names."""
    figure = blank_figure(3.0)
    axes = figure.subplots()
    corners = np.array([[-1, 0], [1, 0], [1, 2], [-1, 2]]) * (HALF_WIDTH, HALF_HEIGHT)
    pole = np.array([HALF_WIDTH, 0.0])
    turn = np.array([[cos(ANGLE), sin(ANGLE)], [-sin(ANGLE), cos(ANGLE)]])

    def turned(points: np.ndarray) -> np.ndarray:
        return (points - pole) @ turn.T + pole

    axes.add_patch(Polygon(corners, closed=True, fill=False, edgecolor=FAINT, linestyle=(0, (4, 3))))
    axes.add_patch(Polygon(turned(corners), closed=True, fill=False, edgecolor=INK, linewidth=1.3))
    centre = turned(np.array([[0.0, HALF_HEIGHT]]))[0]
    axes.plot(*centre, "o", color=INK, markersize=4)
    axes.plot(*zip(pole, centre, strict=True), color=model_style("linear")["color"], linewidth=1.1)
    axes.plot([pole[0], pole[0]], [0.0, 1.55], **LIMIT)
    axes.plot([-1.3, 1.5], [0.0, 0.0], color=SOFT, linewidth=1.2)
    axes.annotate("", (1.45, -0.25), (0.95, -0.25), arrowprops={"arrowstyle": "->", "color": SOFT})
    axes.text(0.9, -0.25, "acceleration a of the base", color=SOFT, ha="right", va="center")
    axes.text(pole[0] + 0.08, 0.06, "pole if θ > 0")
    axes.text(-HALF_WIDTH - 0.08, 0.06, "pole if θ < 0", color=SOFT, ha="right")
    axes.text(centre[0] - 0.06, centre[1], "centre\nof mass", va="center", ha="right", fontsize=7)
    axes.text(*(0.5 * (pole + centre) + (-0.12, -0.05)), "R", color=model_style("linear")["color"])
    axes.add_patch(Arc(pole, 2.7, 2.7, theta1=90, theta2=90 + np.degrees(_lean()), color=INK))
    axes.text(pole[0] - 0.17, 1.42, "α − θ")
    top = turned(np.array([[HALF_WIDTH, 2 * HALF_HEIGHT]]))[0]
    axes.annotate("", top, (HALF_WIDTH, 2 * HALF_HEIGHT), arrowprops={"arrowstyle": "->", "color": INK})
    axes.text(HALF_WIDTH + 0.08, 2 * HALF_HEIGHT + 0.05, "θ")
    axes.set_aspect("equal")
    axes.set_xlim(-1.4, 1.6)
    axes.set_ylim(-0.45, 2.55)
    axes.axis("off")
    return figure


def _lean() -> float:
    return float(np.arctan2(HALF_WIDTH, HALF_HEIGHT)) - ANGLE


@styled()
def restitution() -> Figure:
    """Draw e over where the impulse acts."""
    figure = blank_figure(2.4)
    axes = figure.subplots()
    share = np.linspace(0.0, 1.0, 101)
    for ratio, dash in ((3.0, (0, (5, 2))), (5.3, "solid"), (9.0, (0, (1, 1.5)))):
        block = colonnade.Block.prism(width=1.0 / ratio, depth=0.2, height=1.0, mass=100.0)
        height = block.pole_distance * cos(block.critical_angle)
        half = block.governing.half_width
        about_centre = block.inertia - block.mass * block.pole_distance**2
        loss = block.mass * half * share * half
        kept = about_centre + block.mass * height**2
        axes.plot(share, (kept - loss) / (kept + loss), color=INK, linestyle=dash, label=f"height / width {ratio:g}")
    axes.set_xlabel("where the impulse acts, c / b: 0 the middle, 1 the edge")
    axes.set_ylabel("e")
    axes.legend()
    return figure


@styled()
def limits() -> Figure:
    """Draw both limits of overturning by one sine, for two e."""
    figure = blank_figure(2.9)
    axes = figure.subplots()
    for e, dash in zip(RESTITUTIONS, ("solid", (0, (4, 2))), strict=True):
        spectrum = colonnade.overturning_spectrum(
            PRISM, "sine", frequency_ratio=FREQUENCY_RATIOS, restitution=e, largest=10.0
        )
        gap = spectrum.upper > spectrum.lower
        axes.plot(FREQUENCY_RATIOS, spectrum.lower, color=INK, linestyle=dash, label=f"lower limit, e = {e:g}")
        upper = np.where(gap, spectrum.upper, np.nan)
        axes.plot(FREQUENCY_RATIOS, upper, color="#d1490f", linestyle=dash, label=f"upper limit, e = {e:g}")
        if e == RESTITUTIONS[0]:
            axes.fill_between(FREQUENCY_RATIOS, spectrum.lower, upper, color=FAINT, alpha=0.15, linewidth=0)
    _named(axes, ((5.0, 0.6, "stands"), (4.1, 3.3, "overturns after an impact, or stands")))
    _named(axes, ((3.3, 6.3, "overturns without an impact"),))
    axes.set_xlabel("Ω = ω / p")
    axes.set_ylabel("A = a / (g tan α)")
    axes.set_ylim(0.0, 10.0)
    axes.legend(loc="upper left")
    return figure


def _named(axes: Axes, places: tuple[tuple[float, float, str], ...]) -> None:
    for x, y, words in places:
        axes.text(x, y, words, color=SOFT, ha="center", fontsize=7.5)


@styled()
def parting() -> Figure:
    """Draw how histories on nearly the same motion part."""
    figure = blank_figure(3.2)
    upper, lower = figure.subplots(2, 1, sharex=True)
    motion = earthquake(1)
    dt = 0.25 * motion.dt
    runs = [
        colonnade.rock(PRISM, colonnade.Motion(STRENGTH * (1 + change) * motion.acceleration, dt), restitution=0.976)
        for change in CHANGES
    ]
    alpha = PRISM.critical_angle
    upper.plot(runs[0].time, runs[0].angle / alpha, **MEASURED, label="computed")
    upper.plot(runs[-1].time, runs[-1].angle / alpha, **model_style("linear"), label="base motion stronger by 0.1 %")
    upper.set_ylabel("θ / α")
    upper.set_ylim(-1.6, 1.6)
    upper.set_xlim(0.0, 8.0)
    upper.legend(loc="upper right")
    for run, change, dash in zip(runs[1:], CHANGES[1:], ("solid", (0, (4, 2)), (0, (1, 1.5))), strict=True):
        apart = np.minimum(np.maximum.accumulate(np.abs(run.angle - runs[0].angle) / alpha), 1.0)
        lower.plot(run.time, apart, color=INK, linestyle=dash, linewidth=0.8, label=f"changed by {change:g}")
    begin = float(runs[0].time[np.argmax(np.abs(runs[0].angle) > 0)])
    growth = np.array([begin, begin + np.log(1e9) / PRISM.p])
    lower.plot(growth, [1e-11, 1e-2], **(BASE | {"linestyle": "dashed"}), label="exp(p t)")
    lower.set_yscale("log")
    lower.set_ylim(1e-12, 10.0)
    lower.set_yticks([1e-12, 1e-9, 1e-6, 1e-3, 1.0], ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "1"])
    lower.minorticks_off()
    lower.set_ylabel("largest difference, of α")
    lower.set_xlabel("time, s")
    figure.legend(*lower.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


class Shown(NamedTuple):
    """A figure: who draws it, its title and what is seen in it."""

    draw: Callable[[], Figure]
    title: str
    seen: str


FIGURES = {
    "block": Shown(
        sketch,
        "A rocking block and its names",
        "The block turned by θ to the right about its right edge; the line R from there to the centre of mass leans by "
        "α − θ from the vertical.",
    ),
    "impulse": Shown(
        restitution,
        "Restitution over the place of the impulse",
        "e falls from 1, if the impulse acts in the middle, to the rigid body's value at the edge.",
    ),
    "one-sine": Shown(
        limits,
        "Limits of overturning by one sine",
        "The lower limit depends on e; above it a band follows in which the block may stand; the upper limit does not "
        "depend on e.",
    ),
    "parting": Shown(
        parting,
        "How histories part",
        "On the motion as it is the block overturns, on one that is stronger by a thousandth it does not; smaller "
        "changes grow alike.",
    ),
}


def rebuild(folder: Path) -> None:
    """Write every figure."""
    for name, shown in FIGURES.items():
        text = figures.to_svg(shown.draw(), identity=name, title=shown.title, description=shown.seen)
        (folder / f"{name}.svg").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    rebuild(Path(sys.argv[1]) if len(sys.argv) > 1 else DOCUMENTS)
