"""The graph of results: what each result reads, its file, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.dynamics.models.registry import MODELS
from colonnade.store.forecasts import Known
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId, models_of
from colonnade.workflow.catalogue import Catalogue

if TYPE_CHECKING:
    import xarray as xr
    from pydantic import BaseModel

COMPARED = {"predict": "predicted", "ensemble": "ensembles"}
"""Stages whose results `compare` takes by model, and the name of the argument."""

FORMATS = "colonnade.readers"
"""The readers: formats are loaded by name, so that no import of a stage shows that they are used."""

_STORED_BY = ("colonnade.store.description", "colonnade.store.description", __name__)
"""Modules that take part in every result."""


@dataclass(frozen=True)
class Step:
    """
    What is needed to make one result.

    Attributes
    ----------
    result : ResultId
    path : Path
        File of the result.
    upstream : dict of str to Path
        Results that it reads, by name; for ingest, raw files by recorder.
    inputs : BaseModel
        The stage's own model of what it reads of the campaign.
    work : callable
        Takes the upstream results (for ingest, the raw paths) by name and the inputs; returns the result.
    code : str
        Hash of the code that makes it.
    given : mapping of str to str, optional
        Hashes of what it is made from besides results: for a map, its block, axes and motion.
    """

    result: ResultId
    path: Path
    upstream: dict[str, Path]
    inputs: BaseModel
    work: Callable[[Mapping[str, Any], Any], xr.Dataset]
    code: str
    given: Mapping[str, str | None] = field(default_factory=dict)

    @property
    def is_from_raw(self) -> bool:
        """Whether it reads raw files rather than results."""
        return self.result.stage == "ingest"


@dataclass(frozen=True)
class Graph:
    """
    The steps of a campaign.

    Attributes
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Gives the hash of the code.
    """

    campaign: Campaign
    layout: Layout
    catalogue: Catalogue

    def measuring(self, test: Test) -> list[Step]:
        """Return the steps from the raw files of a test to what was measured."""
        from colonnade.stages import condition, ingest, restitution, rocking

        steps = [
            self._step(
                ResultId(test.id, "ingest"),
                test.files,
                ingest.IngestInputs.of(self.campaign, test),
                partial(_ingest, self.campaign.folder),
                ingest,
                FORMATS,
            ),
            self._step(
                ResultId(test.id, "condition"),
                {"recorded": self._of(test.id, "ingest")},
                condition.ConditionInputs.of(self.campaign, test),
                partial(_by_name, condition.condition),
                condition,
                FORMATS,
            ),
            self._step(
                ResultId(test.id, "rocking"),
                {"conditioned": self._of(test.id, "condition")},
                rocking.RockingInputs.of(self.campaign, test),
                partial(_by_name, rocking.rocking),
                rocking,
            ),
        ]
        if test.kind == "free-vibration":
            steps.append(
                self._step(
                    ResultId(test.id, "restitution"),
                    {"rocking": self._of(test.id, "rocking")},
                    restitution.RestitutionInputs.of(self.campaign, test),
                    partial(_by_name, restitution.restitution),
                    restitution,
                )
            )
        return steps

    def pooling(self, specimen_id: str, identified: Mapping[str, Path]) -> Step:
        """Return the step that pools the free vibrations of a specimen, given their results by test."""
        from colonnade.stages import specimen

        return self._step(
            ResultId(specimen_id, "specimen"),
            identified,
            specimen.SpecimenInputs.of(self.campaign, specimen_id),
            specimen.specimen,
            specimen,
        )

    def calibrating(self, specimen_id: str) -> Step:
        """Return the step that finds the law of contact with which a specimen has its restitution."""
        from colonnade.stages import contact

        return self._step(
            ResultId(specimen_id, "contact"),
            {"specimen": self._of(specimen_id, "specimen")},
            contact.ContactInputs.of(self.campaign, specimen_id),
            partial(_by_name, contact.contact),
            contact,
        )

    def predicting(self, test: Test) -> list[Step]:
        """Return the steps from what was measured in a test to the comparison with its predictions."""
        from colonnade.stages import compare, predict

        models = models_of(self.campaign, test)
        steps = [
            self._step(
                ResultId(test.id, "predict", model),
                {
                    "rocking": self._of(test.id, "rocking"),
                    "specimen": self._of(test.specimen, "specimen"),
                    **self._law(test, model),
                    **self._identified(test),
                },
                predict.PredictInputs.of(self.campaign, test, model),
                partial(_by_name, predict.predict),
                predict,
            )
            for model in models
        ]
        steps += [
            self._repeating(test, model) for model in models if self.campaign.processing.predict.members(model) > 0
        ]
        compared = {str(step.result): step.path for step in steps}
        steps.append(
            self._step(
                ResultId(test.id, "compare"),
                {"rocking": self._of(test.id, "rocking")} | compared,
                compare.CompareInputs.of(self.campaign, test),
                _compare,
                compare,
            )
        )
        return steps

    def scoring(self, test: Test, known: Known) -> Step:
        """Return the step that scores a forecast by what was measured in its test."""
        from colonnade.stages import forecast

        result = ResultId(test.id, "forecast")
        return Step(
            result,
            self.layout.path(result),
            {"rocking": self._of(test.id, "rocking")},
            forecast.ForecastScoreInputs(file=known.name),
            partial(_score, known.forecast),
            self.catalogue.code((forecast.__name__, *_STORED_BY)),
            {"forecast": known.sha256},
        )

    def _repeating(self, test: Test, model: str) -> Step:
        """Return the step that repeats a model's prediction over what is not known exactly."""
        from colonnade.stages import contact_ensemble, ensemble

        result, law = ResultId(test.id, "ensemble", model), self._law(test, model)
        upstream = {"conditioned": self._of(test.id, "condition"), "rocking": self._of(test.id, "rocking")}
        upstream |= (law or {"specimen": self._of(test.specimen, "specimen")}) | self._identified(test)
        if law:
            of_contact = contact_ensemble.ContactEnsembleInputs.of(self.campaign, test)
            work = partial(_by_name, contact_ensemble.contact_ensemble)
            return self._step(result, upstream, of_contact, work, contact_ensemble)
        inputs = ensemble.EnsembleInputs.of(self.campaign, test, model)
        return self._step(result, upstream, inputs, partial(_by_name, ensemble.ensemble), ensemble)

    def _law(self, test: Test, model: str) -> dict[str, Path]:
        """Return the law of contact of a model that needs one."""
        return {"contact": self._of(test.specimen, "contact")} if MODELS[model].in_space else {}

    def _identified(self, test: Test) -> dict[str, Path]:
        """Return the result of a free vibration's own identification, which gives the zero of its angle."""
        return {"identified": self._of(test.id, "restitution")} if test.kind == "free-vibration" else {}

    def _of(self, subject: str, stage: str) -> Path:
        return self.layout.stage(subject, stage)

    def _step(
        self,
        result: ResultId,
        upstream: Mapping[str, Path],
        inputs: BaseModel,
        work: Callable[[Mapping[str, Any], Any], xr.Dataset],
        stage: ModuleType,
        *more: str,
    ) -> Step:
        """Return a step; its code is that of the module of its stage, and of `more` that it loads by name."""
        code = self.catalogue.code((stage.__name__, *more, *_STORED_BY), result.model)
        return Step(result, self.layout.path(result), dict(upstream), inputs, work, code)


