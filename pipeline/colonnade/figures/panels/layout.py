"""Panels on common axes, placed by hand: drawn in half the time that an automatic layout takes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from colonnade.figures.style import fitting, grid_style, is_narrow, legend_columns, width

LEFT, RIGHT, TOP, BOTTOM, GAP = 0.92, 0.5, 0.34, 0.44, 0.14
"""Room for labels left and right, the legend above, the time axis below, and between panels; inches."""

LABEL = 0.52
"""Distance of the labels of vertical axes from their panel, inches: numbers of any length fit between."""

ROOMY = 4
"""Lines up to which a legend has its usual spacing; more, as all models with a band, have to stand closer."""

ROW = 0.15
"""Height of a further row of a legend, inches."""

EDGE = 0.15
"""Room between a legend and the right edge of a figure, inches."""

PAGE, LEAST_HEIGHT = 9.3, 0.5
"""Height of a journal's page, inches, and the share of their heights that panels of a single column keep at least."""

COLUMNS = 3
"""Largest number of columns side by side: more would be too narrow to read."""


def stacked_panels(heights: Sequence[float]) -> tuple[Figure, list[Axes]]:
    """
    Return a figure with one panel below the other, all on one horizontal axis.

    Parameters
    ----------
    heights : sequence of float
        Of the panels from the top, inches.

    Returns
    -------
    figure : Figure
    axes : list of Axes
        Only the lowest carries the numbers of the horizontal axis.

    Raises
    ------
    ValueError
        If there is no panel.
    """
    if not heights:
        raise ValueError("no height was given; at least one panel was expected")
    figure, (panels,) = side_by_side(1, heights, title=0.0)
    return figure, panels


