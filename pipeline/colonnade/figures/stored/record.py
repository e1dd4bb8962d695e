"""Pictures of a test over time: all of it, its angle alone, spreads, Spans."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.markers import TICKUP

from colonnade.arrays import Array
from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import (
    ANGLE_LABEL,
    Panel,
    Spread,
    bands_over_time,
    draw_angle,
    draw_curves,
    draw_panel,
    largest_of,
    limit_of,
    scale_symmetric,
    time_limits,
)
from colonnade.figures.panels.curve import Curve, envelope
from colonnade.figures.panels.layout import COLUMNS, legend_above, side_by_side, stacked_panels
from colonnade.figures.stored.subject import OfTest, some_of
from colonnade.figures.style import MEASURED, is_narrow, styled
from colonnade.stages.parts.beginning import RECORDED
from colonnade.store.records.test import driven_by, predicted_peak_time
from colonnade.units.text import format_percent, number, quantity


def quantities(one: OfTest, wanted: Sequence[tuple[str, str, str, str]]) -> list[Panel]:
    """Return panels of those motions that were measured; wanted are variable, title, label and unit."""
    found = []
    for name, title, label, unit in wanted:
        curve = one.motion(name, unit)
        if curve is not None:
            uplift = one.block.uplift_acceleration if name == "base_acceleration" else None
            found.append(Panel(title, label, unit, {"": curve}, uplift, "g tan α"))
    return found


def misfit(one: OfTest) -> list[Panel]:
    """Return the panel of predicted minus measured angle, if there is any."""
    apart = one.misfits()
    return [Panel("Predicted minus measured θ/α", "predicted −\nmeasured, / α", "", apart)] if apart else []


MOTIONS = (
    ("slide", "Slide", "slide", "mm"),
    ("uplift", "Uplift", "uplift", "mm"),
    ("transverse_slide", "Transverse slide", "slide, y", "mm"),
    ("out_of_plane_angle", "Out-of-plane angle", "out of plane", "mrad"),
    ("yaw", "Yaw", "yaw", "mrad"),
)
"""Other motions of a specimen than its rocking angle: variable, title, label of an axis, unit."""

BASE = (
    ("base_acceleration", "Base acceleration", "base", "m/s²"),
    ("base_displacement", "Base displacement", "base", "mm"),
    ("vertical_base_acceleration", "Vertical base acceleration", "base, up", "m/s²"),
    ("transverse_base_acceleration", "Transverse base acceleration", "base, y", "m/s²"),
)
"""Motions of the base, in the same form."""

SHADED = "nonlinear"
"""The model whose band is shaded on the overlay, if there are several."""


ANGLE_HEIGHT, OTHER_HEIGHT = 2.0, 0.8
"""Heights of the panels, inches."""

AFTER = 0.05
"""Share of the time up to an overturning that the axis shows after it."""


def record(one: OfTest) -> Picture | None:
    """All of a test over time: angle, misfit, other motions, and the base motion if it drives."""
    test, stored, curves = one.test, one.stored, one.ratios()
    base = quantities(one, BASE) if test.kind != "free-vibration" or driven_by(stored) == RECORDED else []
    if not curves and not base:
        return None
    # Shades of several models on each other cannot be distinguished: those of the others are in `bands` alone.
    shaded = dict(sorted(one.spreads().items(), key=lambda item: item[0] != SHADED)[:1])
    figure = whole_record(
        curves,
        [*misfit(one), *quantities(one, MOTIONS), *base],
        impacts=stored.array("rocking", "impact_time"),
        peak=_peak(one.record, curves.get("measured")),
        spreads=shaded,
        until=_end(one, curves),
    )
    return Picture(figure, f"record-{test.id}", f"{test.id}: rocking angle, measured and predicted", seen(one))


@styled()
def whole_record(
    curves: Mapping[str, Curve],
    others: Sequence[Panel] = (),
    *,
    impacts: Array | None = None,
    peak: tuple[float, float] | None = None,
    spreads: Mapping[str, Spread] | None = None,
    until: float | None = None,
) -> Figure:
    """
    Draw one test: measured and predicted angle above, and other panels below.

    `impacts` are times (s) of the measured impacts, marked along the foot of the angle's panel; `peak` is time and θ/α
    of the largest measured angle, marked with a ring; of `spreads` the widest band of each is shaded. The time axis
    ends shortly after all has overturned, at `until` (s).
    """
    figure, axes = stacked_panels([ANGLE_HEIGHT, *([OTHER_HEIGHT] * len(others))])
    limit = limit_of(curves.values())
    draw_angle(axes[0], curves, limit, spreads=spreads)
    if impacts is not None and impacts.size:
        foot, at = np.zeros_like(impacts), axes[0].get_xaxis_transform()
        (ticks,) = axes[0].plot(impacts, foot, color=MEASURED["color"], linestyle="none", marker=TICKUP, transform=at)
        ticks.set(markersize=5, markeredgewidth=0.6, gid="measured impact")
    if peak is not None and np.isfinite(peak).all() and abs(peak[1]) < limit:
        axes[0].plot(*peak, "o", color=MEASURED["color"], markersize=5, markerfacecolor="none", gid="largest measured")
    for one, panel in zip(axes[1:], others, strict=True):
        draw_panel(one, panel)
    first, last = time_limits([*curves.values(), *(curve for panel in others for curve in panel.curves.values())])
    axes[0].set_xlim(first, last if until is None else min(last, until + AFTER * (until - first)))
    axes[-1].set_xlabel("time (s)")
    legend_above(figure, axes[:1])
    return figure


def bands(one: OfTest) -> Picture | None:
    """Measured angle over each model's bands."""
    found, measured = one.spreads(), one.measured_ratio()
    if not found:
        return None
    said = [
        f"{model.capitalize()} model: {format_percent(spread.overturning_probability)} of its runs overturn."
        for model, spread in found.items()
    ]
    figure = bands_over_time({} if measured is None else {"measured": measured}, found)
    title = f"{one.test.id}: measured rocking angle over the spread of each model"
    return Picture(figure, f"bands-{one.test.id}", title, " ".join(said))


