"""How every figure looks: the style sheet, and one colour and dash for the measured and for each model."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypedDict

import matplotlib
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from colonnade.dynamics.models.registry import model_of

STYLE_FILE = Path(__file__).with_name("colonnade.mplstyle")

WIDTH = 7.2
"""Width of every figure, inches."""


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
    """
    Colour and dash of a model, the same in every figure; in small panels the line may be thinner.

    Raises
    ------
    ValueError
        If the model is unknown.
    """
    line = model_of(model).line
    return {"color": line.color, "linestyle": (0, line.dash), "linewidth": thinness * line.width}


@contextmanager
def styled() -> Iterator[None]:
    """Apply the style sheet over matplotlib's own defaults: a user's matplotlibrc changes no figure."""
    with matplotlib.rc_context():
        matplotlib.rcParams.update(_settings())
        yield


@cache
def _settings() -> Any:
    """Return defaults and style sheet, read once; the backend is no matter of style."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rc_file(STYLE_FILE, use_default_template=False)
        settings = matplotlib.rcParams.copy()
    return {name: settings[name] for name in settings if name != "backend"}


def grid_line() -> tuple[str, float]:
    """Return colour and width (points) of grid lines."""
    settings = _settings()
    return to_hex(settings["grid.color"]), float(settings["grid.linewidth"])


def blank_figure(height: float) -> Figure:
    """Return an empty figure of the common width and of `height` (inches), laid out so that no label is cut off."""
    return Figure(figsize=(WIDTH, height), layout="constrained")
