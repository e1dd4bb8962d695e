"""The report's pictures: which curves go into which figure, and what is said to those who do not see it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from markupsafe import Markup

from colonnade import figures
from colonnade.campaign import Test
from colonnade.dynamics.block import Block
from colonnade.figures import Curve, Peak, Quantity, SpanPanel, Spread
from colonnade.identification.boundaries import MapPoint
from colonnade.report import wording
from colonnade.report.results import Results
from colonnade.stages.beginning import RECORDED

MOTIONS = (
    ("slide", "slide\n(mm)", 1e3),
    ("uplift", "uplift\n(mm)", 1e3),
    ("transverse_slide", "slide, y\n(mm)", 1e3),
    ("out_of_plane_angle", "out of plane\n(mrad)", 1e3),
    ("yaw", "yaw\n(mrad)", 1e3),
)
"""Motions of a specimen beside its rocking angle: variable, label, factor from SI."""

BASE = (
    ("base_acceleration", "base\n(m/s²)", 1.0),
    ("base_displacement", "base\n(mm)", 1e3),
    ("vertical_base_acceleration", "base, up\n(m/s²)", 1.0),
    ("transverse_base_acceleration", "base, y\n(m/s²)", 1.0),
)
"""Motions of the base, likewise."""


SHADED = "nonlinear"
"""The model whose band is shaded on the overlay, where there are several."""


def record(test: Test, results: Results, block: Block) -> Markup | None:
    """Draw a test over time: angle, misfit, other motions, and the base motion if it drives; None without anything."""
    measured, predicted = measured_ratio(results, block), predicted_ratios(results, block)
    base = _quantities(results, BASE, block) if test.kind != "free-vibration" or results.driven_by == RECORDED else []
    if measured is None and not predicted and not base:
        return None
    spreads = _spreads(results, block)
    figure = figures.whole_record(
        measured,
        predicted,
        misfits=_misfits(results, measured, predicted),
        motions=_quantities(results, MOTIONS, block),
        base=base,
        impacts=results.datasets["rocking"]["impact_time"].to_numpy() if _has(results, "impact_time") else None,
        peak=_peak(test, results, measured),
        # Shades of several models on each other cannot be told apart: those of the others are in `bands` alone.
        spreads=dict(sorted(spreads.items(), key=lambda item: item[0] != SHADED)[:1]),
    )
    title = f"{test.id}: rocking angle, measured and predicted"
    return Markup(figures.to_svg(figure, identity=f"record-{test.id}", title=title, description=seen(test, results)))


def bands(test: Test, results: Results, block: Block) -> Markup | None:
    """Draw the measured angle over what each model's own uncertainty leaves; None where there is no ensemble."""
    spreads = _spreads(results, block)
    if not spreads:
        return None
    figure = figures.bands_over_time(measured_ratio(results, block), spreads)
    title = f"{test.id}: measured rocking angle over the spread of each model"
    said = [
        f"{model.capitalize()} model: {spread.overturning_probability:.0%} of its runs overturn."
        for model, spread in spreads.items()
    ]
    return Markup(figures.to_svg(figure, identity=f"bands-{test.id}", title=title, description=" ".join(said)))


def span_panel(test: Test, results: Results, block: Block) -> SpanPanel:
    """Return what the figure of all Spans shows of one test, thinned so that many fit into memory."""
    measured, base = measured_ratio(results, block), None
    if _has(results, "base_acceleration"):
        rocking = results.datasets["rocking"]
        base = figures.envelope(Curve(rocking["elapsed"].to_numpy(), rocking["base_acceleration"].to_numpy()))
    return SpanPanel(
        f"Span {test.span or 0.0}",
        None if measured is None else figures.envelope(measured),
        {model: figures.envelope(curve) for model, curve in predicted_ratios(results, block).items()},
        base,
    )


def spans(identity: str, title: str, description: str, panels: Sequence[SpanPanel]) -> Markup:
    """Draw earthquake tests of one motion side by side, in the order given."""
    return Markup(
        figures.to_svg(figures.spans_side_by_side(panels), identity=identity, title=title, description=description)
    )


def measured_map(identity: str, points: Sequence[MapPoint]) -> Markup:
    """Draw the sine tests of a specimen by outcome over Ω and A."""
    outcomes = [point.outcome for point in points]
    described = ", ".join(f"{outcomes.count(outcome)} {outcome}" for outcome in dict.fromkeys(outcomes))
    return Markup(
        figures.to_svg(
            figures.measured_map(points),
            identity=identity,
            title="Sine tests by outcome over frequency ratio Ω and amplitude ratio A",
            description=f"{len(points)} tests: {described}.",
        )
    )


