"""A chain: results of one test or specimen, brought up to date one after the other, and what became of each."""

from __future__ import annotations

import shutil
import time
import traceback
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from colonnade.errors import SHORT_OF_MEMORY, ColonnadeError, RunEndedError, StageError, StoreError
from colonnade.findings import Finding, Severity, at_stage, in_order
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import Origin, global_attributes
from colonnade.store.results import STAGES, ResultId, Subject
from colonnade.workflow.executors import WorkersEndedError, in_blocks
from colonnade.workflow.lock import expect_run
from colonnade.workflow.product import Look, Product, stored_attributes

if TYPE_CHECKING:
    import xarray as xr

Action = Literal["done", "up-to-date", "failed"]


@dataclass(frozen=True)
class StageRun:
    """
    What became of one stage of one test, specimen or assessment.

    Attributes
    ----------
    subject : str
        Id of the test, specimen or assessment.
    stage : str
        Name of the stage; "specimen" for what pools a specimen's free vibrations.
    action : str
        done, up-to-date or failed, now or in an earlier run.
    model : str or None
        Of a stage that runs once for each model.
    reason : str
        Why it failed.
    because : str
        Why it ran: "never run", "raw file changed", "settings changed", "upstream changed", "code changed" or "asked
        for"; empty if it did not run.
    seconds : float
    findings : tuple of Finding
        The findings in its result, from now or an earlier run.
    """

    subject: str
    stage: str
    action: Action
    model: str | None = None
    reason: str = ""
    because: str = ""
    seconds: float = 0.0
    findings: tuple[Finding, ...] = ()

    @classmethod
    def of_result(cls, result: ResultId, action: Action, findings: Iterable[Finding] = (), **more: Any) -> StageRun:
        """Say what became of a result."""
        found = tuple(at_stage(findings, result.stage))
        return cls(result.subject, result.stage, action, result.model, findings=found, **more)

    @property
    def of(self) -> Subject:
        """What its subject is."""
        return STAGES[self.stage].of

    @property
    def heading(self) -> str:
        """Name under which its findings are listed: the id of a test, or what it is and its id."""
        return self.subject if self.of == "test" else f"{self.of} {self.subject}"


@dataclass(frozen=True)
class RunResult:
    """
    What a run did.

    Attributes
    ----------
    stages : tuple of StageRun
    summary : Path
        summary.json.
    report : Path or None
        The report's first page; None if the run stopped before it.
    of_campaign : tuple of Finding
        Findings about the campaign file and its test log.
    concerning : mapping of str to tuple of Finding
        Those of them that are about the specimen or the set-up of each test.
    notices : tuple of str
        What happened to the run itself: which results were altered, and so recomputed.
    """

    stages: tuple[StageRun, ...]
    summary: Path
    report: Path | None
    of_campaign: tuple[Finding, ...] = ()
    concerning: Mapping[str, tuple[Finding, ...]] = field(default_factory=dict)
    notices: tuple[str, ...] = ()

    @property
    def failed(self) -> bool:
        """Whether a stage failed, now or in an earlier run whose failure is still up to date."""
        return any(stage.action == "failed" for stage in self.stages)

    @property
    def findings(self) -> dict[str, list[tuple[Finding, bool]]]:
        """
        Findings by test, specimen or "campaign file", each list ordered by `in_order`.

        Subjects without findings are left out.
        """
        found: dict[str, list[Finding]] = {"campaign file": list(self.of_campaign)}
        for stage in self.stages:
            found.setdefault(stage.heading, []).extend(stage.findings)
        ordered = {subject: in_order(each, self.concerning.get(subject, ())) for subject, each in found.items()}
        return {subject: each for subject, each in ordered.items() if each}

    @property
    def has_warnings(self) -> bool:
        """Whether any finding is more serious than a note."""
        return any(each.severity is not Severity.NOTE for found in self.findings.values() for each, _ in found)


WORKER_LOST = (
    "The system stopped the process that worked on this test, at last when nothing else was running. Either memory "
    "ran out, or a damaged raw file crashed the library that reads it. Close other programs and run again. If "
    "the test still fails, copy the raw file from the recorder again, or export it as text."
)


@dataclass(frozen=True)
class Chain:
    """
    Results of one test or specimen, with all that a worker needs to make them.

    Attributes
    ----------
    products : sequence of Product
        At least one; each is a result.
    layout : Layout
    origin : Origin
        The campaign, as each result names it.
    run_id : str
        The run that it belongs to; nothing is written once that has ended.
    start_from : str or None
        First stage whose results are recomputed whatever their state.
    """

    products: Sequence[Product]
    layout: Layout
    origin: Origin
    run_id: str

    def standing(self, look: Look) -> tuple[list[StageRun], Product | None]:
        """Give what became of its results so far, and the first that has to be made, if any has to."""
        runs: list[StageRun] = []
        for product in self.products:
            if product.why(look):
                return runs, product
            runs.append(_unchanged(product, look(product.paths[0])))
            if runs[-1].action == "failed":
                break
        return runs, None


