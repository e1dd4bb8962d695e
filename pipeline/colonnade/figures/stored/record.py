"""Curves of a test's stored results, and its pictures over time: measured, predicted, spreads, Spans."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from colonnade.arrays import Array
from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import Spread, bands_over_time, draw_angle, limit_of, time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import legend_above, side_by_side
from colonnade.figures.record import Peak, Quantity, SpanPanel, spans_side_by_side, whole_record
from colonnade.figures.style import is_narrow, styled
from colonnade.signals.filters import displacement
from colonnade.stages.parts.beginning import RECORDED
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import driven_by, predicted_peak_time
from colonnade.units import from_si
from colonnade.units.text import format_percent, number, quantity


def measured_ratio(stored: Stored, block: Block, *, as_recorded: bool = False) -> Curve | None:
    """Return the measured θ/α about the zero of the predictions, or as recorded; None if it was not measured."""
    return _ratio(stored, block, "rocking", as_recorded=as_recorded)


def true_angle(stored: Stored, measured: Array) -> Array:
    """Return a measured angle about the zero of the predictions, with the gain that a free vibration shows, rad."""
    offset, gain = (stored.value("compare", name) for name in ("zero_offset", "angle_gain"))
    return (measured - float(np.nan_to_num(offset))) / float(np.nan_to_num(gain, nan=1.0))


def predicted_ratios(stored: Stored, block: Block) -> dict[str, Curve]:
    """Return the predicted θ/α by model."""
    curves = {model: _ratio(stored, block, "predict", model) for model in stored.models("predict")}
    return {model: curve for model, curve in curves.items() if curve is not None}


def spreads(stored: Stored, block: Block) -> dict[str, Spread]:
    """Return the ensembles' bands of θ/α by model."""
    found = {}
    for model in stored.models("ensemble"):
        time, levels, angles = (
            stored.array("ensemble", name, model) for name in ("elapsed", "quantile", "rocking_angle_band")
        )
        overturning, horizon = (
            stored.value("ensemble", name, model) for name in ("overturning_probability", "horizon")
        )
        found[model] = Spread(time, levels, angles / block.critical_angle_at(angles), overturning, horizon)
    return found


def misfits(stored: Stored, measured: Curve | None, predicted: Mapping[str, Curve]) -> dict[str, Curve]:
    """Return predicted minus measured θ/α as far as the two are compared, by model."""
    found = {}
    for model, curve in predicted.items():
        until = stored.compared("compared_until", model)
        if measured is not None and curve.values.shape == measured.values.shape and np.isfinite(until):
            within = curve.time <= until
            found[model] = Curve(curve.time[within], (curve.values - measured.values)[within])
    return found


def quantities(stored: Stored, wanted: Sequence[tuple[str, str, str, str]], block: Block) -> list[Quantity]:
    """Return those motions that were measured; wanted are variable, words, label and unit."""
    found = []
    for name, _, label, unit in wanted:
        curve = motion(stored, name, unit)
        if curve is not None and np.isfinite(curve.values).any():
            uplift = block.uplift_acceleration if name == "base_acceleration" else None
            found.append(Quantity(f"{label}\n({unit})", curve, uplift, "g tan α"))
    return found


def motion(stored: Stored, name: str, unit: str) -> Curve | None:
    """Return a measured motion over time in a unit, None if it was not measured."""
    values = stored.array("rocking", name)
    if not (values.ndim == 1 and values.size):
        return None
    return Curve(stored.array("rocking", "elapsed"), from_si(1.0, unit) * values)


def base_displacement(stored: Stored) -> tuple[Curve | None, str]:
    """Return the displacement of the base over time, m, and where it is from; None if its motion was not recorded."""
    recorded, acceleration = motion(stored, "base_displacement", "m"), motion(stored, "base_acceleration", "m/s²")
    if recorded is not None and np.isfinite(recorded.values).any():
        return recorded, "recorded displacement"
    if acceleration is not None:
        return acceleration._replace(values=displacement(*acceleration)), "recorded acceleration integrated twice"
    return None, "not recorded, drawn at rest"


def _ratio(
    stored: Stored, block: Block, stage: str, model: str | None = None, *, as_recorded: bool = True
) -> Curve | None:
    if not stored.has(stage, "rocking_angle", model):
        return None
    time, angle = stored.array(stage, "elapsed", model), stored.array(stage, "rocking_angle", model)
    angle = angle if as_recorded else true_angle(stored, angle)
    # An overturned test ends where it overturns: what a frame or a floor does to it then is no rocking.
    fall = stored.value(stage, "overturning_time", model)
    ended = time.size if np.isnan(fall) else int(np.searchsorted(time, fall)) + 1
    angle = np.where(np.arange(time.size) < ended, angle, np.nan)
    return Curve(time, angle / block.critical_angle_at(angle))


MOTIONS = (
    ("slide", "slide", "slide", "mm"),
    ("uplift", "uplift", "uplift", "mm"),
    ("transverse_slide", "transverse slide", "slide, y", "mm"),
    ("out_of_plane_angle", "out-of-plane angle", "out of plane", "mrad"),
    ("yaw", "yaw", "yaw", "mrad"),
)
"""Other motions of a specimen than its rocking angle: variable, words, label of an axis, unit."""

BASE = (
    ("base_acceleration", "base acceleration", "base", "m/s²"),
    ("base_displacement", "base displacement", "base", "mm"),
    ("vertical_base_acceleration", "vertical base acceleration", "base, up", "m/s²"),
    ("transverse_base_acceleration", "transverse base acceleration", "base, y", "m/s²"),
)
"""Motions of the base, in the same form."""