MODEL_HEIGHT, BASE_HEIGHT = 1.35, 0.8
"""Heights of the panels of a Span, inches."""

THINNESS = 0.6
"""Of the models' lines beside their usual width."""


class SpanPanel(NamedTuple):
    """One test: its title, θ/α over time (s) as "measured" and by each model; base in m/s²."""

    title: str
    curves: Mapping[str, Curve]
    base: Curve | None = None

    def thinned(self) -> SpanPanel:
        """Return the same panel with curves of a few hundred points, so that many fit into memory."""
        base = None if self.base is None else envelope(self.base)
        return SpanPanel(self.title, {name: envelope(curve) for name, curve in self.curves.items()}, base)


def span_panel(one: OfTest) -> SpanPanel:
    """Return what the figure of all Spans shows of one test."""
    return SpanPanel(f"Span {one.test.span or 0.0}", one.ratios(), one.motion("base_acceleration", "m/s²"))


def spans(identity: str, title: str, description: str, panels: Sequence[SpanPanel]) -> Picture:
    """Draw earthquake tests of one motion side by side, in the order given; of many, some that are spread evenly."""
    shown, note = some_of(panels, "tests")
    return Picture(spans_side_by_side(shown), identity, title, description, note)


@styled()
def spans_side_by_side(panels: Sequence[SpanPanel]) -> Figure:
    """Draw earthquake tests side by side, a row of panels for each model, all with the same scales."""
    models = list(dict.fromkeys(name for panel in panels for name in panel.curves if name != "measured")) or [""]
    curves = [curve for panel in panels for curve in panel.curves.values()]
    bases = [panel.base for panel in panels if panel.base is not None]
    limit, largest, rows = limit_of(curves), largest_of(base.values for base in bases) or 1.0, len(models)
    figure, grid = side_by_side(len(panels), [MODEL_HEIGHT] * rows + [BASE_HEIGHT] * bool(bases))
    for index, (column, panel) in enumerate(zip(grid, panels, strict=True)):
        is_first = is_narrow() or index % COLUMNS == 0
        for one, model in zip(column, models, strict=False):
            shown = {name: curve for name, curve in panel.curves.items() if name in ("measured", model)}
            draw_angle(one, shown, limit, thinness=THINNESS, limit_name="")
            one.set_ylabel(ANGLE_LABEL if is_first else "")
        column[0].set_title(panel.title)
        if bases:
            draw_curves(column[-1], {} if panel.base is None else {"": panel.base})
            scale_symmetric(column[-1], largest)
            column[-1].set_ylabel("base\n(m/s²)" if is_first else "")
        column[-1].set_xlabel("time (s)")
        column[0].set_xlim(*time_limits([*curves, *bases]))
    legend_above(figure, [one for column in grid for one in column[:rows]])
    return figure


