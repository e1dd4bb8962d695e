"""
The graph of results: what each result reads, and the function that makes it, with the raw files at its beginning.

Also what several questions ask of a campaign: that an id is in it, its one specimen, and the e of a specimen.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.assembly import APART
from colonnade.dynamics.models import MODELS
from colonnade.errors import CampaignError, ReadError, StoreError, nearest
from colonnade.findings import Finding, serious
from colonnade.readers.files import sha256_of
from colonnade.readers.registry import companions
from colonnade.store.forecasts import Known
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId, results_of
from colonnade.units.text import listed
from colonnade.workflow.executors import HERE, Arrays, Run, Where, blocks_of
from colonnade.workflow.product import Catalogue, Mark, Product, marks_of, read_done

if TYPE_CHECKING:
    import xarray as xr
    from pydantic import BaseModel

    from colonnade.dynamics.ensemble import Plan
    from colonnade.stages.compare import CompareInputs
    from colonnade.stages.ingest import IngestInputs

COMPARED = {"predict": "predicted", "ensemble": "ensembles"}
"""Stages whose results `compare` takes by model, and the name of the argument."""

ARGUMENTS = {"ingest": "recorded", "condition": "conditioned", "restitution": "identified"}
"""Stages whose results have other names where they are read; of those that a release tells, the zero of its angle."""

FORMATS = "colonnade.readers"
"""The readers: formats are loaded by name, so that no import of a stage shows that they are used."""

_STORED_BY = ("colonnade.store.description", __name__)
"""Modules that take part in every result."""


@dataclass(frozen=True)
class RawFile:
    """A raw file as it was hashed: its SHA-256, None if it could not be read, and its mark."""

    sha256: str | None
    mark: Mark = (0, 0, 0)


RawFiles = Mapping[str, RawFile]
"""Raw files by path within the campaign's folder."""


def _companions(known_as: str | None, path: Path) -> list[str]:
    try:
        return [other.name for other in companions(path, known_as) if other.name]
    except ReadError:  # reported when the file is read
        return []


def expect_unchanged(folder: Path, raw: RawFiles) -> None:
    """
    Check that raw files are still as they were hashed; a recorder may still be writing.

    Raises
    ------
    StoreError
        If one has changed.
    """
    there = marks_of(folder / name for name in raw)
    for name, file in raw.items():
        if file.sha256 is not None and there.get(folder / name) != file.mark:
            raise StoreError(
                f"{name}: this file changed while it was being read. Is the recorder still writing? Run again later."
            )


def copies(campaign: Campaign, raw: Mapping[str, RawFiles]) -> Iterator[Finding]:
    """Say which tests are of one recording: of a file and its copy, or of one specimen and the same part of a file."""
    found: dict[object, dict[str, str]] = {}
    for test, files in raw.items():
        window = campaign.review(test).within(campaign.tests[test].window)
        for path, file in {} if campaign.left_out(test) else files.items():
            if file.sha256 is not None and file.mark[0]:
                found.setdefault((file.sha256, window), {})[test] = path
    for tests in {tuple(tests): tests for tests in found.values()}.values():
        paths = dict.fromkeys(tests.values())
        if len(paths) > 1 or len({campaign.tests[test].specimen for test in tests}) < len(tests):
            yield serious(
                "copied file",
                f"{listed(list(tests))} are one recording: {listed(list(paths))}. What "
                "it shows, e too, counts several times. Was a folder copied and not yet filled with its own "
                "recordings? Correct `file`, or give each test its `window` of the file; of two bodies on the table, "
                "each is a specimen.",
            )


