"""What the page says of each test and specimen: finished text, values with units, dashes for what is not known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any

from markupsafe import Markup

from colonnade.campaign import Campaign, Test
from colonnade.report import charts, wording
from colonnade.report.results import Message, Results

_CHANNEL_UNITS = {
    "displacement": "mm",
    "velocity": "mm/s",
    "acceleration": "m/s²",
    "angle": "mrad",
    "angular_velocity": "rad/s",
    "force": "N",
}
_SOURCES = {
    "given": "given in the campaign file",
    "identified": "identified from free vibrations",
    "rigid-body": "the rigid-body value, as none is given or identified",
}


@dataclass(frozen=True)
class ModelRow:
    """A model beside the measurement: outcome, whether it agrees (None: not known), peak ratio, nrmse."""

    outcome: str
    agrees: bool | None
    peak_ratio: str
    nrmse: str


@dataclass(frozen=True)
class ChannelRow:
    """One channel after conditioning."""

    name: str
    quantity: str
    zero: str
    noise: str
    cutoff: str
    clock: str
    quality: str


@dataclass(frozen=True)
class TestRow:
    """One test; every field is text for the page."""

    __test__ = False  # pytest takes a class of this name for a test

    id: str
    kind: str
    specimen: str
    facts: tuple[tuple[str, str], ...]
    status: str
    failures: tuple[Message, ...]
    warnings: tuple[Message, ...]
    outcome: str
    observed: str
    peak_ratio: str
    peak_ground_acceleration: str
    models: dict[str, ModelRow]
    channels: tuple[ChannelRow, ...]
    raw_files: tuple[tuple[str, str], ...]
    chart: Markup | None

    @property
    def has_results(self) -> bool:
        """Whether a measured or predicted outcome is there."""
        return bool(self.outcome or any(row.outcome for row in self.models.values()))


@dataclass(frozen=True)
class SpecimenRow:
    """One specimen: the restitution that predictions take, where it is from, and the block."""

    id: str
    restitution: str
    source: str
    rigid: str
    block: tuple[tuple[str, str], ...]
    method: str
    reason: str
    warnings: tuple[Message, ...]
    failures: tuple[Message, ...]
    tests: tuple[tuple[str, str, str], ...]
    chart: Markup | None


def of_test(campaign: Campaign, test: Test, results: Results) -> TestRow:
    """Put a test's results into words."""
    block = campaign.specimens[test.specimen].block(campaign.gravity)
    measured = results.text("rocking", "outcome")
    return TestRow(
        id=test.id,
        kind=test.kind,
        specimen=test.specimen,
        facts=_facts(test, results),
        status=results.status,
        failures=results.failures,
        warnings=results.warnings,
        outcome=measured,
        observed=test.observed_outcome or "",
        peak_ratio=_ratio(results, "rocking"),
        peak_ground_acceleration=wording.acceleration(results.value("rocking", "peak_ground_acceleration")),
        models={
            model: _model(results, model, measured or test.observed_outcome or "")
            for model in campaign.processing.predict.models
        },
        channels=tuple(_channel(name, attributes) for name, attributes in results.channels.items()),
        raw_files=results.raw_files,
        chart=charts.overlay(test, results, block),
    )


def of_specimen(campaign: Campaign, specimen: str, pooled: Results, tests: list[tuple[Test, Results]]) -> SpecimenRow:
    """Put a specimen's restitution into words; `tests` are its free vibrations with their results."""
    block = campaign.specimens[specimen].block(campaign.gravity)
    identified = [(test, results) for test, results in tests if "restitution" in results.datasets]
    drawn = [pair for pair in identified if pair[1].datasets["restitution"].sizes.get("peak", 0) > 0]
    source = pooled.text("specimen", "restitution_source")
    return SpecimenRow(
        id=specimen,
        restitution=_restitution(pooled, "specimen"),
        source=_SOURCES.get(source, "failed" if pooled.failures else "not yet known"),
        rigid=wording.number(block.restitution, 4),
        block=(
            ("critical angle α", wording.quantity(block.critical_angle, "rad", 4)),
            ("pole distance R", wording.quantity(block.pole_distance, "mm", 4)),
            ("inertia about the pole I₀", f"{wording.number(block.inertia, 4)} kg m²"),
            ("frequency parameter p", wording.quantity(block.p, "rad/s", 4)),
        ),
        method=pooled.text("specimen", "method"),
        reason=pooled.text("specimen", "reason"),
        warnings=pooled.warnings,
        failures=pooled.failures,
        tests=tuple(
            (test.id, _restitution(results, "restitution"), results.text("restitution", "reason"))
            for test, results in identified
        ),
        chart=charts.peaks(f"peaks-{specimen}", drawn, block) if drawn else None,
    )