def _by_name(function: Callable[..., xr.Dataset], upstream: Mapping[str, Any], inputs: Any) -> xr.Dataset:
    return function(inputs=inputs, **upstream)


def _score(known: ForecastFile, upstream: Mapping[str, Any], inputs: Any) -> xr.Dataset:
    from colonnade.stages.forecast import score_forecast

    return score_forecast(upstream["rocking"], known, inputs)


def _compare(upstream: Mapping[str, Any], inputs: Any) -> xr.Dataset:
    from colonnade.stages.compare import compare

    by_model: dict[str, dict[str, xr.Dataset]] = {stage: {} for stage in COMPARED}
    for name, result in upstream.items():
        stage, _, model = name.partition(" ")
        if stage in by_model:
            by_model[stage][model] = result
    return compare(upstream["rocking"], inputs=inputs, **{COMPARED[stage]: each for stage, each in by_model.items()})


def _ingest(folder: Path, paths: Mapping[str, Path], inputs: Any) -> xr.Dataset:
    from colonnade.readers.registry import read
    from colonnade.stages.ingest import ingest

    recordings = {}
    for recorder, path in paths.items():
        how = inputs.files[recorder]
        window = inputs.wanted(recorder)
        recordings[recorder] = read(path, how["format"], how["options"], window=window, within=folder)
    return ingest(recordings, inputs)
