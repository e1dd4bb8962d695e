"""Estimates of e side by side, with their intervals: do independent ways of asking give one answer?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.figures.style import FIT, INK, LIMIT, MEASURED, SOFT, styled, width
from colonnade.units.text import interval

ROW, GROUP = 0.21, 0.26
"""Heights of an estimate's row and of a group's title, inches."""

MARGIN = 0.1
"""Below the last row, inches; the rigid-body value is written in a row of its own."""

LEFT, RIGHT, TOP, BOTTOM = 2.05, 1.6, 0.12, 0.46
"""Room for names, for values in figures, and for the axis; inches."""

SMALLEST_RANGE = 2e-3
"""No axis of e is narrower than this."""

BEYOND = 8.0
"""Median widths of an interval about the median estimate that the axis shows; what is beyond has an arrow."""


class EstimateRow(NamedTuple):
    """One estimator's e and interval, or (with NaN) the reason in few words; whether it is the recommended one."""

    name: str
    value: float
    low: float
    high: float
    recommended: bool = False
    remark: str = ""


class EstimateGroup(NamedTuple):
    """Estimates of one free vibration, or of all together."""

    title: str
    rows: Sequence[EstimateRow]


@styled()
def estimators_side_by_side(groups: Sequence[EstimateGroup], *, rigid: float | None = None) -> Figure:
    """
    Draw points with intervals, a row an estimate, groups below each other.

    Parameters
    ----------
    groups : sequence of EstimateGroup
    rigid : float, optional
        Rigid-body value: a line if the axis reaches it, else written at its edge.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no row.
    """
    count = sum(len(group.rows) for group in groups)
    if not count:
        raise ValueError("no estimate was given; at least one was expected")
    titles = sum(bool(group.title) for group in groups)
    body = count * ROW + titles * GROUP + (MARGIN if rigid is None else GROUP)
    height = TOP + body + BOTTOM
    figure = Figure(figsize=(width(), height))
    axes = figure.add_axes((LEFT / width(), BOTTOM / height, (width() - LEFT - RIGHT) / width(), body / height))
    low, high = _limits([row for group in groups for row in group.rows])
    axes.set(xlim=(low, high), ylim=(body, 0))
    axes.tick_params(axis="y", left=False, labelleft=False)
    axes.grid(visible=False, axis="y")
    place = 0.05
    for group in groups:
        if group.title:
            _write(axes, place + GROUP / 2, group.title, -LEFT + 0.1, weight="bold")
            place += GROUP
        for row in group.rows:
            _draw_row(axes, place + ROW / 2, row, group.title)
            place += ROW
    if not any(np.isfinite(row.value) for group in groups for row in group.rows):
        axes.set_xticks([])
    else:
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
        if rigid is not None:
            _draw_rigid(axes, rigid)
    axes.set_xlabel("coefficient of restitution e")
    return figure


def _draw_row(axes: Axes, place: float, row: EstimateRow, title: str) -> None:
    weight = "bold" if row.recommended else "normal"
    _write(axes, place, row.name, -LEFT + 0.15, colour=FIT["color"] if row.recommended else INK)
    if not np.isfinite(row.value):
        _write(axes, place, row.remark or "none", None, colour=SOFT)
        return
    colour = FIT["color"] if row.recommended else MEASURED["color"]
    size = 5.0 if row.recommended else 4.0
    axes.errorbar(
        [row.value],
        [place],
        xerr=np.maximum([[row.value - row.low], [row.high - row.value]], 0.0),
        fmt="D" if row.recommended else "o",
        color=colour,
        markersize=size,
        elinewidth=2.0 if row.recommended else 1.1,
        label=f"{title}, {row.name}" if title else row.name,
    )
    low, high = axes.get_xlim()
    if not low <= row.value <= high:
        edge, mark = (0.0, "<") if row.value < low else (1.0, ">")
        beside = axes.get_yaxis_transform()
        axes.plot([edge], [place], mark, color=colour, markersize=size, clip_on=False, transform=beside)
    told = interval(row.value, row.low, row.high)
    _write(axes, place, told, width() - LEFT - RIGHT + 0.12, weight=weight)


def _write(
    axes: Axes, place: float, text: str, left: float | None, *, weight: str = "normal", colour: str = INK
) -> None:
    """Write at a height, `left` inches from the left edge of the panel, or in its middle."""
    axes.text(
        0.5 if left is None else left / (width() - LEFT - RIGHT),
        place,
        text,
        transform=axes.get_yaxis_transform(),
        ha="center" if left is None else "left",
        va="center",
        fontsize=8,
        fontweight=weight,
        color=colour,
    )


def _draw_rigid(axes: Axes, rigid: float) -> None:
    low, high = axes.get_xlim()
    told = f"rigid body {rigid:.4f}"
    if rigid <= low:
        where, told = 0.0, f"← {told}"
    elif rigid >= high:
        where, told = 1.0, f"{told} →"
    else:
        where = (rigid - low) / (high - low)
        axes.axvline(rigid, label="rigid body", **LIMIT)
        told = f" {told} "
    axes.annotate(
        told,
        (where, 0.0),
        xycoords="axes fraction",
        xytext=(0, 3),
        textcoords="offset points",
        ha="left" if where < 0.5 else "right",
        va="bottom",
        fontsize=8,
        color=SOFT,
    )


def _limits(rows: Sequence[EstimateRow]) -> tuple[float, float]:
    values = np.array([row.value for row in rows if np.isfinite(row.value)])
    if not values.size:
        return 0.0, 1.0
    widths = np.array([row.high - row.low for row in rows if np.isfinite(row.high - row.low)])
    middle = float(np.median(values))
    reach = BEYOND * max(float(np.median(widths)) if widths.size else 0.0, SMALLEST_RANGE / 2)
    ends = [each for row in rows for each in (row.low, row.value, row.high) if np.isfinite(each)]
    low = max(min(ends), middle - reach)
    high = min(max(ends), middle + reach)
    margin = 0.08 * max(high - low, SMALLEST_RANGE)
    return low - margin, high + margin