def measured_ratio(results: Results, block: Block, *, as_recorded: bool = False) -> Curve | None:
    """Return the measured θ/α about the zero of the predictions, or as recorded; None if it was not measured."""
    offset = 0.0 if as_recorded else results.value("compare", "zero_offset") or 0.0
    return _ratio(results, "rocking", block, offset)


def predicted_ratios(results: Results, block: Block) -> Mapping[str, Curve]:
    """Return the predicted θ/α by model."""
    curves = {
        stage.removeprefix("predict "): _ratio(results, stage, block)
        for stage in results.datasets
        if stage.startswith("predict ")
    }
    return {model: curve for model, curve in curves.items() if curve is not None}


def seen(test: Test, results: Results) -> str:
    """Say in words what a test's figure shows."""
    parts = []
    measured = results.measured_peak(test)
    for stage in ("rocking", *(stage for stage in results.datasets if stage.startswith("predict "))):
        if "rocking_angle" not in results.datasets.get(stage, ()):
            continue
        name = "Measured" if stage == "rocking" else f"{stage.removeprefix('predict ').capitalize()} model"
        peak, when = results.value(stage, "peak_ratio"), results.value(stage, "peak_time")
        if stage == "rocking":
            peak, when = measured.ratio, measured.time
        largest = f", largest |θ|/α {wording.number(peak)} at {wording.quantity(when, 's')}" if peak == peak else ""
        parts.append(f"{name}: {results.text(stage, 'outcome') or 'no outcome'}{largest}.")
    return " ".join(parts) or "No rocking angle."


def _ratio(results: Results, stage: str, block: Block, offset: float = 0.0) -> Curve | None:
    dataset = results.datasets.get(stage)
    if dataset is None or "rocking_angle" not in dataset:
        return None
    angle = dataset["rocking_angle"].to_numpy() - offset
    critical = np.where(angle < 0, block.negative.critical_angle, block.positive.critical_angle)
    return Curve(dataset["elapsed"].to_numpy(), angle / critical)


def _spreads(results: Results, block: Block) -> dict[str, Spread]:
    """Return the ensembles' bands of θ/α by model."""
    spreads: dict[str, Spread] = {}
    for stage in (stage for stage in results.datasets if stage.startswith("ensemble ")):
        found = results.datasets[stage]
        angles = found["rocking_angle_band"].to_numpy()
        critical = np.where(angles < 0, block.negative.critical_angle, block.positive.critical_angle)
        spreads[stage.removeprefix("ensemble ")] = Spread(
            found["elapsed"].to_numpy(),
            found["quantile"].to_numpy(),
            angles / critical,
            float(found["overturning_probability"]),
            float(found["horizon"]),
        )
    return spreads


def _misfits(results: Results, measured: Curve | None, predicted: Mapping[str, Curve]) -> dict[str, Curve]:
    """Predicted minus measured θ/α as far as the two are compared."""
    compared = results.datasets.get("compare")
    if measured is None or compared is None:
        return {}
    until = dict(zip(compared["model"].to_numpy().tolist(), compared["compared_until"].to_numpy(), strict=True))
    misfits = {}
    for model, curve in predicted.items():
        if curve.values.shape == measured.values.shape and np.isfinite(until.get(model, np.nan)):
            within = curve.time <= until[model]
            misfits[model] = Curve(curve.time[within], (curve.values - measured.values)[within])
    return misfits


def _peak(test: Test, results: Results, measured: Curve | None) -> Peak | None:
    ratio, when, _ = results.measured_peak(test)
    if measured is None or not (np.isfinite(ratio) and np.isfinite(when)):
        return None
    return Peak(when, float(measured.values[int(np.argmin(np.abs(measured.time - when)))]))


def _quantities(results: Results, wanted: Sequence[tuple[str, str, float]], block: Block) -> list[Quantity]:
    quantities = []
    for name, label, factor in wanted:
        if _has(results, name):
            rocking = results.datasets["rocking"]
            curve = Curve(rocking["elapsed"].to_numpy(), factor * rocking[name].to_numpy())
            uplift = block.uplift_acceleration if name == "base_acceleration" else None
            if np.isfinite(curve.values).any():
                quantities.append(Quantity(label, curve, uplift, "g tan α"))
    return quantities


def _has(results: Results, name: str) -> bool:
    rocking = results.datasets.get("rocking")
    return rocking is not None and name in rocking and rocking[name].ndim == 1
