"""The paper's figures, drawn of the virtual campaign by the product's own panels and maps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

from matplotlib.figure import Figure

from colonnade.dynamics.maps import StabilityMap
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import ANGLE_LABEL, draw_angle, limit_of, scale_symmetric, time_limits
from colonnade.figures.maps import response_orders
from colonnade.figures.panels.curve import draw_curve
from colonnade.figures.panels.layout import legend_above, side_by_side
from colonnade.figures.stored.record import SpanPanel
from colonnade.figures.style import BASE, styled
from reproduction.campaign import ANALYTICAL, NUMERICAL, SPECIMEN
from reproduction.printed import SHOWN, SHOWN_FREQUENCY, SPANS
from reproduction.responses import span_tests
from reproduction.results import Found

ANGLE_HEIGHT, BASE_HEIGHT = 1.9, 0.7
"""Heights of the panels, inches."""

AROUND = (0.8, 8.2)
"""Ω of the axis of a map."""

FREE = "free-01"
"""The free vibration that is drawn."""


@styled()
def overlays(panels: Sequence[SpanPanel], *, until: float | None = None) -> Figure:
    """
    Draw histories side by side on common scales, measured and computed on each other, above the base motions.

    Parameters
    ----------
    panels : sequence of Panel
    until : float, optional
        s: end of the axis of time; default that of the longest curve.

    Returns
    -------
    figure : Figure
    """
    bases = [panel.base for panel in panels if panel.base is not None]
    curves = [curve for panel in panels for curve in panel.curves.values()]
    limit = limit_of(curves)
    figure, grid = side_by_side(len(panels), [ANGLE_HEIGHT] + [BASE_HEIGHT] * bool(bases))
    for column, panel in zip(grid, panels, strict=True):
        draw_angle(column[0], panel.curves, limit, thinness=0.8, limit_name="")
        column[0].set_title(panel.title)
        column[0].set_ylabel("")
        if bases:
            if panel.base is not None:
                draw_curve(column[-1], panel.base, **BASE)
            scale_symmetric(column[-1], max(abs(base.values).max() for base in bases))
        column[-1].set_xlabel("time (s)")
        first, last = time_limits([*curves, *bases])
        column[0].set_xlim(first, last if until is None else until)
    grid[0][0].set_ylabel(ANGLE_LABEL)
    if bases:
        grid[0][-1].set_ylabel("base\n(m/s²)")
    legend_above(figure, [column[0] for column in grid])
    return figure


def _panel(found: Found, test: str, title: str, shown: Sequence[str], *, based: bool = True) -> SpanPanel:
    """Gather a panel; `shown` are "measured" and models."""
    one = found.of(test)
    curves = one.ratios()
    chosen = {who: curves[who] for who in shown if who in curves}
    return SpanPanel(title, chosen, one.motion("base_acceleration", "m/s²") if based else None)


def _free(found: Found, shown: Sequence[str]) -> Figure:
    return overlays([_panel(found, FREE, f"{FREE}, prism", shown, based=False)], until=14.0)


def _sines(found: Found) -> Figure:
    panels = [
        _panel(
            found, f"sine-{SHOWN_FREQUENCY:g}Hz-{level:.2f}", f"({letter}) A = {level:.2f}", ("measured", ANALYTICAL)
        )
        for letter, level in zip("abc", SHOWN, strict=True)
    ]
    return overlays(panels)


def _spans(found: Found, shown: Sequence[str]) -> Figure:
    tests = span_tests(found.campaign, SPECIMEN)
    panels = [
        _panel(found, tests[f"{span:.1f}"], f"({letter}) Span {span:.1f}", shown)
        for letter, span in zip("abc", SPANS, strict=True)
    ]
    return overlays(panels, until=12.0)


def _map(found: Found, charts: Sequence[StabilityMap]) -> Figure:
    """Draw a computed map with room for the tests at its lowest and highest frequency."""
    figure = response_orders.computed(SPECIMEN, charts, found.points).figure
    axes = figure.axes[0]
    axes.set_xlim(AROUND)
    axes.set_ylim(top=1.06 * axes.get_ylim()[1])
    return figure


class Entry(NamedTuple):
    """A figure of the paper: number, title, what is seen in it, and how it is drawn."""

    number: str
    title: str
    described: str
    draw: Callable[[Found], Figure]


SPANS_SEEN = "Rocking angle at Spans 2.0, 2.5 and 3.0 above the recorded table motion."

FIGURES: tuple[Entry, ...] = (
    Entry(
        "3",
        "Free vibration, measured and analytical",
        "Rocking angle over critical angle over time: it decays from impact to impact.",
        lambda found: _free(found, ("measured", ANALYTICAL)),
    ),
    Entry(
        "4",
        "Sine tests at Ω = 3.35 and A = 1.05, 1.10, 1.80",
        "Measured rocking angle and linear model above the recorded table motion.",
        _sines,
    ),
    Entry(
        "5",
        "Sine tests by outcome, with both boundaries",
        "No rocking below A = 1; the boundary of overturning rises with Ω.",
        lambda found: response_orders.tested("figure-5", found.points).figure,
    ),
    Entry(
        "7",
        "Map of the analytical model with the measured tests",
        "A lower and an upper limit of overturning over Ω.",
        lambda found: _map(found, [found.fine]),
    ),
    Entry("8", "Three Spans, measured and analytical", SPANS_SEEN, partial(_spans, shown=("measured", ANALYTICAL))),
    Entry(
        "10",
        "Free vibration, numerical and analytical",
        "Contact model and linear model from the same measured angle.",
        lambda found: _free(found, (ANALYTICAL, NUMERICAL)),
    ),
    Entry(
        "12",
        "Map of the numerical model with the measured tests",
        "Limits of the contact model at the seven frequencies of the tests.",
        lambda found: _map(found, [found.charts[NUMERICAL]]),
    ),
    Entry(
        "13",
        "Maps of both models with the measured tests",
        "Limits of the linear and of the contact model at the seven frequencies of the tests.",
        lambda found: _map(found, [found.charts[ANALYTICAL], found.charts[NUMERICAL]]),
    ),
    Entry("14", "Three Spans, measured and numerical", SPANS_SEEN, partial(_spans, shown=("measured", NUMERICAL))),
    Entry(
        "15",
        "Three Spans, numerical and analytical",
        "Contact model and linear model at Spans 2.0, 2.5 and 3.0.",
        lambda found: _spans(found, (ANALYTICAL, NUMERICAL)),
    ),
)
"""The paper's figures that show results; the others are photographs, drawings and the table's sine."""


def file_of(entry: Entry) -> str:
    """Return the name of a figure's file."""
    return f"figure-{entry.number}.svg"


def drawn(found: Found) -> Iterator[tuple[str, str]]:
    """Draw every figure: the name of its file and its SVG."""
    for entry in FIGURES:
        picture = Picture(entry.draw(found), f"figure-{entry.number}", entry.title, entry.described)
        yield file_of(entry), picture.svg
