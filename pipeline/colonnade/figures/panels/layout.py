"""Panels on common axes, placed by hand: drawn in half the time that an automatic layout takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.markers import TICKDOWN, TICKLEFT
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter

from colonnade.figures.style import FAINT, INK, SOFT, is_narrow, legend_columns, width

LEFT, RIGHT, TOP, BOTTOM, GAP = 0.92, 0.5, 0.34, 0.44, 0.14
"""Room for labels left and right, the legend above, the time axis below, and between panels; inches."""

LABEL = 0.52
"""Distance of the labels of vertical axes from their panel, inches: numbers of any length fit between."""

BELOW, TICK, PAD = 0.27, 3.5, 7.0
"""Distance of the label of a horizontal axis from its panel, inches; length of a tick, and a number's distance, pt."""

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
    """Return a figure with panels of these heights (inches) below each other, all on one horizontal axis."""
    figure, (panels,) = side_by_side(1, heights, title=0.0)
    return figure, panels


def side_by_side(columns: int, heights: Sequence[float], *, title: float = 0.2) -> tuple[Figure, list[list[Axes]]]:
    """
    Return a figure with columns of panels: one horizontal axis for all, one vertical axis a row of panels.

    More than `COLUMNS` are continued below, in bands. `heights` are those of the panels of a column from the top,
    `title` is the room above each column; inches.
    """
    across = 1 if is_narrow() else min(columns, COLUMNS)
    bands = -(-columns // across)
    room = title + GAP * (len(heights) - 1) + BOTTOM
    if is_narrow():
        share = ((PAGE - TOP) / bands - room) / sum(heights)
        heights = [height * min(1.0, max(share, LEAST_HEIGHT)) for height in heights]
    band = room + sum(heights)
    left, right = margins()
    panel = (width() - left - right - (across - 1) * GAP) / across
    figure = Figure(figsize=(width(), TOP + bands * band))
    grid: list[list[Axes]] = []
    for column in range(columns):
        row, place = divmod(column, across)
        top = TOP + row * band + title
        panels: list[Axes] = []
        for index, height in enumerate(heights):
            sharex = grid[0][0] if grid else panels[0] if panels else None
            sharey = grid[0][index] if grid else None
            one = add_panel(figure, left + place * (panel + GAP), top, panel, height, sharex=sharex, sharey=sharey)
            if place > 0:
                one.tick_params(labelleft=False)
            panels.append(one)
            top += height + GAP
        leave_scale_to_last(panels)
        grid.append(panels)
    return figure, grid


def leave_scale_to_last(panels: Sequence[Axes]) -> None:
    """Number the horizontal axis below the last panel alone."""
    for one in panels[:-1]:
        one.tick_params(axis="x", labelbottom=False, length=0)


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
    """Add a panel; inches from the left and upper edge of the figure."""
    across, total = (float(size) for size in figure.get_size_inches())
    place = (left / across, 1 - (top + height) / total, width / across, height / total)
    panel = figure.add_axes(place, sharex=sharex, sharey=sharey)
    panel.xaxis.set_label_coords(0.5, -BELOW / height)
    panel.yaxis.set_label_coords(-(0.8 if is_narrow() else 1.0) * LABEL / width, 0.5)
    for axis in (panel.xaxis, panel.yaxis):
        axis.set_visible(False)
        panel.add_artist(Scale(axis))
    return panel


class Scale(Artist):
    """Grid, ticks, numbers and label of an axis that is hidden: it would make five artists of each number."""

    zorder = 0.6  # above bands, below curves

    def __init__(self, axis: Axis) -> None:
        super().__init__()
        self.axis = axis

    def draw(self, renderer: RendererBase) -> None:
        """Draw what is in view now."""
        axis, axes, look = self.axis, self.axis.axes, self.axis.get_tick_params()
        is_across = axis is axes.xaxis
        side, marker, order = ("bottom", TICKDOWN, 1) if is_across else ("left", TICKLEFT, -1)
        place = axes.get_xaxis_transform() if is_across else axes.get_yaxis_transform()
        low, high = sorted(axis.get_view_interval())
        places, slack = np.asarray(axis.get_majorticklocs()), 1e-9 * (high - low)
        words = dict(zip(places.tolist(), axis.get_major_formatter().format_ticks(places.tolist()), strict=True))
        places = places[(places >= low - slack) & (places <= high + slack)]
        rules = np.repeat(places, 3), np.tile((0.0, 1.0, np.nan), places.size)
        lines = [Line2D(*rules[::order], color=rcParams["grid.color"], linewidth=rcParams["grid.linewidth"])]
        if look[side] and look.get("length") != 0:
            ticks = Line2D(*(places, np.zeros_like(places))[::order], color=FAINT, linestyle="none")
            ticks.set(marker=marker, markersize=TICK, markeredgewidth=0.8)
            lines.append(ticks)
        for line in lines:
            line.set(figure=axes.figure, transform=place)
            line.draw(renderer)
        if look[f"label{side}"]:
            beside, va, ha = axes.get_xaxis_text1_transform(PAD) if is_across else axes.get_yaxis_text1_transform(PAD)
            text = Text(color=INK, fontsize=look.get("labelsize", rcParams["xtick.labelsize"]), va=va, ha=ha)
            text.set(figure=axes.figure, transform=beside)
            for number in places.tolist():
                text.set(position=(number, 0.0)[::order], text=words[number])
                text.draw(renderer)
        point = axes.figure.dpi / 72
        factor = axis.get_major_formatter().get_offset()
        axis.offsetText.set(text=factor, y=axes.bbox.ymin - 20 * point if is_across else axes.bbox.ymax + 3 * point)
        for said in (axis.label, axis.offsetText):
            said.draw(renderer)


def add_row(figure: Figure, count: int, top: float, height: float, *, apart: float, below: float) -> list[Axes]:
    """Add panels `apart` beside each other, or in a single column with room `below` each; inches."""
    left, right = margins()
    beside = 1 if is_narrow() else count
    wide = (width() - left - right - apart * (beside - 1)) / beside
    places = [divmod(index, beside) for index in range(count)]
    return [
        add_panel(figure, left + place * (wide + apart), top + row * (height + below), wide, height)
        for row, place in places
    ]


def legend_above(figure: Figure, axes: Sequence[Axes]) -> None:
    """Name each line once, in the room that `stacked_panels` and `side_by_side` leave above all panels."""
    named, (left, _right) = _named(axes), margins()
    if not named:
        return
    look = _columns(named, width() - left - EDGE)
    _raise(figure, (-(-len(named) // look["ncols"]) - 1) * ROW)
    corner = (left / width(), 1 - 0.03 / float(figure.get_size_inches()[1]))
    look |= {"bbox_to_anchor": corner, "borderaxespad": 0.0, "borderpad": 0.0}
    figure.legend(list(named.values()), list(named), loc="upper left", **look)


def legend_outside(figure: Figure, axes: Sequence[Axes], *, below: bool = False, patches: Sequence[Patch] = ()) -> None:
    """Name each line once, after the patches, above or below all panels of a figure that is laid out automatically."""
    named = {str(patch.get_label()): patch for patch in patches} | _named(axes)
    if named:
        look = _columns(named, width() - EDGE) | {"borderaxespad": 0.2}
        handles, labels = list(named.values()), list(named)
        figure.legend(handles, labels, loc="outside lower center" if below else "outside upper left", **look)


def _columns(named: Mapping[str, Artist], room: float) -> dict[str, Any]:
    """Return spacing of a legend's entries, and the number of columns that find room (inches)."""
    closer = {"columnspacing": 0.7, "handlelength": 1.4, "handletextpad": 0.3} if len(named) > ROOMY else {}
    spacing = {"columnspacing": 1.4, **closer}
    return {"ncols": legend_columns(list(named), spacing, room), **spacing}


def _raise(figure: Figure, more: float) -> None:
    """Make a figure higher by so many inches at the top; its panels stay as they are."""
    wide, high = (float(size) for size in figure.get_size_inches())
    share = high / (high + more)
    for axes in figure.axes:
        box = axes.get_position()
        axes.set_position((box.x0, box.y0 * share, box.width, box.height * share))
    figure.set_size_inches(wide, high + more)


def _named(axes: Sequence[Axes]) -> dict[str, Artist]:
    named: dict[str, Artist] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            named.setdefault(str(label), handle)
    return named


def note(axes: Axes, text: str, at: tuple[float, float], shift: tuple[float, float] = (0.0, 0.0), **look: Any) -> None:
    """Write a remark at a place, in data or in the `xycoords` that are given, shifted by printer's points."""
    axes.annotate(text, at, shift, textcoords="offset points", **{"fontsize": 8, "color": INK, **look})


def caption(axes: Axes, text: str) -> None:
    """Write above a panel, in small letters, what it depends on."""
    narrow = is_narrow()
    axes.set_title(fill(text, 56 if narrow else 130), fontsize=7.0 if narrow else 8.0, color=SOFT)


def plain_decades(axis: Axis, subs: Sequence[float] = (1.0, 2.0, 5.0)) -> None:
    """Label a logarithmic axis with plain numbers, at these of each decade."""
    axis.set_major_locator(LogLocator(subs=subs, numticks=20))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