def bring_up_to_date(chain: Chain) -> list[StageRun]:
    """
    Bring a chain up to date, up to the first result that fails; results that follow a failed one are removed.

    Raises
    ------
    RunEndedError
        If the run that it belongs to has ended, or this is a worker of a cluster that does not see its folder.
    """
    made: dict[Path, xr.Dataset] = {}
    runs, expect = list[StageRun](), partial(expect_run, chain.layout, chain.run_id)
    with files.only_while(expect):
        for number, product in enumerate(chain.products, 1):
            expect()
            runs.append(_run(chain, product, made))
            if runs[-1].action == "failed":
                _remove_following(chain, product)
                break
            wanted = {path for later in chain.products[number:] for path in later.upstream.values()}
            for path in made.keys() - wanted:
                del made[path]
    return runs


def worker_lost(chain: Chain) -> list[StageRun]:
    """Report a chain whose process was stopped; no failure is stored, so that the next run tries again."""
    _, late = chain.standing(stored_attributes)
    stopped = late or chain.products[-1]
    files.remove(stopped.paths[0])
    _remove_following(chain, stopped)
    return [StageRun.of_result(stopped.result, "failed", reason=WORKER_LOST)]


def remove_results(layout: Layout, test: str, after: int = -1) -> None:
    """Remove the results of a test of stages after one, by default all: nothing may follow from a failure."""
    for stage, each in STAGES.items():
        of_stage = ResultId(test, stage, model="*")
        if each.of == "test" and of_stage.order > after:
            for path in layout.processed.glob(of_stage.file):
                files.remove(path)


def _remove_following(chain: Chain, product: Product) -> None:
    """Remove what follows from a failed result, in the chain and of later stages."""
    for later in chain.products[chain.products.index(product) + 1 :]:
        files.remove(later.paths[0])
    if product.result.of == "test":
        remove_results(chain.layout, product.result.subject, product.result.order)


def _run(chain: Chain, product: Product, made: dict[Path, xr.Dataset]) -> StageRun:
    """Bring one result up to date; `made` holds the results of this chain, which are not read again."""
    expect_none()
    result, path = product.result, product.paths[0]

    def look(path: Path) -> Mapping[str, Any]:
        return made[path].attrs if path in made else stored_attributes(path)

    because = product.why(look)
    if not because:
        return _unchanged(product, look(path))
    started = time.perf_counter()
    attributes: dict[str, Any] = {**global_attributes(chain.origin, result), **product.attributes(look)}
    if result.stage == "ingest":
        hashes = [digest or "" for digest in product.upstream.values()]
        attributes |= {"raw_files": list(product.upstream), "raw_sha256": hashes}
    told = partial(StageRun.of_result, result, because=because)
    try:
        made[path] = files.write(_made(chain, product, made, attributes["key"]), path, attributes=attributes)
        shutil.rmtree(chain.layout.blocks(result), ignore_errors=True)
    except RunEndedError:
        raise
    except Exception as error:
        expect_none()  # an interrupt in the import of a compiled module comes as an ImportError
        reason = _reason(result, error)
        if _is_machine_failure(error):  # it is not stored: the next run tries again
            files.remove(path)
        else:
            with suppress(StoreError):
                files.write_failed(path, reason, attributes=attributes)
        return told("failed", reason=reason, seconds=time.perf_counter() - started)
    return told("done", made[path].attrs["warnings"], seconds=time.perf_counter() - started)


def _made(chain: Chain, product: Product, made: dict[Path, xr.Dataset], key: str) -> xr.Dataset:
    """Make a result from those that it reads, which stay in `made`."""
    read = {name: each for name, each in product.upstream.items() if isinstance(each, Path)}
    for each in read.values():
        made[each] = made[each] if each in made else files.read(each)
        if made[each].attrs["status"] == "failed":
            raise StageError("specimen {specimen}: {reason}".format_map(made[each].attrs))
    work = product.make
    if product.where is not None:
        folder = chain.layout.blocks(product.result)
        work = partial(work, run=partial(in_blocks, folder=folder, key=key, where=product.where))
    dataset: xr.Dataset = work({name: made[each] for name, each in read.items()})
    return dataset


def _unchanged(product: Product, stored: Mapping[str, Any]) -> StageRun:
    if stored.get("status") == "failed":
        return StageRun.of_result(product.result, "failed", reason=str(stored.get("reason", "")))
    return StageRun.of_result(product.result, "up-to-date", stored.get("warnings", ()))


def _reason(result: ResultId, error: Exception) -> str:
    """Say why a result failed; a bug in colonnade is reported as such, and the other tests go on."""
    if isinstance(error, ColonnadeError):
        return str(error)
    if isinstance(error, MemoryError):
        return SHORT_OF_MEMORY
    frames = traceback.extract_tb(error.__traceback__)[-LAST:]
    way = " > ".join(f"{Path(frame.filename).name}:{frame.lineno}" for frame in frames)
    return (
        f"Internal error in {result.stage}, {type(error).__name__} at {way}: {error}. This is a bug in colonnade, not "
        "an error in your campaign. Please report it with this sentence."
    )


LAST = 6
"""Calls that the report of a bug names."""


def _is_machine_failure(error: Exception) -> bool:
    """Whether the disk, the memory, a worker or an interrupted import caused it, not the data."""
    if isinstance(error, (StoreError, WorkersEndedError, MemoryError, ImportError)):
        return True
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno is not None and not isinstance(cause, FileNotFoundError)
