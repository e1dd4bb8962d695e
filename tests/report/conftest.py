"""A campaign with everything that a report meets, its results made up from the model and written by the real store."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.signal import butter, sosfiltfilt

from colonnade.campaign import Campaign, load
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import global_attributes
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.summary import write_summary

SCRIPT = "<script>alert('title')</script>"
MARKUP = '<img src=x onerror="alert(1)"> & 5 < 6'
DEAD = (
    "channel <top>: the largest value is 0.2 % of its range.\nA living channel was expected; is the sensor plugged in?"
)
INTERVAL = 0.005
ESTIMATORS = ("peaks", "half-periods", "impact-by-impact", "history-linear", "history-nonlinear")
REGION = {
    "restitution": 0.9762,
    "critical_angle": 1.004,
    "restitution_error": 2e-4,
    "critical_angle_error": 2e-3,
    "correlation": 0.9,
}

CAMPAIGN = f"""
schema = 1
campaign = "prism-2013"
title = "Rocking of a solid steel prism {SCRIPT}"
facility = "Earthquake Simulator, Aristotle University"

[specimens.prism]
shape = "prism"
width = "86 mm"
depth = "86 mm"
height = "456 mm"
mass = "26.10 kg"
scale = 20

[specimens.statue]
shape = "measured"
mass = "80 kg"
pole_distance = "610 mm"
critical_angle = ["0.21 rad", "0.23 rad"]
inertia = "41.2 kg m^2"
restitution = 0.9

[setups.frame.channels.top]
column = "LVDT 1"
quantity = "displacement"
unit = "mm"
on = "specimen"
at = ["43 mm", "0 mm", "440 mm"]
direction = [1, 0, 0]
relative_to = "table"

[setups.frame.channels.table_acceleration]
column = "ACC"
quantity = "acceleration"
unit = "g"
on = "table"
direction = [1, 0, 0]