MOST_SPANS = 12
"""Earthquake tests that are drawn side by side."""

SHADED = "nonlinear"
"""The model whose band is shaded on the overlay, if there are several."""


def record(test: Test, record: TestSummary, stored: Stored, block: Block) -> Picture | None:
    """Draw a test over time: angle, misfit, other motions, and the base motion if it drives; None without anything."""
    measured, predicted = measured_ratio(stored, block), predicted_ratios(stored, block)
    base = quantities(stored, BASE, block) if test.kind != "free-vibration" or driven_by(stored) == RECORDED else []
    if measured is None and not predicted and not base:
        return None
    figure = whole_record(
        measured,
        predicted,
        misfits=misfits(stored, measured, predicted),
        motions=quantities(stored, MOTIONS, block),
        base=base,
        impacts=stored.array("rocking", "impact_time"),
        peak=_peak(record, measured),
        until=_end(stored, measured, predicted),
        # Shades of several models on each other cannot be distinguished: those of the others are in `bands` alone.
        spreads=dict(sorted(spreads(stored, block).items(), key=lambda item: item[0] != SHADED)[:1]),
    )
    title = f"{test.id}: rocking angle, measured and predicted"
    return Picture(figure, f"record-{test.id}", title, seen(record, stored))


def bands(test: Test, stored: Stored, block: Block) -> Picture | None:
    """Draw the measured angle over what each model's own uncertainty leaves; None without an ensemble."""
    found = spreads(stored, block)
    if not found:
        return None
    said = [
        f"{model.capitalize()} model: {format_percent(spread.overturning_probability)} of its runs overturn."
        for model, spread in found.items()
    ]
    title = f"{test.id}: measured rocking angle over the spread of each model"
    return Picture(bands_over_time(measured_ratio(stored, block), found), f"bands-{test.id}", title, " ".join(said))


def span_panel(test: Test, stored: Stored, block: Block) -> SpanPanel:
    """Return what the figure of all Spans shows of one test."""
    measured, base = measured_ratio(stored, block), motion(stored, "base_acceleration", "m/s²")
    return SpanPanel(f"Span {test.span or 0.0}", measured, predicted_ratios(stored, block), base)


def spans(identity: str, title: str, description: str, panels: Sequence[SpanPanel]) -> Picture:
    """Draw earthquake tests of one motion side by side, in the order given; of many, some that are spread evenly."""
    if len(panels) <= MOST_SPANS:
        return Picture(spans_side_by_side(panels), identity, title, description)
    chosen = [panels[index] for index in np.linspace(0, len(panels) - 1, MOST_SPANS).round().astype(int)]
    note = f"{MOST_SPANS} of {len(panels)} tests are drawn, spread evenly; each is drawn whole on its own page."
    return Picture(spans_side_by_side(chosen), identity, title, description, note)


def seen(record: TestSummary, stored: Stored) -> str:
    """Say in words what a test's figure shows."""
    parts = []
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


def _peak(record: TestSummary, measured: Curve | None) -> Peak | None:
    if measured is None or record.peak_time is None:
        return None
    nearest = int(np.argmin(np.abs(measured.time - record.peak_time)))
    return Peak(record.peak_time, float(measured.values[nearest]))


def _end(stored: Stored, measured: Curve | None, predicted: Mapping[str, Curve]) -> float | None:
    """Return when all that rocks has overturned, s; None if something stands to the end."""
    falls = [stored.value("predict", "overturning_time", model) for model in predicted]
    if measured is not None:
        falls.append(stored.value("rocking", "overturning_time"))
    return None if not falls or np.isnan(falls).any() else max(falls)


HEIGHT, LOWER = 2.4, 1.7
"""Of the panel, and of that in a single column, inches."""


@styled()
def rocking_angle(measured: Curve | None, predicted: Mapping[str, Curve], *, title: str = "") -> Figure:
    """
    Draw the rocking angle over the critical angle, measured and by each model.

    Parameters
    ----------
    measured : Curve or None
        θ/α over time (s); None if it was not measured.
    predicted : mapping of str to Curve
        θ/α by model.
    title : str, optional
        Above the panel.

    Returns
    -------
    figure : Figure
    """
    figure, ((axes,),) = side_by_side(1, [LOWER if is_narrow() else HEIGHT])
    curves = [curve for curve in (measured, *predicted.values()) if curve is not None]
    draw_angle(axes, measured, predicted, limit_of(curves), thinness=0.8)
    axes.set(title=title, xlim=time_limits(curves), xlabel="time (s)")
    legend_above(figure, [axes])
    return figure


def angle(test: Test, record: TestSummary, stored: Stored, block: Block) -> Picture | None:
    """Draw the measured and the predicted angle of a test; None without any."""
    measured, predicted = measured_ratio(stored, block), predicted_ratios(stored, block)
    if measured is None and not predicted:
        return None
    figure = rocking_angle(measured, predicted, title=_title(test, record))
    return Picture(figure, f"angle-{test.id}", f"{test.id}: rocking angle over time", seen(record, stored))


def _title(test: Test, record: TestSummary) -> str:
    """Say what was done as a paper does: Ω and A of a sine, Span of an earthquake."""
    if record.frequency_ratio is not None and record.amplitude_ratio is not None:
        return f"{test.specimen}, Ω = {record.frequency_ratio:.2f}, A = {record.amplitude_ratio:.2f}"
    done = test.id if test.span is None else f"{test.motion or 'earthquake'}, Span {test.span}"
    return f"{test.specimen}, {done}"
