"""The measured map: each sine test by its outcome over Ω and A, with both boundaries bracketed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from colonnade.figures.files.output import link_to
from colonnade.figures.panels.layout import legend_outside, note, plain_decades
from colonnade.figures.style import FIT, LIMIT, MEASURED, SOFT, LineStyle, blank_figure, is_narrow, styled
from colonnade.identification.response.boundaries import Boundaries, Bracket, MapPoint, bracket_boundaries

MARKERS: dict[str, dict[str, Any]] = {
    "no-rocking": {"marker": "o", "facecolors": "white", "edgecolors": MEASURED["color"]},
    "rocking": {"marker": "D", "facecolors": "#0b6bb0", "edgecolors": "#0b6bb0"},
    "overturned": {"marker": "X", "facecolors": "#d1490f", "edgecolors": "#d1490f"},
}
"""Told apart by shape on a grey print, and by colour to colour-blind readers."""

NAMES = {"no-rocking": "no rocking", "rocking": "rocking", "overturned": "overturned"}

BOUNDARIES: tuple[tuple[str, str, LineStyle], ...] = (
    ("rocking", "rocking begins", {"color": SOFT, "linestyle": (0, (4.0, 2.0)), "linewidth": 0.9}),
    ("overturning", "overturning begins", {**FIT, "linewidth": 0.9}),
)

LOGARITHMIC = 6.0
"""Amplitudes that span more than this factor are drawn on a logarithmic axis."""


@styled()
def measured_map(points: Sequence[MapPoint], *, linked: bool = False) -> Figure:
    """
    Draw the sine tests of a specimen by outcome, each as a link to its page if `linked`.

    A bar spans the tests between which a boundary, met going up in A, lies; a line joins the middles of the bars of
    neighbouring frequencies. A sub-harmonic response is labelled by its order.
    """
    figure = blank_figure(3.6)
    axes = figure.subplots()
    _draw_scale(axes, points)
    for name, label, style in BOUNDARIES:
        _draw_boundary(axes, bracket_boundaries(points), name, label, style)
    draw_points(axes, points, linked=linked)
    legend_outside(figure, [axes])
    return figure


def draw_points(axes: Axes, points: Sequence[MapPoint], *, prefix: str = "", linked: bool = False) -> None:
    """
    Draw sine tests by outcome, those with a sub-harmonic response with its order.

    `prefix` begins their labels; if `linked`, each leads to its test.
    """
    for outcome, look in MARKERS.items():
        chosen = [point for point in points if point.outcome == outcome]
        if chosen:
            places = axes.scatter(
                [point.frequency_ratio for point in chosen],
                [point.amplitude_ratio for point in chosen],
                s=12 if is_narrow() else 26,
                linewidths=0.9,
                label=f"{prefix}{NAMES[outcome]}",
                zorder=4,
                **look,
            )
            if linked:
                places.set_urls([link_to(point.test) for point in chosen])
    for point in points:
        if isinstance(point.order, int) and point.order > 1:
            at, clear = (point.frequency_ratio, point.amplitude_ratio), [withStroke(linewidth=2.5, foreground="white")]
            note(axes, f"1/{point.order}", at, (6, 0), va="center", fontsize=7, path_effects=clear)


def _draw_scale(axes: Axes, points: Sequence[MapPoint]) -> None:
    amplitudes = np.array([point.amplitude_ratio for point in points])
    frequencies = np.array([point.frequency_ratio for point in points])
    axes.axhline(1.0, **LIMIT)
    axes.set_xlim(0.0, 1.08 * float(frequencies.max()))
    low, high = min(float(amplitudes.min()), 1.0), max(float(amplitudes.max()), 1.0)
    if low > 0 and high / low > LOGARITHMIC:
        label_logarithmic(axes)
        axes.set_ylim(low / 1.15, high * 1.15)
    else:
        axes.set_ylim(0.0, 1.1 * high)
    name_axes(axes)


def label_logarithmic(axes: Axes) -> None:
    """Make the axis of A logarithmic, with plain numbers at several of each decade."""
    axes.set_yscale("log")
    plain_decades(axes.yaxis, subs=(1.0, 1.5, 2.0, 3.0, 5.0, 7.0))


def name_axes(axes: Axes) -> None:
    """Label the axes of a map."""
    axes.set(xlabel="Ω = ω / p", ylabel="A = a / (g tan α)")


def _draw_boundary(axes: Axes, boundaries: Sequence[Boundaries], name: str, label: str, style: LineStyle) -> None:
    brackets: list[tuple[float, Bracket]] = [(each.frequency_ratio, getattr(each, name)) for each in boundaries]
    found = [(ratio, bracket) for ratio, bracket in brackets if bracket.middle is not None]
    if not found:
        return
    # Where a frequency has no bracket the line breaks: nothing is known there.
    middles = [np.nan if bracket.middle is None else bracket.middle for _, bracket in brackets]
    ratios = [ratio for ratio, _ in brackets]
    axes.plot(ratios, middles, label=label, zorder=2, **style)
    axes.vlines(
        [ratio for ratio, _ in found],
        [cast(float, bracket.below) for _, bracket in found],
        [cast(float, bracket.above) for _, bracket in found],
        color=style["color"],
        linewidth=4.0,
        alpha=0.45,
        zorder=1,
        gid=f"{label}, between",
    )
