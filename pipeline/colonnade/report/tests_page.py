"""The page of one test: what was done, what was found, what each model says, and how the channels were treated."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np
from markupsafe import Markup

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.similitude import at_prototype
from colonnade.figures import EstimateGroup
from colonnade.identification.verdict import FEWEST, is_within
from colonnade.report import channels, charts, restitution, restitution_charts, wording
from colonnade.report.channels import ChannelRow
from colonnade.report.restitution import EstimateText
from colonnade.report.results import Results
from colonnade.report.rows import TestRow

Fact = tuple[str, str]

MOTIONS = (
    ("slide", "slide", "mm"),
    ("uplift", "uplift", "mm"),
    ("transverse_slide", "transverse slide", "mm"),
    ("out_of_plane_angle", "out-of-plane angle", "mrad"),
    ("yaw", "yaw", "mrad"),
)
"""Motions of the specimen beside its rocking angle: variable, words, unit."""


@dataclass(frozen=True)
class Metrics:
    """A model's response beside the measured one; text for the page."""

    model: str
    outcome: str
    agrees: bool | None
    peak_ratio: str
    peak_time: str
    peak_error: str
    nrmse: str
    until: str
    horizon: str
    impacts: str
    restitution: str
    order: str
    verdict: str


@dataclass(frozen=True)
class PeakRow:
    """One peak of a free vibration: number, time, angle with its standard error, fitted angle, whether it was used."""

    number: int
    time: str
    angle: str
    error: str
    fitted: str
    used: bool


@dataclass(frozen=True)
class TestPage:
    """Everything that the page of a test shows; text, tables and figures."""

    __test__ = False  # pytest takes a class of this name for a test

    row: TestRow
    peak_time: str
    impacts: str
    done: tuple[Fact, ...]
    found: tuple[Fact, ...]
    metrics: tuple[Metrics, ...]
    restitution: tuple[Fact, ...]
    estimates: tuple[EstimateText, ...]
    departures: tuple[str, ...]
    peaks: tuple[PeakRow, ...]
    channels: tuple[ChannelRow, ...]
    raw_files: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]
    review: tuple[str, ...]
    chart: Markup | None
    bands: Markup | None
    restitution_charts: RestitutionCharts


@dataclass(frozen=True)
class RestitutionCharts:
    """Pictures of a free vibration's restitution, each None where there is nothing to draw."""

    fitted: Markup | None
    estimators: Markup | None
    peaks: Markup | None
    impacts: Markup | None
    region: Markup | None


def of_test(campaign: Campaign, test: Test, results: Results, row: TestRow) -> TestPage:
    """Put all that is stored of a test into words and figures."""
    block = campaign.block(test.specimen)
    rocking = results.datasets.get("rocking")
    peak = results.measured_peak(test)
    has_angle = rocking is not None and "rocking_angle" in rocking
    return TestPage(
        row=row,
        peak_time=wording.quantity(peak.time, "s"),
        impacts=str(rocking.sizes.get("impact", 0)) if rocking is not None and has_angle else wording.NOTHING,
        done=_done(test, row),
        found=_found(test, results, row, campaign.specimens[test.specimen].scale),
        metrics=tuple(_metrics(results, model, row) for model in row.models if row.models[model].outcome),
        restitution=restitution.facts_of(results),
        estimates=restitution.estimates_of(results),
        departures=restitution.departures_of(results),
        peaks=_peaks(results),
        channels=channels.of_test(results),
        raw_files=results.raw_files,
        notes=tuple(filter(None, results.text("ingest", "notes").split("; "))),
        review=tuple(results.texts("ingest", "review")) or campaign.review(test.id).told,
        chart=charts.record(test, results, block),
        bands=charts.bands(test, results, block),
        restitution_charts=_restitution_charts(test, results, block),
    )


