"""How every figure looks: the style sheet, and one colour and dash for the measured and for each model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from pathlib import Path
from typing import Any, TypedDict

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from colonnade.dynamics.models import model_of

STYLE_FILE = Path(__file__).with_name("colonnade.mplstyle")
NARROW_FILE = Path(__file__).with_name("narrow.mplstyle")
"""Style of every figure, and what is smaller in a narrow one."""

WIDTH = 7.2
"""Width of every figure of a page, inches."""

COLUMNS = {"single": 90 / 25.4, "double": 190 / 25.4}
"""Widths of a journal's column and of its page, inches."""

NARROW = 4.0
"""A figure narrower than this, inches, has smaller text, and its parts stand below each other."""

_column: ContextVar[str] = ContextVar("column", default="")

_applied: ContextVar[bool | None] = ContextVar("applied", default=None)
"""Whether the style sheet that is applied is the narrow one; None if none is."""


class LineStyle(TypedDict):
    """Keywords of a line."""

    color: str
    linestyle: str | tuple[float, tuple[float, ...]]
    linewidth: float


INK, SOFT, FAINT = "#30353d", "#5b6675", "#8a919c"
"""Colours of labels, of remarks, and of what only guides the eye."""

MEASURED: LineStyle = {"color": "#1c2430", "linestyle": "-", "linewidth": 1.1}
BASE: LineStyle = {"color": SOFT, "linestyle": "-", "linewidth": 0.8}
FIT: LineStyle = {"color": "#8a3fa8", "linestyle": "-", "linewidth": 1.2}
LIMIT: LineStyle = {"color": FAINT, "linestyle": (0, (1.0, 2.5)), "linewidth": 1.0}


def model_style(model: str, thinness: float = 1.0) -> LineStyle:
    """Return colour and dash of a model, the same in every figure; in small panels the line may be thinner."""
    line = model_of(model).line
    return {"color": line.color, "linestyle": (0, line.dash), "linewidth": thinness * line.width}


def style_of(who: str, thinness: float = 1.0) -> LineStyle:
    """Return the look of what was "measured", or of a model; without a name that of what was recorded beside."""
    if who in ("", "measured"):
        return MEASURED if who else BASE
    return model_style(who, thinness)


def name_of(who: str) -> str:
    """Return the name of what was "measured", or of a model, as legends give it."""
    return who if who in ("", "measured") else f"{who} model"


def shortened(name: str, most: int) -> str:
    """Cut a name to so many letters."""
    return name if len(name) <= most else f"{name[: most - 1]}…"


@contextmanager
def journal(column: str) -> Iterator[None]:
    """Draw figures as wide as the "single" or "double" column of a journal, in this context."""
    before = _column.set(column)
    try:
        yield
    finally:
        _column.reset(before)


def width() -> float:
    """Return the width of a figure, inches: that of a page, unless a journal's column is asked for."""
    return COLUMNS.get(_column.get(), WIDTH)


def is_narrow() -> bool:
    """Return whether figures are drawn for a single column."""
    return width() < NARROW


@contextmanager
def styled() -> Iterator[None]:
    """
    Apply the style sheet over matplotlib's own defaults: a user's matplotlibrc changes no figure.

    Within this context it is applied already, which saves some milliseconds a figure.
    """
    if _applied.get() is is_narrow():
        yield
        return
    with matplotlib.rc_context():
        matplotlib.rcParams.update(_settings(is_narrow()))
        before = _applied.set(is_narrow())
        try:
            yield
        finally:
            _applied.reset(before)


@cache
def _settings(narrow: bool) -> Any:
    """Return defaults and style sheets, read once; the backend is no matter of style."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        for file in (STYLE_FILE, NARROW_FILE)[: 1 + narrow]:
            matplotlib.rc_file(file, use_default_template=False)
        settings = matplotlib.rcParams.copy()
    return {name: settings[name] for name in settings if name != "backend"}


def blank_figure(height: float) -> Figure:
    """Return an empty figure of the common width and of `height` (inches), laid out so that no label is cut off."""
    return Figure(figsize=(width(), height), layout="constrained")


def one_panel(height: float) -> tuple[Figure, Axes]:
    """Return such a figure with one panel."""
    figure = blank_figure(height)
    return figure, figure.subplots()


def legend_columns(labels: Sequence[str], spacing: Mapping[str, float], room: float) -> int:
    """Return how many columns of a legend, by the widths of its entries, go into the room for it (inches)."""
    style = matplotlib.rcParams
    usual = {"handlelength": style["legend.handlelength"], "handletextpad": style["legend.handletextpad"]}
    font, gaps = FontProperties(size=style["legend.fontsize"]), sum((usual | dict(spacing)).values())
    text = np.array([text_to_path.get_text_width_height_descent(each, font, "$" in each)[0] for each in labels])
    size = font.get_size_in_points() / 72
    entries, room = text / 72 + gaps * size, room + spacing["columnspacing"] * size
    for columns in range(len(labels), 1, -1):
        # A legend fills its columns one after the other, the first ones with one more.
        if sum(float(each.max()) for each in np.array_split(entries, columns)) <= room:
            return columns
    return 1
