"""
Panels whose axes are drawn without an artist for each tick.

matplotlib makes five artists a tick: two marks, two labels and a grid line. On a page of thirty panels these take more
than half of the time. Here an axis draws its grid as one path, its marks as another, and its labels with one text.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis, XAxis, YAxis
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.transforms import IdentityTransform

from colonnade.arrays import Array
from colonnade.figures.style import ScaleStyle, is_narrow, scale_style

LABEL = 0.52
"""Distance of the labels of vertical axes from their panel, inches: numbers of any length fit between."""

ABOVE = 3.0
"""Distance of an axis's power of ten from its end, points."""


class _Lean(Axis, ABC):
    """Draws the scale of one axis; locator, formatter, limits and label are those of any axis."""

    def reset_ticks(self) -> None:
        """Forget ticks; none is made until somebody asks for one."""
        self.majorTicks: list[Any] = []
        self.minorTicks: list[Any] = []

    def shown_ticks(self) -> Array:
        """Return the major ticks in view."""
        low, high = sorted(self.get_view_interval())
        ticks = np.asarray(self.get_majorticklocs(), dtype=np.float64)
        slack = 1e-9 * (high - low)
        return ticks[(ticks >= low - slack) & (ticks <= high + slack)]

    def places(self) -> Array:
        """Return the display coordinates of the ticks in view along the axis."""
        return self._places(self.shown_ticks())

    def draw(self, renderer: RendererBase) -> None:
        """Draw grid, marks, labels, power of ten and label."""
        if not self.get_visible():
            return
        ticks, style, chosen = self.shown_ticks(), self.look, self.get_tick_params()
        texts = self.get_major_formatter().format_ticks(list(ticks))
        pixels = float(np.asarray(renderer.points_to_pixels(1.0)))
        places = self._places(ticks)
        renderer.open_group("axis")
        if chosen.get("gridOn", True):
            draw_lines(renderer, *self._grid(places), style.grid_color, style.grid_width)
        if chosen.get(self.side, True):
            draw_lines(renderer, *self._marks(places, style.tick_size * pixels), style.color, style.tick_width)
        if chosen.get(f"label{self.side}", True):
            size = float(chosen.get("labelsize", style.label_size))
            self._draw_labels(renderer, places, texts, style, size, pixels)
        self.label.draw(renderer)
        renderer.close_group("axis")
        self.stale = False

    side: Literal["bottom", "left"]

    def __init__(self, axes: Axes, **options: Any) -> None:
        super().__init__(axes, **options)
        self.look = scale_style()

    def get_ticks_position(self) -> Any:
        """Return the side at which marks and labels are; matplotlib would ask a tick."""
        return self.side

    @abstractmethod
    def _places(self, ticks: Array) -> Array:
        """Return the display coordinates of ticks along the axis."""

    @abstractmethod
    def _grid(self, places: Array) -> tuple[Array, Array]:
        """Return where the grid lines at these places start and end, display coordinates."""

    @abstractmethod
    def _marks(self, places: Array, size: float) -> tuple[Array, Array]:
        """Return where the marks of this length (pixels) at these places start and end, display coordinates."""

    @abstractmethod
    def _draw_labels(
        self, renderer: RendererBase, places: Array, texts: list[str], style: ScaleStyle, size: float, pixels: float
    ) -> None:
        """Write the numbers at these places, and place the axis's label."""


class LeanXAxis(_Lean, XAxis):
    """The horizontal axis below a panel."""

    side: Literal["bottom", "left"] = "bottom"

    def _places(self, ticks: Array) -> Array:
        return np.asarray(self.axes.transData.transform(np.column_stack((ticks, self._level(ticks))))[:, 0])

    def _level(self, ticks: Array) -> Array:
        return np.full(ticks.shape, self.axes.get_ylim()[0])

    def _grid(self, places: Array) -> tuple[Array, Array]:
        box = self.axes.bbox
        return columns(places, box.y0), columns(places, box.y1)

    def _marks(self, places: Array, size: float) -> tuple[Array, Array]:
        bottom = self.axes.bbox.y0
        return columns(places, bottom), columns(places, bottom - size)

    def _draw_labels(
        self, renderer: RendererBase, places: Array, texts: list[str], style: ScaleStyle, size: float, pixels: float
    ) -> None:
        box = self.axes.bbox
        height = box.y0 - (style.tick_size + style.pad) * pixels
        text = _text(self, size, style.label_color, "center", "top")
        for place, each in zip(places, texts, strict=True):
            _write(renderer, text, place, height, each)
        below = height - (1.2 * size + style.label_pad) * pixels
        # The label's own place would need the extent of every number.
        self.label.set(transform=IdentityTransform(), position=(0.5 * (box.x0 + box.x1), below), va="top", ha="center")
        if offset := self.get_major_formatter().get_offset():
            text.set_horizontalalignment("right")
            _write(renderer, text, box.x1, below, offset)


