"""What the store holds of a test or a specimen: results, failures with their reasons, warnings, provenance."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.errors import StoreError
from colonnade.findings import Finding, at_stage, in_order
from colonnade.stages.peak import MeasuredPeak, known_peak
from colonnade.store import files
from colonnade.store.layout import Layout

if TYPE_CHECKING:
    import xarray as xr

STAGES = ("ingest", "condition", "rocking", "restitution", "predict", "ensemble", "compare")
GOOD = 1
"""Quality flag of a sample that nothing speaks against."""


@dataclass(frozen=True)
class Message:
    """
    A finding or a reason, and the stage that gave it.

    Attributes
    ----------
    stage, text : str
    severity, kind : str
        Of a finding; empty for a reason.
    explained : bool
        Whether it follows from a finding before it.
    """

    stage: str
    text: str
    severity: str = ""
    kind: str = ""
    explained: bool = False


@dataclass(frozen=True)
class Samples:
    """How many samples a channel has, its rate (Hz), and how many carry each flag but "good"."""

    count: int
    rate: float
    flagged: Mapping[int, int]


@dataclass(frozen=True)
class Results:
    """
    All that is stored of one test or specimen.

    Attributes
    ----------
    datasets : mapping of str to Dataset
        Results that are done, by stage; those of `predict` and `ensemble` by ``predict <model>``. Of `ingest` and
        `condition` the samples are not kept: a page of a hundred tests has to fit into memory.
    failures : tuple of Message
        In the order of the stages.
    warnings : tuple of Message
        The worst first, and behind its cause what follows from it.
    raw_files : tuple of (str, str)
        Name and SHA-256.
    versions : tuple of str
        Versions of colonnade that wrote these results.
    channels : mapping of str to mapping
        Attributes that `ingest` and `condition` gave each channel, by its id.
    samples : mapping of str to Samples
        Of each channel as recorded, by its id.
    settings : mapping of str to mapping
        What each stage read of the campaign, as stored with its result.
    keys : tuple of str
        Of each result, what identifies it: its key and the hash of its content.
    """

    datasets: Mapping[str, xr.Dataset]
    failures: tuple[Message, ...]
    warnings: tuple[Message, ...]
    raw_files: tuple[tuple[str, str], ...] = ()
    versions: tuple[str, ...] = ()
    channels: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    samples: Mapping[str, Samples] = field(default_factory=dict)
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    keys: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        """Give failed, done (the last stage is there) or pending."""
        if self.failures:
            return "failed"
        return "done" if "compare" in self.datasets else "pending"

    def value(self, stage: str, name: str) -> float | None:
        """Return a scalar result, None where it is not there."""
        dataset = self.datasets.get(stage)
        return float(dataset[name]) if dataset is not None and name in dataset and dataset[name].ndim == 0 else None

    def middle(self, stage: str, name: str) -> float | None:
        """Return a scalar result, of a series its median, None where it is not there or has no value."""
        dataset = self.datasets.get(stage)
        if dataset is None or name not in dataset:
            return None
        values = dataset[name].to_numpy()
        return float(np.nanmedian(values)) if np.isfinite(values).any() else None

    def of(self, stage: str, name: str, along: str) -> dict[str, Any]:
        """Return a result along a named dimension (model, transducer) by its names, empty where it is not there."""
        dataset = self.datasets.get(stage)
        if dataset is None or name not in dataset or dataset[name].dims != (along,) or along not in dataset.coords:
            return {}
        return dict(zip(map(str, dataset[along].to_numpy()), dataset[name].to_numpy().tolist(), strict=True))

    def measured_peak(self, test: Test) -> MeasuredPeak:
        """Return the measured peak that predictions are held against, NaN where it is not known."""
        rocking = self.datasets.get("rocking")
        if rocking is None:
            return MeasuredPeak()
        return known_peak(rocking, self.datasets.get("compare"), free_vibration=test.kind == "free-vibration")

    @property
    def driven_by(self) -> str:
        """Return the base motion that drives the predictions, empty if there is no prediction."""
        stages = (stage for stage in self.datasets if stage.startswith("predict "))
        return next((told for stage in stages if (told := self.text(stage, "driven_by"))), "")

    def text(self, stage: str, name: str) -> str:
        """Return a text attribute, empty where it is not there."""
        dataset = self.datasets.get(stage)
        return str(dataset.attrs.get(name, "")) if dataset is not None else ""

    def texts(self, stage: str, name: str) -> list[str]:
        """Return an attribute that is a list of text, empty where it is not there."""
        dataset = self.datasets.get(stage)
        return _listed(dataset.attrs.get(name)) if dataset is not None else []


NOTHING = Results({}, (), ())
"""Of a test that was never run, or whose results are not of this campaign any more."""


def of_test(campaign: Campaign, layout: Layout, test: Test) -> Results:
    """Read what is stored of a test; a damaged file counts as a failure of its stage."""
    return _gather(_files_of(campaign, layout, test), campaign.concerning(test.id))


def of_specimen(campaign: Campaign, layout: Layout, specimen: str) -> Results:
    """Read what is stored of a specimen: restitution as ``specimen``, the law of contact, if any, as ``contact``."""
    paths = {"specimen": layout.specimen(specimen)}
    if "contact" in campaign.processing.predict.models:
        paths["contact"] = layout.contact(specimen)
    return _gather(iter(paths.items()))


def _files_of(campaign: Campaign, layout: Layout, test: Test) -> Iterator[tuple[str, Path]]:
    for stage in STAGES:
        if stage in ("predict", "ensemble"):
            predict = campaign.processing.predict
            for model in predict.models:
                if stage == "predict" or predict.members(model) > 0:
                    yield f"{stage} {model}", layout.stage(test.id, stage, model)
        elif stage != "restitution" or test.kind == "free-vibration":
            yield stage, layout.stage(test.id, stage)


def _gather(paths: Iterator[tuple[str, Path]], concerning: Sequence[Finding] = ()) -> Results:
    datasets: dict[str, xr.Dataset] = {}
    failures: list[Message] = []
    warnings: list[Finding] = []
    raw: dict[str, str] = {}
    versions: dict[str, None] = {}
    channels: dict[str, dict[str, Any]] = {}
    samples: dict[str, Samples] = {}
    settings: dict[str, Mapping[str, Any]] = {}
    keys: list[str] = []
    for stage, path in paths:
        if not path.is_file():
            continue
        try:
            dataset = files.read(path)
        except StoreError as error:
            failures.append(Message(stage, str(error)))
            continue
        warnings += at_stage(dataset.attrs.get("warnings", []), stage)
        names, hashes = (_listed(dataset.attrs.get(name)) for name in ("raw_files", "raw_sha256"))
        raw |= dict(zip(names, hashes, strict=False))
        versions |= dict.fromkeys(
            [str(dataset.attrs["colonnade_version"])] if "colonnade_version" in dataset.attrs else []
        )
        keys += [f"{stage} {dataset.attrs.get('key')} {dataset.attrs.get('content')}"]
        settings[stage] = _read_settings(dataset.attrs.get("settings"))
        if dataset.attrs.get("status") == "failed":
            failures.append(Message(stage, str(dataset.attrs.get("reason") or "no reason was stored")))
        elif stage in ("ingest", "condition"):
            for variable in dataset.data_vars.values():
                name = variable.attrs.get("channel")
                if name is not None:
                    channels[name] = channels.get(name, {}) | variable.attrs
                    if stage == "ingest":
                        samples[name] = _samples(dataset, str(variable.name))
            datasets[stage] = dataset.drop_vars(list(dataset.variables))
        else:
            datasets[stage] = dataset
    return Results(
        datasets,
        tuple(failures),
        tuple(
            Message(each.stage, each.text, str(each.severity), each.kind, explained)
            for each, explained in in_order(warnings, concerning)
        ),
        tuple(raw.items()),
        tuple(versions),
        channels,
        samples,
        settings,
        tuple(keys),
    )


def _samples(recorded: xr.Dataset, variable: str) -> Samples:
    clock = str(recorded[variable].dims[0])
    interval = float(np.nanmedian(np.diff(recorded[clock].to_numpy()))) if recorded.sizes[clock] > 1 else np.nan
    flags = recorded.get(f"{variable}_quality")
    values = np.empty(0, np.int8) if flags is None else flags.to_numpy()
    flagged = {int(flag): int((values == flag).sum()) for flag in np.unique(values) if flag != GOOD}
    return Samples(recorded.sizes[clock], 1 / interval if interval > 0 else np.nan, flagged)


def _read_settings(stored: object) -> Mapping[str, Any]:
    try:
        settings = json.loads(str(stored))
    except ValueError:
        return {}
    return settings if isinstance(settings, dict) else {}


def _listed(attribute: object) -> list[str]:
    """Return a list of text that was stored as an attribute, empty where there is none."""
    if not attribute:
        return []
    return [str(item) for item in attribute] if isinstance(attribute, (list, tuple)) else [str(attribute)]