def _facts(test: Test, results: Results) -> tuple[tuple[str, str], ...]:
    facts = [("kind", test.kind), ("specimen", test.specimen), ("setup", test.setup)]
    if test.motion:
        facts.append(("motion", test.motion))
    if test.span is not None:
        facts.append(("Span", str(test.span)))
    if test.time_scale is not None:
        facts.append(("time scale", wording.number(test.time_scale)))
    if test.frequency is not None:
        facts.append(("frequency", wording.quantity(test.frequency, "Hz")))
    for label, name, unit, digits in (
        ("time of the peak", "peak_time", "s", 3),
        ("standard error of θ", "rocking_angle_standard_error", "mrad", 2),
    ):
        text = wording.quantity(results.value("rocking", name), unit, digits)
        if text != wording.NOTHING:
            facts.append((label, text))
    strongest = wording.acceleration(results.value("rocking", "peak_ground_acceleration"))
    if strongest != wording.NOTHING:
        facts.append(("peak base acceleration", strongest))
    if results.text("rocking", "separation"):
        facts.append(("separation", results.text("rocking", "separation")))
    if test.notes:
        facts.append(("notes", test.notes))
    return tuple(facts)


def _model(results: Results, model: str, measured: str) -> ModelRow:
    stage = f"predict {model}"
    outcome = results.text(stage, "outcome")
    compared = results.datasets.get("compare")
    nrmse = nan
    if compared is not None and model in compared["model"].to_numpy():
        nrmse = float(compared["nrmse"].to_numpy()[list(compared["model"].to_numpy()).index(model)])
    return ModelRow(outcome, wording.agree(measured, outcome), _ratio(results, stage), wording.number(nrmse, 2))


def _ratio(results: Results, stage: str) -> str:
    return wording.number(results.value(stage, "peak_ratio"))


def _restitution(results: Results, stage: str) -> str:
    value = results.value(stage, "restitution")
    bounds = [results.value(stage, name) for name in ("restitution_low", "restitution_high", "level")]
    low, high, level = (nan if bound is None else bound for bound in bounds)
    return wording.interval(value, low, high, level)


def _channel(name: str, given: Mapping[str, Any]) -> ChannelRow:
    quantity = str(given.get("quantity", ""))
    unit = _CHANNEL_UNITS.get(quantity)

    def value(key: str, digits: int) -> str:
        amount = given.get(key)
        if amount is None or not isfinite(float(amount)):
            return wording.NOTHING
        return wording.quantity(float(amount), unit, digits) if unit else wording.number(float(amount), digits)

    cutoff, offset, error = (given.get(key) for key in ("cutoff_hz", "clock_offset", "clock_offset_standard_error"))
    clock = wording.NOTHING
    if offset is not None and float(offset) != 0.0:
        clock = f"{1e3 * float(offset):.2f} ms" + (f" ± {1e3 * float(error):.2f} ms" if error else "")
    return ChannelRow(
        name=name,
        quantity=quantity.replace("_", " "),
        zero=value("zero", 4),
        noise=value("noise", 2),
        cutoff=wording.NOTHING if cutoff is None else wording.quantity(float(cutoff), "Hz"),
        clock=clock,
        quality=str(given.get("quality_report", "")) or "good",
    )
