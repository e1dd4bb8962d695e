"""The graph of results: what each result reads, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.models import MODELS
from colonnade.store.forecasts import Known
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId, models_of
from colonnade.workflow.executors import HERE, Arrays, Run, Where, blocks_of
from colonnade.workflow.product import Catalogue, Product
from colonnade.workflow.raw_files import RawFiles, expect_unchanged

if TYPE_CHECKING:
    import xarray as xr
    from pydantic import BaseModel

    from colonnade.dynamics.ensemble import Plan
    from colonnade.stages.compare import CompareInputs
    from colonnade.stages.ingest import IngestInputs

COMPARED = {"predict": "predicted", "ensemble": "ensembles"}
"""Stages whose results `compare` takes by model, and the name of the argument."""

FORMATS = "colonnade.readers"
"""The readers: formats are loaded by name, so that no import of a stage shows that they are used."""

_STORED_BY = ("colonnade.store.description", __name__)
"""Modules that take part in every result."""


@dataclass(frozen=True)
class Graph:
    """
    The results of a campaign, as products.

    Attributes
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Gives the hash of the code.
    raw : mapping of str to mapping of str to RawFile
        Raw files by test.
    """

    campaign: Campaign
    layout: Layout
    catalogue: Catalogue
    raw: Mapping[str, RawFiles] = field(default_factory=dict)

    def of_test(self, test: Test, where: Where = HERE) -> list[Product]:
        """Return the results of a test in their order; `where` members of the contact model's ensembles are run."""
        return [*self._measuring(test), *self._predicting(test, where)]

    def _measuring(self, test: Test) -> list[Product]:
        from colonnade.stages import condition, ingest, restitution, rocking

        recorded, conditioned, measured, identified = (
            ResultId(test.id, stage) for stage in ("ingest", "condition", "rocking", "restitution")
        )
        read, raw = ingest.IngestInputs.of(self.campaign, test), self.raw[test.id]
        digests = {name: file.sha256 for name, file in raw.items()}
        ingests = partial(_ingest, self.campaign.folder, test.files, raw)
        cleaned = condition.ConditionInputs.of(self.campaign, test)
        turned = rocking.RockingInputs.of(self.campaign, test)
        products = [
            self.product(recorded, read, digests, ingests, FORMATS),
            self.product(conditioned, cleaned, {"recorded": recorded}, condition.condition, FORMATS),
            self.product(measured, turned, {"conditioned": conditioned}, rocking.rocking),
        ]
        if test.kind == "free-vibration":
            of_free = restitution.RestitutionInputs.of(self.campaign, test)
            products.append(self.product(identified, of_free, {"rocking": measured}, restitution.restitution))
        return products

    def pooling(self, specimen_id: str, tests: list[str]) -> Product:
        """Return the result that pools the free vibrations of a specimen: those of some tests."""
        from colonnade.stages import specimen

        identified = {name: ResultId(name, "restitution") for name in tests}
        inputs = specimen.SpecimenInputs.of(self.campaign, specimen_id)
        pooled = self.product(ResultId(specimen_id, "specimen"), inputs, identified, specimen.specimen)
        return replace(pooled, make=partial(specimen.specimen, inputs=inputs))  # a test may be called like an argument

    def calibrating(self, specimen_id: str) -> Product:
        """Return the law of contact with which a specimen has its restitution."""
        from colonnade.stages import contact

        inputs, upstream = contact.ContactInputs.of(self.campaign, specimen_id), ResultId(specimen_id, "specimen")
        return self.product(ResultId(specimen_id, "contact"), inputs, {"specimen": upstream}, contact.contact)

    def _predicting(self, test: Test, where: Where) -> list[Product]:
        from colonnade.stages import compare, ensemble, predict

        conditioned, rocking = ({name: ResultId(test.id, stage)} for name, stage in _MEASURED.items())
        specimen = {"specimen": ResultId(test.specimen, "specimen")}
        # A free vibration's own identification gives the zero of its angle.
        own = {"identified": ResultId(test.id, "restitution")} if test.kind == "free-vibration" else {}
        predictions, ensembles = [], []
        for model in models_of(self.campaign, test):
            is_calibrated = MODELS[model].in_space and not self.campaign.specimens[test.specimen].is_assembly
            law = {"contact": ResultId(test.specimen, "contact")} if is_calibrated else {}
            inputs = predict.PredictInputs.of(self.campaign, test, model)
            upstream = {**rocking, **specimen, **law, **own}
            predictions.append(self.product(ResultId(test.id, "predict", model), inputs, upstream, predict.predict))
            if not self.campaign.members(test, model):
                continue
            result, upstream = ResultId(test.id, "ensemble", model), {**conditioned, **rocking, **own}
            varied = ensemble.EnsembleInputs.of(self.campaign, test, model)
            if MODELS[model].in_space:
                ensembles.append(self.product(result, varied, upstream | law, _in_blocks, where=where))
            else:
                ensembles.append(self.product(result, varied, upstream | specimen, ensemble.ensemble))
        predicted = [*predictions, *ensembles]
        upstream = rocking | {str(product.id): product.result for product in predicted}
        compared = ResultId(test.id, "compare")
        return [*predicted, self.product(compared, compare.CompareInputs.of(self.campaign, test), upstream, _compare)]

    def scoring(self, test: Test, known: Known) -> Product:
        """Return the scores of a forecast by what was measured in its test."""
        from colonnade.stages import forecast

        return self.product(
            ResultId(test.id, "forecast"),
            forecast.ForecastScoreInputs(file=known.name),
            {"rocking": ResultId(test.id, "rocking"), "forecast": known.sha256},
            partial(forecast.score_forecast, forecast=known.forecast),
        )

    def product(
        self,
        result: ResultId,
        inputs: BaseModel,
        upstream: Mapping[str, ResultId | str | None],
        work: Callable[..., xr.Dataset],
        *more: str,
        where: Where | None = None,
    ) -> Product:
        """
        Return a result as a product.

        Parameters
        ----------
        result : ResultId
        inputs : BaseModel
            The stage's own model of what it reads of the campaign; the module of its class makes the result.
        upstream : mapping of str to ResultId, str or None
            Results that it reads, or hashes of what else it is made from.
        work : callable
            Takes the inputs, and the results of `upstream` by name.
        *more
            Modules whose code counts too: those that are loaded by name.
        where : Where or None, optional
            See `Product`.
        """
        code = self.catalogue.code((type(inputs).__module__, *more, *_STORED_BY), result.model)
        read = {name: self.layout.path(each) if isinstance(each, ResultId) else each for name, each in upstream.items()}
        path = self.layout.path(result)
        make = partial(_made, work, inputs)
        return Product(result, inputs.model_dump_json(), read, code, make, (path,), where=where)


