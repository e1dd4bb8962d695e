"""How every figure looks: the style sheet, and one colour and dash for the measured and for each model."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypedDict

import matplotlib
from matplotlib.figure import Figure

STYLE_FILE = Path(__file__).with_name("colonnade.mplstyle")

WIDTH = 7.2
"""Width of every figure, inches."""


class LineStyle(TypedDict):
    """Keywords of a line."""

    color: str
    linestyle: str | tuple[float, tuple[float, ...]]
    linewidth: float


MEASURED: LineStyle = {"color": "#1c2430", "linestyle": "-", "linewidth": 1.1}
BASE: LineStyle = {"color": "#5b6675", "linestyle": "-", "linewidth": 0.8}
FIT: LineStyle = {"color": "#8a3fa8", "linestyle": "-", "linewidth": 1.2}
LIMIT: LineStyle = {"color": "#8a919c", "linestyle": (0, (1.0, 2.5)), "linewidth": 1.0}

MODELS: dict[str, LineStyle] = {
    "linear": {"color": "#d1490f", "linestyle": (0, (5.0, 1.6)), "linewidth": 1.1},
    "nonlinear": {"color": "#0b6bb0", "linestyle": (0, (7.0, 1.6, 1.6, 1.6)), "linewidth": 1.1},
    "contact": {"color": "#0a8a5f", "linestyle": (0, (2.2, 1.4)), "linewidth": 1.2},
}
"""Distinct by dash on a grey print, and by colour to colour-blind readers (after Okabe and Ito)."""


def model_style(model: str, thinness: float = 1.0) -> LineStyle:
    """
    Colour and dash of a model, the same in every figure; in small panels the line may be thinner.

    Raises
    ------
    ValueError
        If the model has none yet.
    """
    if model not in MODELS:
        raise ValueError(f"no line style for the model {model!r}; there is one for {', '.join(MODELS)}")
    style = MODELS[model]
    return {**style, "linewidth": thinness * style["linewidth"]}


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


def blank_figure(height: float) -> Figure:
    """Return an empty figure of the common width and of `height` (inches), laid out so that no label is cut off."""
    return Figure(figsize=(WIDTH, height), layout="constrained")