@dataclass(frozen=True)
class Graph:
    """
    The results of a campaign, as products.

    Attributes
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Gives the hash of the code and of raw files.
    """

    campaign: Campaign
    layout: Layout
    catalogue: Catalogue

    def raw(self, test: Test) -> RawFiles:
        """Hash the raw files of a test, and their companion files."""
        found: dict[str, RawFile] = {}
        for recorder, path in test.files.items():
            known_as = self.campaign.setups[test.setup].recorders[recorder].file.format
            is_there = self.hashed(path).sha256 is not None
            named = self.catalogue.entry("raw", path, partial(_companions, known_as), known_as) if is_there else None
            for name in (path.name, *(named[1] if named else ())):
                each = path.with_name(name)
                found[each.relative_to(self.campaign.folder).as_posix()] = self.hashed(each)
        return found

    def hashed(self, path: Path) -> RawFile:
        """Hash a file, unless it is outside the campaign's folder: reading refuses it."""
        is_inside = path.resolve().is_relative_to(self.campaign.folder)
        entry = self.catalogue.entry("raw", path, sha256_of) if is_inside else None
        return RawFile(entry[1], tuple(entry[0])) if entry else RawFile(None)

    def of_test(self, test: Test, where: Where = HERE) -> list[Product]:
        """Return the results of a test in their order; `where` members of the contact model's ensembles are run."""
        results = results_of(self.campaign, test)
        return [self._of_test(test, result, results, where) for result in results]

    def _of_test(self, test: Test, result: ResultId, results: Sequence[ResultId], where: Where) -> Product:
        """Return one of the results of a test."""
        from colonnade.stages import compare, condition, ensemble, ingest, predict, restitution, rocking

        campaign, model = self.campaign, str(result.model)
        there = {each.stage: each for each in results} | {"specimen": ResultId(test.specimen, "specimen")}
        is_in_space = model in MODELS and MODELS[model].in_space
        if is_in_space and not campaign.specimens[test.specimen].is_assembly:
            there["contact"] = ResultId(test.specimen, "contact")

        def read(*stages: str) -> dict[str, ResultId]:
            return {ARGUMENTS.get(stage, stage): there[stage] for stage in stages if stage in there}

        inputs: BaseModel
        match result.stage:
            case "ingest":
                inputs, raw = ingest.IngestInputs.of(campaign, test), self.raw(test)
                work = partial(_ingest, campaign.folder, test.files, raw)
                return self.product(result, inputs, {name: file.sha256 for name, file in raw.items()}, work, FORMATS)
            case "condition":
                inputs = condition.ConditionInputs.of(campaign, test)
                return self.product(result, inputs, read("ingest"), condition.condition, FORMATS)
            case "rocking":
                inputs = rocking.RockingInputs.of(campaign, test)
                return self.product(result, inputs, read("condition"), rocking.rocking)
            case "restitution":
                inputs = restitution.RestitutionInputs.of(campaign, test)
                return self.product(result, inputs, read("rocking"), restitution.restitution)
            case "predict":
                inputs = predict.PredictInputs.of(campaign, test, model)
                upstream = read("rocking", "restitution", "specimen", "contact")
                return self.product(result, inputs, upstream, predict.predict)
            case "ensemble":
                inputs = ensemble.EnsembleInputs.of(campaign, test, model)
                upstream = read("rocking", "restitution", "contact" if is_in_space else "specimen")
                if is_in_space:
                    return self.product(result, inputs, upstream, _in_blocks, where=where)
                return self.product(result, inputs, upstream, ensemble.ensemble)
            case _:
                inputs = compare.CompareInputs.of(campaign, test)
                predicted = {str(each): each for each in results if each.stage in COMPARED}
                return self.product(result, inputs, read("rocking") | predicted, _compare)

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
        recordings[recorder] = read(path, how["format"], how["options"], within=folder)
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


def expect_known(campaign: Campaign, what: str, names: Iterable[str], more: str = "") -> None:
    """Refuse ids of a test, a specimen or an assessment that a campaign does not have."""
    known: Collection[str] = getattr(campaign, f"{what}s")
    for name in names:
        if name not in known:
            raise CampaignError(f'{campaign.path.name} has no {what} "{name}".{nearest(name, known)}{more}')


def one_specimen(campaign: Campaign, name: str | None) -> str:
    """Give the specimen of this id or, without one, the only one of a campaign; it has to rock as one block."""
    if name is None and len(campaign.of_interest) > 1:
        listed = nearest("", campaign.of_interest)
        raise CampaignError(f"The campaign has several specimens. Name one with --specimen ID.{listed}")
    chosen = campaign.of_interest[0] if name is None else name
    expect_known(campaign, "specimen", [chosen])
    if not campaign.specimens[chosen].is_in_plane:
        raise CampaignError(
            f"{chosen}: {APART}, which the models in the plane move. "
            "For several bodies: `colonnade map --model contact`, or [assessments.<name>] in the campaign file."
        )
    return chosen


def restitution_taken(campaign: Campaign, layout: Layout, specimen: str) -> xr.Dataset:
    """Give the e that predictions use (see `stages.specimen`), by the campaign as it is and what is stored."""
    from colonnade.stages.specimen import SpecimenInputs, taken

    return taken(read_done(layout.stage(specimen, "specimen")), SpecimenInputs.of(campaign, specimen))