def seen(one: OfTest) -> str:
    """Say in words what a test's figure shows."""
    record, stored, parts = one.record, one.stored, list[str]()
    if stored.has("rocking", "rocking_angle"):
        parts.append(_said("Measured", record.outcome, record.peak_ratio, record.peak_time))
    for model, predicted in record.predicted.items():
        if stored.has("predict", "rocking_angle", model):
            time = predicted_peak_time(stored, model)
            parts.append(_said(f"{model.capitalize()} model", predicted.outcome, predicted.peak_ratio, time))
    return " ".join(parts) or "No rocking angle."


def _said(name: str, outcome: str | None, ratio: float | None, time: float | None) -> str:
    at = f" at {quantity(time, 's', 4)}"
    peak = f", largest |θ|/α {number(ratio)}{at}" if ratio is not None else at if outcome == "overturned" else ""
    return f"{name}: {outcome or 'no outcome'}{peak}."


def _peak(record: TestSummary, measured: Curve | None) -> tuple[float, float] | None:
    if measured is None or record.peak_time is None:
        return None
    nearest = int(np.argmin(np.abs(measured.time - record.peak_time)))
    return record.peak_time, float(measured.values[nearest])


def _end(one: OfTest, curves: Mapping[str, Curve]) -> float | None:
    """Return when all that rocks has overturned, s; None if something stands to the end."""
    sources = [one.sources[who] for who in curves]
    falls = [one.stored.value(stage, "overturning_time", model) for stage, model in sources]
    return None if not falls or np.isnan(falls).any() else max(falls)


HEIGHT, LOWER = 2.4, 1.7
"""Of the panel, and of that in a single column, inches."""


@styled()
def rocking_angle(curves: Mapping[str, Curve], *, title: str) -> Figure:
    """Draw θ/α over time (s), measured and by each model, below a title."""
    figure, ((axes,),) = side_by_side(1, [LOWER if is_narrow() else HEIGHT])
    draw_angle(axes, curves, limit_of(curves.values()), thinness=0.8)
    axes.set(title=title, xlim=time_limits(curves.values()), xlabel="time (s)")
    legend_above(figure, [axes])
    return figure


def angle(one: OfTest) -> Picture | None:
    """Rocking angle over time, measured and predicted."""
    curves = one.ratios()
    if not curves:
        return None
    figure = rocking_angle(curves, title=_title(one.test, one.record))
    return Picture(figure, f"angle-{one.test.id}", f"{one.test.id}: rocking angle over time", seen(one))


def _title(test: Test, record: TestSummary) -> str:
    """Say what was done as a paper does: Ω and A of a sine, Span of an earthquake."""
    if record.frequency_ratio is not None and record.amplitude_ratio is not None:
        return f"{test.specimen}, Ω = {record.frequency_ratio:.2f}, A = {record.amplitude_ratio:.2f}"
    done = test.id if test.span is None else f"{test.motion or 'earthquake'}, Span {test.span}"
    return f"{test.specimen}, {done}"