[processing]
lowpass = "25 Hz"
"""
FREE = ("free-01", "free-02", "free-refused")
SPANS = {"span-2.0": 2.0, "span-2.5": 2.5, "span-3.0": 3.0}


def _tests() -> str:
    rows = [{"id": name, "kind": "free-vibration"} for name in FREE]
    rows += [
        {"id": name, "kind": "earthquake", "span": span, "motion": f"El Centro 1940 NS {MARKUP}", "time_scale": 0.2236}
        for name, span in SPANS.items()
    ]
    rows += [
        {"id": "sine-3hz-too-strong-for-the-block-1", "kind": "sine", "frequency": "3 Hz", "notes": MARKUP},
        {"id": "sine-dead", "kind": "sine", "frequency": "3 Hz"},
        {"id": "later", "kind": "sine", "frequency": "4 Hz"},
        {"id": "watched", "kind": "earthquake", "specimen": "statue", "observed_outcome": "not-overturned"},
    ]
    text = ""
    for row in rows:
        entry = {"specimen": "prism", "setup": "frame", "file": f"raw/{row['id']}.csv"} | row
        written = [repr(value) if isinstance(value, str) else str(value) for value in entry.values()]
        text += "\n[[tests]]\n"
        text += "".join(f"{name} = {value}\n" for name, value in zip(entry, written, strict=True))
    return text


SETTINGS = {
    "ingest": {"settings": {"spike_threshold": 8.0, "flat_duration": 0.5, "gap": 1.5, "jitter": 0.05}},
    "condition": {"channels": {"top": {"on": "specimen"}}, "zero": "auto",
                  "settings": {"lowpass": 25.0, "base_lowpass": "auto", "filter_order": 4, "rest_duration": 0.5,
                               "longest_offset": 1.0}},
    "restitution": {"settings": {"lowest_amplitude": 0.02, "level": 0.95}},
    "predict": {"rest_angle": 1e-6},
}  # fmt: skip


def _attributes(stage: str, subject: str) -> dict[str, str]:
    inputs = json.loads(json.dumps(SETTINGS.get(stage, {})))
    if stage == "condition" and subject == "span-3.0":
        inputs["settings"]["filter_order"] = 2
    return {"settings": json.dumps(inputs)} | global_attributes(
        campaign="prism-2013", title="Prism", facility=None, stage=stage, test=subject
    )


def _write(dataset: xr.Dataset, path: Path, stage: str, subject: str, warnings: list[str] | None = None) -> None:
    dataset.attrs["warnings"] = warnings or []
    files.write(dataset, path, attributes=_attributes(stage, subject))


def _earthquake(strength: float) -> np.ndarray[Any, Any]:
    time = np.arange(1600) * INTERVAL
    noise = np.random.default_rng(7).normal(size=time.size)
    shaking = sosfiltfilt(butter(2, [1, 8], "bandpass", fs=200, output="sos"), noise)
    shaking *= np.clip((time - 0.5) / 1.0, 0, 1) * np.exp(-np.clip(time - 3, 0, None) / 1.5)
    return strength * shaking / np.abs(shaking).max()


def _rocking(history: Any, base: np.ndarray[Any, Any] | None, noise: float, seed: int) -> xr.Dataset:
    angle = history.angle + np.random.default_rng(seed).normal(0, noise, history.angle.size)
    angle = np.clip(angle, -0.3, 0.3)
    values: dict[str, Any] = {
        "rocking_angle": ("elapsed", angle),
        "rocking_angle_quality": ("elapsed", np.ones(angle.size, np.int8)),
        "rocking_angle_standard_error": ((), noise),
        "noise_threshold": ((), 6 * noise),
        "impact_time": ("impact", history.impact_times),
        "peak_angle": ((), float(np.abs(angle).max())),
        "peak_ratio": ((), np.nan if history.peak_ratio is None else history.peak_ratio),
        "peak_time": ((), history.peak_time),
        "overturning_time": ((), history.overturning_time),
        "peak_ground_acceleration": ((), np.nan if base is None else float(np.abs(base).max())),
    }
    if base is not None:
        values["base_acceleration"] = ("elapsed", base)
        values["slide"] = ("elapsed", 1e-5 * np.arange(angle.size) / angle.size)
        values["slide_standard_error"] = ((), 2e-6)
        values["residual_to_noise"] = ("transducer", [1.2])
        values["residual_to_reading"] = ("transducer", [0.013])
    return xr.Dataset(
        values,
        coords={"elapsed": history.time, "transducer": ("transducer", np.array(["top"], dtype=object))},
        attrs={"outcome": history.outcome, "separation": "one transducer: rotation alone, the slide is taken as nil"},
    )


def _predictions(block: Block, base: np.ndarray[Any, Any] | None, source: str, **given: Any) -> dict[str, xr.Dataset]:
    motion = None if base is None else Motion(base * given.pop("stronger", 1.0), INTERVAL)
    return {
        model: _predicted(rock(block, motion, model=model, **given), base, source, model)
        for model in ("linear", "nonlinear")
    }


def _predicted(history: Any, base: np.ndarray[Any, Any] | None, source: str, model: str) -> xr.Dataset:
    return xr.Dataset(
        {
            "rocking_angle": ("elapsed", history.angle),
            "base_acceleration": ("elapsed", np.zeros(history.time.size) if base is None else base),
            "impact_time": ("impact", history.impact_times),
            "restitution": ((), 0.976),
            "peak_angle": ((), float(np.abs(history.angle).max())),
            "peak_ratio": ((), np.nan if history.peak_ratio is None else history.peak_ratio),
            "peak_time": ((), history.peak_time),
            "overturning_time": ((), history.overturning_time),
            "impact_count": ((), history.impact_times.size),
        },
        coords={"elapsed": history.time},
        attrs={"outcome": history.outcome, "model": model, "restitution_source": source},
    )


def _compared(measured: xr.Dataset, predicted: dict[str, xr.Dataset], nrmse: float, order: str) -> xr.Dataset:
    models = list(predicted)
    ratios = [float(each["peak_ratio"]) for each in predicted.values()]
    outcomes = [each.attrs["outcome"] for each in predicted.values()]
    values: dict[str, Any] = {
        "nrmse": ("model", [nrmse, nrmse / 2]),
        "compared_until": ("model", [5.0, 5.0]),
        "predicted_peak_ratio": ("model", ratios),
        "peak_ratio_error": ("model", [0.01, -0.02]),
        "predicted_outcome": ("model", np.array(outcomes, dtype=object)),
        "measured_peak_ratio": ((), float(measured["peak_ratio"]) if "peak_ratio" in measured else np.nan),
        "measured_peak_time": ((), float(measured["peak_time"]) if "peak_time" in measured else np.nan),
        "release_ratio": ((), np.nan),
        "zero_offset": ((), 0.0),
    }
    if order:
        values |= {
            "forcing_frequency": ((), 3.001),
            "frequency_ratio": ((), 3.348),
            "amplitude_ratio": ((), 3.784),
            "predicted_response_order": ("model", np.array(["1", order], dtype=object)),
        }
    attributes = {"outcome_measured": measured.attrs["outcome"], "response_order": order}
    return xr.Dataset(values, coords={"model": ("model", np.array(models, dtype=object))}, attrs=attributes)


def _recorded(name: str) -> xr.Dataset:
    top = {"channel": "top", "quantity": "displacement", "column": "LVDT <1>", "recorded_unit": "mm"}
    top["quality_report"] = "3 samples are spikes, the first at 1.204 s"
    flags, values = np.array([1, 1, 1, 4, 4, 1, 1, 1, 1, 1], np.int8), np.arange(10.0)
    return xr.Dataset(
        {
            "top": ("elapsed", values, top),
            "top_recorded": ("elapsed", values),
            "top_quality": ("elapsed", flags),
        },
        coords={"elapsed": values},
        attrs={
            "raw_files": [f"raw/{name}.csv"],
            "raw_sha256": [sha256(name.encode()).hexdigest()],
            "notes": f"{name}.csv: delimiter <;>; {name}.csv: names on line 1",
            "review": [f"2013-04-26, N. N.: top flagged: {MARKUP}"] if name == "span-2.5" else [],
        },
    )  # fmt: skip


def _conditioned() -> xr.Dataset:
    values = np.arange(10.0)
    top = {"channel": "top", "quantity": "displacement", "zero": 0.00123, "noise": 2.1e-5, "cutoff_hz": 25.0}
    table = {"channel": "table_acceleration", "quantity": "acceleration", "zero": 0.02, "noise": 0.004}
    table |= {"cutoff_hz": 40.0, "clock_offset": 0.0201, "clock_offset_standard_error": 0.0002}
    return xr.Dataset(
        {"top": ("elapsed", values, top), "table_acceleration": ("elapsed", values, table)}, coords={"elapsed": values}
    )


def _estimates(found: Any, refused: bool) -> dict[str, Any]:
    error = found.standard_error * np.array([1.0, 3.0, 1.2, 0.3, 0.3])
    value = np.full(5, np.nan) if refused else found.value + error * np.array([0.5, -1.0, 0.3, 4.0, 0.0])
    columns = {"estimate": value, "estimate_low": value - 2 * error, "estimate_high": value + 2 * error}
    return {name: ("estimator", values) for name, values in columns.items()}


def _impacts(found: Any) -> dict[str, Any]:
    count = max(found.peaks.time.size - 1, 0)
    velocity = np.linspace(1.0, 0.2, count)
    columns = {
        "impact_velocity": velocity,
        "impact_restitution": 0.976 + 1e-3 * np.sin(np.arange(count)) / velocity,
        "impact_restitution_standard_error": 1e-3 / velocity,
        "impact_used": np.ones(count, np.int8),
    }
    return {name: ("impact", values) for name, values in columns.items()}


def _fitted(truth: Any, measured: xr.Dataset) -> dict[str, Any]:
    part = (truth.time > 0.5) & (truth.time < 6)
    residual = measured["rocking_angle"].to_numpy() - truth.angle
    return {
        "fitted_elapsed": ("fitted_elapsed", truth.time[part]),
        "fitted_history": ("fitted_elapsed", truth.angle[part]),
        "history_residual": ("fitted_elapsed", residual[part]),
        **{f"region_{name}": ((), value) for name, value in REGION.items()},
    }


def _fill(campaign: Campaign, layout: Layout) -> None:
    block = campaign.specimens["prism"].block(campaign.gravity)
    for seed, name in enumerate(FREE):
        start = {"theta0": 0.5 * block.critical_angle, "duration": 8.0}
        truth = rock(block, restitution=0.976, **start)
        measured = _rocking(truth, None, 3e-4, seed)
        _test(layout, name, measured, _predictions(block, None, "identified", restitution=0.974, **start), 0.012)
        found = identify_restitution(truth.time, measured["rocking_angle"].to_numpy(), block, noise=3e-4)
        refused = name == "free-refused"
        used = np.zeros(found.peaks.used.size, np.int8) if refused else found.peaks.used.astype(np.int8)
        identified = xr.Dataset(
            {
                "restitution": ((), np.nan if refused else found.value),
                "restitution_low": ((), np.nan if refused else found.low),
                "restitution_high": ((), np.nan if refused else found.high),
                "restitution_standard_error": ((), np.nan if refused else found.standard_error),
                "level": ((), 0.95),
                "zero_offset": ((), 0.0),
                "peak_time": ("peak", found.peaks.time),
                "peak_angle": ("peak", found.peaks.angle),
                "peak_angle_standard_error": ("peak", found.peaks.standard_error),
                "fitted_angle": ("peak", found.peaks.fitted_angle * (np.nan if refused else 1.0)),
                "peak_used": ("peak", used),
                **_estimates(found, refused),
                **_impacts(found),
                **({} if refused else _fitted(truth, measured)),
            },
            coords={"estimator": ("estimator", np.array(ESTIMATORS, dtype=object))},
            attrs={
                "method": found.method,
                "reason": f"The peaks do not decay. {MARKUP}" if refused else "",
                "recommended": "" if refused else "history-nonlinear",
                "estimate_assumptions": [f"what {each} assumes" for each in ESTIMATORS],
                "estimate_reasons": ["too few impacts" if refused else ""] * len(ESTIMATORS),
                "history_model": "nonlinear",
                "departures": [f"The block slides at 3 of 9 impacts. {MARKUP}"] if name == "free-02" else [],
            },
        )
        _write(identified, layout.stage(name, "restitution"), "restitution", name)
    for seed, (name, span) in enumerate(SPANS.items()):
        base = _earthquake(1.35 * span)
        measured = _rocking(rock(block, Motion(base, INTERVAL), restitution=0.976), base, 3e-4, seed)
        predicted = _predictions(block, base, "identified", restitution=0.974, stronger=2.0 if span == 3.0 else 1.004)
        _test(layout, name, measured, predicted, 0.031, [f"3 spikes bridged. {MARKUP}"])
    time = np.arange(1600) * INTERVAL
    base = 7.0 * np.sin(2 * np.pi * 3 * time) * np.clip(time / 2, 0, 1)
    strong = "sine-3hz-too-strong-for-the-block-1"
    measured = _rocking(rock(block, Motion(base, INTERVAL), restitution=0.976), base, 3e-4, 9)
    _test(layout, strong, measured, _predictions(block, base, "identified", restitution=0.976), 0.004, order="3")
    path = layout.stage("sine-dead", "condition")
    _write(_recorded("sine-dead"), layout.stage("sine-dead", "ingest"), "ingest", "sine-dead")
    files.write_failed(path, DEAD, attributes=_attributes("condition", "sine-dead"))

    statue = campaign.specimens["statue"].block(campaign.gravity)
    base = _earthquake(2.0)
    seen = xr.Dataset(
        {"base_acceleration": ("elapsed", base), "peak_ground_acceleration": ((), float(np.abs(base).max()))},
        coords={"elapsed": time},
        attrs={"outcome": "", "separation": "no displacement transducer on the specimen"},
    )
    _test(
        layout,
        "watched",
        seen,
        _predictions(statue, base, "given", restitution=0.9),
        np.nan,
    )
    _specimens(campaign, layout)


def _test(
    layout: Layout,
    name: str,
    measured: xr.Dataset,
    predicted: dict[str, xr.Dataset],
    nrmse: float,
    warnings: list[str] | None = None,
    order: str = "",
) -> None:
    _write(_recorded(name), layout.stage(name, "ingest"), "ingest", name, warnings)
    _write(_conditioned(), layout.stage(name, "condition"), "condition", name)
    _write(measured, layout.stage(name, "rocking"), "rocking", name)
    for model, each in predicted.items():
        _write(each, layout.stage(name, "predict", model), "predict", name)
    _write(_compared(measured, predicted, nrmse, order), layout.stage(name, "compare"), "compare", name)


def _specimens(campaign: Campaign, layout: Layout) -> None:
    for name, source, value, low, high in (
        ("prism", "identified", 0.97608, 0.97528, 0.97688),
        ("statue", "given", 0.9, np.nan, np.nan),
    ):
        block = campaign.specimens[name].block(campaign.gravity)
        _write(
            xr.Dataset(
                {
                    "restitution": ((), value),
                    "restitution_low": ((), low),
                    "restitution_high": ((), high),
                    "level": ((), 0.95),
                    "rigid_restitution": ((), block.restitution),
                    "between_test_scatter": ((), 4e-4 if source == "identified" else np.nan),
                    "test_restitution_standard_error": ("test", [3e-4, 4e-4] if source == "identified" else []),
                },
                attrs={
                    "restitution_source": source,
                    "method": "peaks; random effects",
                    "reason": "",
                },
            ),
            layout.stage(name, "specimen"),
            "specimen",
            name,
        )


@pytest.fixture(scope="session")
def empty_campaign(tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, Layout]:
    """The campaign before anything was run."""
    folder = tmp_path_factory.mktemp("empty")
    (folder / "campaign.toml").write_text(CAMPAIGN + _tests(), encoding="utf-8")
    return load(folder), Layout(folder)


@pytest.fixture(scope="session")
def filled_campaign(tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, Layout]:
    """The campaign with results: done, refused, overturned, failed, never run, seen but not measured."""
    folder = tmp_path_factory.mktemp("filled")
    (folder / "campaign.toml").write_text(CAMPAIGN + _tests(), encoding="utf-8")
    campaign, layout = load(folder), Layout(folder)
    _fill(campaign, layout)
    write_summary(campaign, layout, Catalogue(layout))
    return campaign, layout