def _restitution_charts(test: Test, results: Results, block: Block) -> RestitutionCharts:
    peaks = restitution_charts.peak_series(test, results, block)
    impacts = restitution_charts.impact_series(test, results)
    estimates = EstimateGroup("", restitution.estimate_rows(results))
    rigid = block.restitution
    return RestitutionCharts(
        fitted=restitution_charts.fitted(test, results, block),
        estimators=restitution_charts.estimators(f"estimators-{test.id}", [estimates], rigid),
        peaks=None if peaks is None else restitution_charts.peaks(f"peaks-{test.id}", [peaks], block),
        impacts=None
        if impacts is None
        else restitution_charts.impacts(f"impacts-{test.id}", [impacts], results, restitution.STAGE, rigid),
        region=restitution_charts.region(test, results),
    )


def _done(test: Test, row: TestRow) -> tuple[Fact, ...]:
    facts = [("setup", test.setup)]
    if test.motion:
        facts.append(("motion", test.motion))
    if test.span is not None:
        facts.append(("Span", str(test.span)))
    if test.time_scale is not None:
        facts.append(("time scale", wording.number(test.time_scale)))
    if test.frequency is not None:
        facts.append(("frequency", wording.quantity(test.frequency, "Hz")))
    if np.isfinite(row.frequency_ratio):
        facts.append(("Ω = ω/p", wording.number(row.frequency_ratio, 4)))
    if np.isfinite(row.amplitude_ratio):
        facts.append(("A = a/(g tan α)", wording.number(row.amplitude_ratio, 4)))
    facts.append(("part of the file", _interval(test.window) or "all of it"))
    facts.append(("zero taken", _interval(test.zero) if isinstance(test.zero, tuple) else test.zero))
    if test.notes:
        facts.append(("notes", test.notes))
    return tuple(facts)


def _found(test: Test, results: Results, row: TestRow, scale: float | None) -> tuple[Fact, ...]:
    is_free = test.kind == "free-vibration"
    largest = "largest |θ|, with the release" if is_free else "largest |θ|"
    facts: list[Fact] = [
        (largest, wording.quantity(_magnitude(results.value("rocking", "peak_angle")), "mrad", 4)),
        ("released from |θ|/α", wording.number(results.measured_peak(test).release)),
        ("predictions are driven by", results.driven_by if is_free else ""),
        ("overturned at", wording.quantity(results.value("rocking", "overturning_time"), "s", 4)),
        ("peak base acceleration", row.peak_ground_acceleration),
        ("standard error of θ", wording.quantity(results.middle("rocking", "rocking_angle_standard_error"), "mrad", 2)),
        *_other_motions(results),
        ("told from noise above", wording.quantity(results.value("rocking", "noise_threshold"), "mrad", 2)),
        ("transducers give", results.text("rocking", "separation")),
        ("order of the response", row.order or results.text("compare", "response_order_reason")),
        (f"at prototype scale, 1:{scale:g}" if scale else "", _at_prototype(results, row, scale) if scale else ""),
    ]
    return tuple((label, text) for label, text in facts if text not in ("", wording.NOTHING))


def _metrics(results: Results, model: str, row: TestRow) -> Metrics:
    stage = f"predict {model}"
    e, source = results.value(stage, "restitution"), results.text(stage, "restitution_source")

    def compared(name: str) -> float:
        return float(results.of("compare", name, "model").get(model, nan))

    order = wording.order(results.of("compare", "predicted_response_order", "model").get(model, ""))
    return Metrics(
        model=model,
        outcome=row.models[model].outcome,
        agrees=row.models[model].agrees,
        peak_ratio=row.models[model].peak_ratio,
        peak_time=wording.quantity(results.value(stage, "peak_time"), "s"),
        peak_error=_signed(compared("peak_ratio_error")),
        nrmse=row.models[model].nrmse,
        until=wording.quantity(compared("compared_until"), "s", 4),
        horizon=wording.quantity(compared("horizon"), "s", 4) if np.isfinite(compared("horizon")) else "not known",
        impacts=wording.number(results.value(stage, "impact_count"), 9),
        restitution=f"{wording.number(e, 4)} ({source})" if source else wording.number(e, 4),
        order=order or wording.NOTHING,
        verdict=verdict_sentence(
            model, *map(compared, ("horizon", "within_spread", "peak_rank", "overturning_probability"))
        ),
    )