class LeanYAxis(_Lean, YAxis):
    """The vertical axis left of a panel; its label is where `set_label_coords` puts it."""

    side: Literal["bottom", "left"] = "left"

    def _places(self, ticks: Array) -> Array:
        level = np.full(ticks.shape, self.axes.get_xlim()[0])
        return np.asarray(self.axes.transData.transform(np.column_stack((level, ticks)))[:, 1])

    def _grid(self, places: Array) -> tuple[Array, Array]:
        box = self.axes.bbox
        return _rows(places, box.x0), _rows(places, box.x1)

    def _marks(self, places: Array, size: float) -> tuple[Array, Array]:
        left = self.axes.bbox.x0
        return _rows(places, left), _rows(places, left - size)

    def _draw_labels(
        self, renderer: RendererBase, places: Array, texts: list[str], style: ScaleStyle, size: float, pixels: float
    ) -> None:
        box = self.axes.bbox
        text = _text(self, size, style.label_color, "right", "center_baseline")
        for place, each in zip(places, texts, strict=True):
            _write(renderer, text, box.x0 - (style.tick_size + style.pad) * pixels, place, each)
        if offset := self.get_major_formatter().get_offset():
            text.set(horizontalalignment="left", verticalalignment="baseline")
            _write(renderer, text, box.x0, box.y1 + ABOVE * pixels, offset)


class LeanAxes(Axes):
    """A panel with lean axes."""

    def _init_axis(self) -> None:
        self.xaxis = LeanXAxis(self, clear=False)
        self.yaxis = LeanYAxis(self, clear=False)
        for axis, sides in ((self.xaxis, ("bottom", "top")), (self.yaxis, ("left", "right"))):
            for side in sides:
                self.spines[side].register_axis(axis)


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
    panel = LeanAxes(figure, place, sharex=sharex, sharey=sharey)
    for spine in panel.spines.values():
        spine.get_position()  # a spine takes its place when somebody asks for it; else the first tick does
    panel.yaxis.set_label_coords(-(0.8 if is_narrow() else 1.0) * LABEL / width, 0.5)
    figure.add_axes(panel)
    return panel


def draw_lines(renderer: RendererBase, starts: Array, ends: Array, color: str, width: float) -> None:
    """Draw lines from starts to ends, display coordinates of shape (n, 2), as one path."""
    if not len(starts):
        return
    gc = renderer.new_gc()
    gc.set_foreground(color)
    gc.set_linewidth(width)
    vertices = np.stack((starts, ends), axis=1).reshape(-1, 2)
    codes = np.tile(np.array((Path.MOVETO, Path.LINETO), dtype=np.uint8), len(starts))
    renderer.draw_path(gc, Path(vertices, codes), IdentityTransform())
    gc.restore()


def _text(
    axis: Axis, size: float, color: str, across: Literal["center", "right"], up: Literal["top", "center_baseline"]
) -> Text:
    text = Text(0.0, 0.0, "", color=color, fontsize=size, horizontalalignment=across, verticalalignment=up)
    text.set_figure(axis.get_figure(root=True))  # type: ignore[arg-type]
    return text


def _write(renderer: RendererBase, text: Text, across: float, up: float, said: str) -> None:
    if said:
        text.set_position((across, up))
        text.set_text(said)
        text.draw(renderer)


def columns(places: Array, height: float) -> Array:
    """Return points at horizontal places and one height, shape (n, 2)."""
    return np.column_stack((places, np.full(places.shape, height)))


def _rows(places: Array, across: float) -> Array:
    return np.column_stack((np.full(places.shape, across), places))
