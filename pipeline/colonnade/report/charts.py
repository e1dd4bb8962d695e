"""The report's pictures: which curves go into which figure, and what is said to those who do not see it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from markupsafe import Markup

from colonnade import figures
from colonnade.campaign import Test
from colonnade.dynamics.block import Block
from colonnade.figures import Curve
from colonnade.report import wording
from colonnade.report.results import Results


def overlay(test: Test, results: Results, block: Block) -> Markup | None:
    """Draw measured and predicted, except in a free vibration over the base motion; None where there is nothing."""
    measured, predicted, base = measured_ratio(results, block), predicted_ratios(results, block), _base(results)
    identity, title = f"overlay-{test.id}", f"{test.id}: rocking angle, measured and predicted"
    if base is None or test.kind == "free-vibration":
        if measured is None and not predicted:
            return None
        figure = figures.rocking_history(measured, predicted)
    elif base[1] == "m/s²":
        figure = figures.history_with_base(
            measured, predicted, base[0], uplift=block.gravity * float(np.tan(block.critical_angle))
        )
    else:
        figure = figures.history_with_base(measured, predicted, base[0], base_label="displacement\nof base (mm)")
    return Markup(figures.to_svg(figure, identity=identity, title=title, description=seen(results)))


def spans(identity: str, title: str, tests: Sequence[tuple[Test, Results]], block: Block) -> Markup:
    """Draw earthquake tests of one motion together, in the order given."""
    panels = [
        figures.SpanPanel(_span(test), measured_ratio(results, block), predicted_ratios(results, block))
        for test, results in tests
    ]
    described = " ".join(f"{_span(test)}: {seen(results)}" for test, results in tests)
    return Markup(figures.to_svg(figures.spans_together(panels), identity=identity, title=title, description=described))


def peaks(identity: str, tests: Sequence[tuple[Test, Results]], block: Block) -> Markup:
    """Draw the peaks of a specimen's free vibrations with their fits."""
    series, described = [], []
    for test, results in tests:
        found = results.datasets["restitution"]
        used = found["peak_used"].to_numpy() == 1
        series.append(
            figures.PeakSeries(
                _short(test.id),
                found["peak_angle"].to_numpy(),
                found["peak_angle_standard_error"].to_numpy(),
                found["fitted_angle"].to_numpy(),
                used,
            )
        )
        described.append(f"{test.id}: {int(used.sum())} of {used.size} peaks used.")
    return Markup(
        figures.to_svg(
            figures.peak_decay(series, block),
            identity=identity,
            title="Energy of successive peaks against the impact number, with the fitted line",
            description=" ".join(described),
        )
    )


def measured_ratio(results: Results, block: Block) -> Curve | None:
    """Return the measured θ/α, None where the angle was not measured."""
    return _ratio(results, "rocking", block)


def predicted_ratios(results: Results, block: Block) -> Mapping[str, Curve]:
    """Return the predicted θ/α by model."""
    curves = {
        stage.removeprefix("predict "): _ratio(results, stage, block)
        for stage in results.datasets
        if stage.startswith("predict ")
    }
    return {model: curve for model, curve in curves.items() if curve is not None}


def seen(results: Results) -> str:
    """Say in words what an overlay shows."""
    parts = []
    for stage in ("rocking", *(stage for stage in results.datasets if stage.startswith("predict "))):
        if "rocking_angle" not in results.datasets.get(stage, ()):
            continue
        name = "Measured" if stage == "rocking" else f"{stage.removeprefix('predict ').capitalize()} model"
        peak, when = results.value(stage, "peak_ratio"), results.value(stage, "peak_time")
        largest = f", largest |θ|/α {wording.number(peak)} at {wording.quantity(when, 's')}" if peak == peak else ""
        parts.append(f"{name}: {results.text(stage, 'outcome') or 'no outcome'}{largest}.")
    return " ".join(parts) or "No rocking angle."


def _ratio(results: Results, stage: str, block: Block) -> Curve | None:
    dataset = results.datasets.get(stage)
    if dataset is None or "rocking_angle" not in dataset:
        return None
    angle = dataset["rocking_angle"].to_numpy()
    critical = np.where(angle < 0, block.negative.critical_angle, block.positive.critical_angle)
    return Curve(dataset["elapsed"].to_numpy(), angle / critical)


def _base(results: Results) -> tuple[Curve, str] | None:
    dataset = results.datasets.get("rocking")
    for name, factor, unit in (("base_acceleration", 1.0, "m/s²"), ("base_displacement", 1e3, "mm")):
        if dataset is not None and name in dataset:
            return Curve(dataset["elapsed"].to_numpy(), factor * dataset[name].to_numpy()), unit
    return None


def _span(test: Test) -> str:
    """Write the table's setting as laboratories do, with a decimal."""
    return f"Span {test.span or 0.0}"


def _short(name: str, longest: int = 26) -> str:
    return name if len(name) <= longest else f"{name[: longest - 1]}…"
