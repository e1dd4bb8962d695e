"""The stored results of one test or specimen, read once: values, text, failures, findings and channels by name."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from math import nan
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError
from colonnade.findings import Finding, at_stage
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId, results_of

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps import StabilityMap, SteadyResponse

Made = tuple[str, str | None]
"""Stage that made a result and, if the stage runs once for each model, the model."""

GOOD = 1
"""Quality flag of a sample without fault."""

OUTDATED = "its results are missing or out of date; `colonnade run` makes them"
"""Why a test is pending that was not run to its end with the campaign as it is."""

WITHOUT_SAMPLES = ("ingest", "condition")
"""Stages whose samples are not kept in memory: a report of hundreds of tests has to fit."""


class Failure(NamedTuple):
    """Why a test or specimen failed, and the stage that failed, empty if no stage is to blame."""

    stage: str
    text: str


@dataclass(frozen=True)
class Samples:
    """How many samples a channel has, its rate (Hz), and how many carry each quality flag but "good"."""

    count: int
    rate: float
    flagged: Mapping[int, int]


@dataclass
class Stored:
    """
    All that is stored of one test or specimen.

    Attributes
    ----------
    datasets : mapping of (str, str or None) to Dataset
        Results that are done, by stage and model. Those of `ingest` and `condition` have no samples, unless they were
        asked for.
    failures : list of Failure
        In the order of the stages.
    findings : list of Finding
        As the stages gave them.
    raw_files : dict of str to str
        SHA-256 by name.
    versions : dict of str to None
        Versions of colonnade that wrote these results, in their order.
    channels : dict of str to dict
        Attributes that `ingest` and `condition` gave each channel, by its id.
    samples : dict of str to Samples
        Of each channel as recorded, by its id.
    settings : dict of (str, str or None) to mapping
        What each stage read of the campaign, as stored with its result.
    outdated : str
        That the stored results are out of date or not complete, and so not read; empty if they are.
    with_samples : bool
        Whether the samples of `ingest` and `condition` are kept.
    """

    datasets: dict[Made, xr.Dataset] = field(default_factory=dict)
    failures: list[Failure] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    raw_files: dict[str, str] = field(default_factory=dict)
    versions: dict[str, None] = field(default_factory=dict)
    channels: dict[str, dict[str, Any]] = field(default_factory=dict)
    samples: dict[str, Samples] = field(default_factory=dict)
    settings: dict[Made, Mapping[str, Any]] = field(default_factory=dict)
    outdated: str = ""
    with_samples: bool = False

    @property
    def status(self) -> Literal["done", "failed", "pending"]:
        """Give failed, done (the last stage is there) or pending."""
        return "failed" if self.failures else "done" if self.has("compare") else "pending"

    def has(self, stage: str, name: str | None = None, model: str | None = None) -> bool:
        """Return whether a stage has a result and, if a name is given, whether that holds it."""
        dataset = self.datasets.get((stage, model))
        return dataset is not None and (name is None or name in dataset)

    def models(self, stage: str) -> list[str]:
        """Return the models by which a stage has results, in the campaign's order."""
        return [model for known, model in self.datasets if known == stage and model is not None]

    def _of(self, stage: str, name: str, model: str | None = None) -> xr.DataArray | None:
        dataset = self.datasets.get((stage, model))
        return None if dataset is None else dataset.get(name)

    def value(self, stage: str, name: str, model: str | None = None) -> float:
        """Return a number, NaN if it is missing or not a scalar."""
        found = self._of(stage, name, model)
        return nan if found is None or found.ndim else float(found)

    def array(self, stage: str, name: str, model: str | None = None) -> Array:
        """Return the values of a variable, of length 0 if it is missing."""
        found = self._of(stage, name, model)
        return np.empty(0) if found is None else found.to_numpy()

    def median(self, stage: str, name: str) -> float:
        """Return a number, of a series its median; NaN if it is missing or has no value."""
        values = self.array(stage, name)
        return float(np.nanmedian(values)) if np.isfinite(values).any() else nan

    def by(self, along: str, stage: str, name: str) -> dict[str, Any]:
        """Return the values along a named dimension (model, transducer, estimator), empty if they are missing."""
        found = self._of(stage, name)
        if found is None or found.dims != (along,) or along not in found.coords:
            return {}
        return dict(zip(map(str, found[along].to_numpy()), found.to_numpy().tolist(), strict=True))

    def compared(self, name: str, model: str) -> float:
        """Return a number by which a model is compared with the measured angle, NaN if it is missing."""
        return float(self.by("model", "compare", name).get(model, nan))

    def text(self, stage: str, name: str, model: str | None = None) -> str:
        """Return a text attribute, empty if it is missing."""
        dataset = self.datasets.get((stage, model))
        return "" if dataset is None else str(dataset.attrs.get(name, ""))

    def texts(self, stage: str, name: str) -> list[str]:
        """Return an attribute that is a list of text, empty if it is missing."""
        dataset = self.datasets.get((stage, None))
        return [] if dataset is None else list(dataset.attrs.get(name, ()))

    def add(self, result: ResultId, path: Path) -> None:
        """Read one result; a damaged file counts as a failure of its stage."""
        name, made = str(result), (result.stage, result.model)
        try:
            dataset = files.read(path)
        except StoreError as error:
            self.failures.append(Failure(name, str(error)))
            return
        attributes = dataset.attrs
        self.findings += at_stage(attributes.get("warnings", []), name)
        self.raw_files |= dict(zip(*(attributes.get(key, ()) for key in ("raw_files", "raw_sha256")), strict=False))
        if "colonnade_version" in attributes:
            self.versions[str(attributes["colonnade_version"])] = None
        self.settings[made] = _settings(attributes.get("settings"))
        if attributes.get("status") == "failed":
            self.failures.append(Failure(name, str(attributes.get("reason") or "no reason was stored")))
            return
        if result.stage in WITHOUT_SAMPLES:
            self._add_channels(dataset, recorded=result.stage == "ingest")
            if not self.with_samples:
                dataset = dataset.drop_vars(list(dataset.variables))
        self.datasets[made] = dataset

    def _add_channels(self, dataset: xr.Dataset, *, recorded: bool) -> None:
        for name, variable in dataset.data_vars.items():
            channel = variable.attrs.get("channel")
            if channel is not None:
                self.channels[channel] = self.channels.get(channel, {}) | variable.attrs
                if recorded:
                    self.samples[channel] = _samples(dataset, str(name))