def verdict_sentence(model: str, horizon: float, rank: float, peak_rank: float, overturning: float) -> str:
    """Say whether the measured angle is within the model's own spread, up to its horizon."""
    if np.isnan(horizon):
        return ""
    name, until, verdict = f"{model.capitalize()} model", wording.quantity(horizon, "s", 4), is_within(rank)
    if verdict is None:
        return f"{name}: predicted up to {until}; not ranked, as that takes {FEWEST} runs and a measured angle."
    said = [
        f"{rank:.0%} of the runs are closer to their median",
        f"{peak_rank:.0%} of them stay below its peak",
        *([f"{overturning:.0%} of them overturn"] if overturning > 0 else []),
    ]
    where = "within" if verdict else "outside"
    return f"{name}: the measured angle is {where} its own spread up to {until} ({'; '.join(said)})."


def _peaks(results: Results) -> tuple[PeakRow, ...]:
    found = results.datasets.get("restitution")
    if found is None or not found.sizes.get("peak", 0):
        return ()
    columns = ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
    table = zip(*(found[name].to_numpy().tolist() for name in columns), strict=True)
    return tuple(
        PeakRow(
            number,
            wording.quantity(time, "s", 4),
            wording.quantity(angle, "mrad", 4),
            wording.quantity(error, "mrad", 2),
            wording.quantity(fitted, "mrad", 4),
            used == 1,
        )
        for number, (time, angle, error, fitted, used) in enumerate(table, start=1)
    )


def _interval(given: tuple[float, float] | None) -> str:
    return f"{given[0]:g} s to {given[1]:g} s" if given is not None else ""


def _other_motions(results: Results) -> list[Fact]:
    """Give the largest of each motion beside the rocking angle, with its standard error."""
    facts = []
    for name, words, unit in MOTIONS:
        if (largest := _largest(results, name)) is not None:
            error = wording.quantity(results.middle("rocking", f"{name}_standard_error"), unit, 2)
            facts.append((f"largest {words}", f"{wording.quantity(largest, unit, 3)}, standard error {error}"))
    return facts


def _largest(results: Results, name: str) -> float | None:
    """Largest magnitude of a motion up to the fall, None where it was not measured."""
    rocking = results.datasets.get("rocking")
    if rocking is None or name not in rocking:
        return None
    fall = results.value("rocking", "overturning_time")
    time, values = rocking["elapsed"].to_numpy(), np.abs(rocking[name].to_numpy())
    standing = np.isfinite(values) & (time <= (fall if fall is not None and np.isfinite(fall) else np.inf))
    return float(values[standing].max()) if standing.any() else None


def _at_prototype(results: Results, row: TestRow, scale: float) -> str:
    """Say what the test means for the specimen that the model stands for."""
    rocking = results.datasets.get("rocking")
    if rocking is None:
        return ""
    time = rocking["elapsed"].to_numpy()
    parts = [
        (name, wording.quantity(at_prototype(quantity, value, scale), unit))
        for name, quantity, value, unit in (
            ("duration", "time", float(time[-1] - time[0]), "s"),
            ("frequency", "frequency", row.frequency, "Hz"),
            ("largest slide", "length", _largest(results, "slide"), "mm"),
            ("largest base displacement", "length", _largest(results, "base_displacement"), "mm"),
        )
        if value is not None and np.isfinite(value)
    ]
    return ", ".join(f"{name} {text}" for name, text in parts)


def _magnitude(value: float | None) -> float | None:
    return None if value is None else abs(value)


def _signed(value: float) -> str:
    return f"{value:+.2g}" if np.isfinite(value) else wording.NOTHING