_MEASURED = {"conditioned": "condition", "rocking": "rocking"}
"""Arguments of later stages, and the stage of a test that gives each."""


def _made(
    work: Callable[..., xr.Dataset], inputs: BaseModel, upstream: Mapping[str, xr.Dataset], **run: Run
) -> xr.Dataset:
    return work(inputs=inputs, **upstream, **run)


def _in_blocks(*, run: Run, **read: Any) -> xr.Dataset:
    from colonnade.stages import ensemble

    def members(plan: Plan, central: Array) -> list[Arrays]:
        return run(partial(plan.members, central), blocks_of(plan.count))

    return ensemble.ensemble(**read, run=members)


def _ingest(folder: Path, paths: Mapping[str, Path], raw: RawFiles, *, inputs: IngestInputs) -> xr.Dataset:
    from colonnade.readers.registry import read
    from colonnade.stages.ingest import ingest

    recordings = {}
    for recorder, path in paths.items():
        how = inputs.files[recorder]
        window = inputs.wanted(recorder)
        recordings[recorder] = read(path, how["format"], how["options"], window=window, within=folder)
    result = ingest(recordings, inputs)
    expect_unchanged(folder, raw)
    return result


def _compare(*, inputs: CompareInputs, rocking: xr.Dataset, **predicted: xr.Dataset) -> xr.Dataset:
    from colonnade.stages.compare import compare

    by_model: dict[str, dict[str, xr.Dataset]] = {stage: {} for stage in COMPARED}
    for name, result in predicted.items():
        stage, _, model = name.partition(" ")
        by_model[stage][model] = result
    return compare(rocking, inputs=inputs, **{COMPARED[stage]: each for stage, each in by_model.items()})