def side_by_side(columns: int, heights: Sequence[float], *, title: float = 0.2) -> tuple[Figure, list[list[Axes]]]:
    """
    Return a figure with columns of panels: one horizontal axis for all, one vertical axis a row of panels.

    Parameters
    ----------
    columns : int
        More than `COLUMNS` are continued below, in bands.
    heights : sequence of float
        Of the panels of a column from the top, inches.
    title : float, optional
        Room above each column, inches.

    Returns
    -------
    figure : Figure
    axes : list of list of Axes
        Of each column from the top.

    Raises
    ------
    ValueError
        If there is no column or no height.
    """
    if columns < 1 or not heights:
        raise ValueError(f"{columns} columns of {len(heights)} panels; at least one column with one panel was expected")
    across = 1 if is_narrow() else min(columns, COLUMNS)
    bands = -(-columns // across)
    room = title + GAP * (len(heights) - 1) + BOTTOM
    if is_narrow():
        share = ((PAGE - TOP) / bands - room) / sum(heights)
        heights = [height * min(1.0, max(share, LEAST_HEIGHT)) for height in heights]
    band = room + sum(heights)
    total = TOP + bands * band
    left, right = margins()
    panel = (width() - left - right - (across - 1) * GAP) / across
    figure = Figure(figsize=(width(), total))
    grid: list[list[Axes]] = []
    for column in range(columns):
        row, place = divmod(column, across)
        top = total - TOP - row * band - title
        panels: list[Axes] = []
        for index, height in enumerate(heights):
            one = add_panel(
                figure,
                left + place * (panel + GAP),
                total - top,
                panel,
                height,
                sharex=grid[0][0] if grid else panels[0] if panels else None,
                sharey=grid[0][index] if grid else None,
            )
            if place > 0:
                one.tick_params(labelleft=False)
            panels.append(one)
            top -= height + GAP
        leave_scale_to_last(panels)
        grid.append(panels)
    return figure, grid


class _Rules(Artist):
    """The grid's vertical lines in a panel whose horizontal axis is not shown."""

    def __init__(self, look: dict[str, Any]) -> None:
        super().__init__()
        self.look = look
        self.set_zorder(0.5)

    def draw(self, renderer: RendererBase) -> None:
        """Draw them at the places where the axis would have its ticks."""
        if isinstance(axes := self.axes, Axes):
            low, high = sorted(axes.get_xlim())
            at = [place for place in axes.xaxis.get_majorticklocs() if low <= place <= high]
            where = np.repeat(at, 3), np.tile([0.0, 1.0, np.nan], len(at))
            rules = Line2D(*where, transform=axes.get_xaxis_transform(), **self.look)
            rules.set_figure(axes.get_figure(root=True))  # type: ignore[arg-type]
            rules.draw(renderer)


def leave_scale_to_last(panels: Sequence[Axes]) -> None:
    """Show the horizontal axis below the last panel alone: ticks that nobody sees were a sixth of a page's calls."""
    for one in panels[:-1]:
        one.xaxis.set_visible(False)
        one.add_artist(_Rules(grid_style()))


def margins() -> tuple[float, float]:
    """Return the room left and right, less where the text is smaller."""
    return (0.8 * LEFT, 0.95 * RIGHT) if is_narrow() else (LEFT, RIGHT)


def add_panel(
    figure: Figure,
    left: float,
    top: float,
    width: float,
    height: float,
    *,
    sharex: Axes | None = None,
    sharey: Axes | None = None,
) -> Axes:
    """
    Add a panel to a figure.

    Parameters
    ----------
    figure : Figure
    left, top, width, height : float
        Inches, from the left and upper edge of the figure.
    sharex, sharey : Axes, optional
        Panels whose axes it shares.
    """
    across, total = (float(size) for size in figure.get_size_inches())
    place = (left / across, 1 - (top + height) / total, width / across, height / total)
    panel = figure.add_axes(place, sharex=sharex, sharey=sharey)
    panel.xaxis.minorTicks, panel.yaxis.minorTicks = [], []  # unasked, matplotlib makes one of each
    panel.yaxis.set_label_coords(-(0.8 if is_narrow() else 1.0) * LABEL / width, 0.5)
    return panel


def legend_above(figure: Figure, axes: Sequence[Axes]) -> None:
    """Name each line once, in the room that `stacked_panels` and `side_by_side` leave above all panels."""
    named = _named(axes)
    if not named:
        return
    left, _right = margins()
    closer = {"columnspacing": 0.7, "handlelength": 1.4, "handletextpad": 0.3} if len(named) > ROOMY else {}
    spacing = {"columnspacing": 1.4, **closer}
    ncols = legend_columns(list(named), spacing, width() - left - EDGE)
    if ncols < len(named):
        _raise(figure, (-(-len(named) // ncols) - 1) * ROW)
    figure.legend(
        list(named.values()),
        list(named),
        loc="upper left",
        bbox_to_anchor=(left / width(), 1 - 0.03 / float(figure.get_size_inches()[1])),
        ncols=ncols,
        borderaxespad=0.0,
        borderpad=0.0,
        **spacing,
    )


def _raise(figure: Figure, more: float) -> None:
    """Make a figure higher by so many inches at the top; its panels stay as they are."""
    wide, high = (float(size) for size in figure.get_size_inches())
    for axes in figure.axes:
        box = axes.get_position()
        axes.set_position((box.x0, box.y0 * high / (high + more), box.width, box.height * high / (high + more)))
    figure.set_size_inches(wide, high + more)


def legend_outside(figure: Figure, axes: Sequence[Axes]) -> None:
    """Name each line once, above all panels of a figure that is laid out automatically."""
    named = _named(axes)
    if named:
        ncols = fitting(list(named), inches=width(), points=7.0, most=len(named)) if is_narrow() else len(named)
        figure.legend(list(named.values()), list(named), loc="outside upper left", ncols=ncols, borderaxespad=0.2)


def _named(axes: Sequence[Axes]) -> dict[str, Artist]:
    named: dict[str, Artist] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            named.setdefault(str(label), handle)
    return named