def read_test(
    campaign: Campaign,
    layout: Layout,
    test: Test,
    *,
    is_outdated: bool = False,
    failure: str | None = None,
    with_samples: bool = False,
) -> Stored:
    """
    Read what is stored of a test.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    test : Test
    is_outdated : bool, optional
        Whether the stored results are out of date or not complete: they are then not read.
    failure : str, optional
        Why it failed, if no result says so.
    with_samples : bool, optional
        Whether to keep the samples of all channels, as recorded and as conditioned.
    """
    stored = Stored(outdated=OUTDATED if is_outdated else "", with_samples=with_samples)
    return _read(stored, layout, [] if is_outdated else results_of(campaign, test), failure)


def read_specimen(campaign: Campaign, layout: Layout, specimen: str) -> Stored:
    """Read what is stored of a specimen: restitution as stage ``specimen``, a law of contact as ``contact``."""
    has_law = any(MODELS[model].in_space for model in campaign.processing.predict.models)
    stages = ("specimen", "contact") if has_law else ("specimen",)
    return _read(Stored(), layout, [ResultId(specimen, stage) for stage in stages])


def _read(stored: Stored, layout: Layout, results: Iterable[ResultId], failure: str | None = None) -> Stored:
    for result in results:
        path = layout.path(result)
        if path.is_file():
            stored.add(result, path)
    if failure and not stored.failures:
        stored.failures.append(Failure("", failure))
    return stored


def _samples(recorded: xr.Dataset, variable: str) -> Samples:
    clock = str(recorded[variable].dims[0])
    interval = float(np.nanmedian(np.diff(recorded[clock].to_numpy()))) if recorded.sizes[clock] > 1 else nan
    flags, counts = np.unique(recorded.get(f"{variable}_quality", np.empty(0, np.int8)), return_counts=True)
    flagged = {int(flag): int(count) for flag, count in zip(flags, counts, strict=True) if flag != GOOD}
    return Samples(recorded.sizes[clock], 1 / interval if interval > 0 else nan, flagged)


def _settings(stored: object) -> Mapping[str, Any]:
    try:
        settings = json.loads(str(stored))
    except ValueError:
        return {}
    return settings if isinstance(settings, dict) else {}


_AXES = ("frequency_ratio", "amplitude_ratio")

_OVER = {
    **dict.fromkeys(("outcome", "overturning_fraction", "order", "amplitude"), _AXES),
    **dict.fromkeys(("no_rocking", "lower", "upper"), "frequency_ratio"),
    **dict.fromkeys(("interval_frequency_ratio", "interval_start", "interval_end"), "interval"),
}
"""Fields of maps and steady responses with the dimensions that each is stored over."""

_NAMES = {
    **{name: f"{name}_limit" for name in ("no_rocking", "lower", "upper")},
    "order": "steady_order",
    "amplitude": "steady_peak_ratio",
}
"""Fields that are stored under another name."""


def as_dataset(found: Mapping[str, Any], options: Mapping[str, Any]) -> xr.Dataset:
    """Return the fields of a map or of steady responses in their stored form, the options as attributes."""
    import xarray as xr

    variables = {_NAMES.get(name, name): (over, found[name]) for name, over in _OVER.items() if name in found}
    return xr.Dataset(variables, {name: found[name] for name in _AXES}, options)


def as_map(stored: xr.Dataset) -> StabilityMap:
    """Return a stored map as the library gives it."""
    from colonnade.dynamics.maps import StabilityMap

    return StabilityMap(**_fields(stored), options=json.loads(stored.attrs["settings"]))


def as_response(stored: xr.Dataset) -> SteadyResponse:
    """Return stored responses as the library gives them."""
    from colonnade.dynamics.maps import SteadyResponse

    return SteadyResponse(**_fields(stored))


def _fields(stored: xr.Dataset) -> dict[str, Any]:
    names = {name: _NAMES.get(name, name) for name in (*_OVER, *_AXES)}
    return {name: stored[kept].to_numpy() for name, kept in names.items() if kept in stored}
