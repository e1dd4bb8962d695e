"""The steps of one test or specimen, one after the other, in a process of their own."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.errors import ColonnadeError, RunEndedError, StoreError
from colonnade.findings import at_stage
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.provenance import Origin, global_attributes
from colonnade.store.results import ASKED_FOR, ResultId
from colonnade.workflow.catalogue import stored_attributes
from colonnade.workflow.execution.lock import expect_run
from colonnade.workflow.raw_files import RawFiles, expect_unchanged
from colonnade.workflow.results import StageRun
from colonnade.workflow.steps import Step

if TYPE_CHECKING:
    import xarray as xr

Look = Callable[[Path], Mapping[str, Any]]
"""Tells the stored attributes of a result."""

_SHORT_OF_MEMORY = (
    "The machine ran out of memory. Finished results are kept. Run again with fewer workers (`--workers 1` uses the "
    "least memory), or close other programs first."
)

_WORKER_LOST = (
    "The system stopped the process that worked on this test, twice: the second time nothing else was running. Either "
    "memory ran out, or a damaged raw file crashed the library that reads it. Close other programs and run again. If "
    "the test still fails, copy the raw file from the recorder again, or export it as text."
)


@dataclass(frozen=True)
class Chain:
    """
    The steps of one test or specimen that a worker walks through.

    Attributes
    ----------
    steps : sequence of Step
        One at least.
    results : sequence of ResultId
        All that the test has: what lies behind a failure is taken away.
    layout : Layout
    campaign_file : Path
    origin : Origin
        The campaign, as each result names it.
    run : str
        The run that it belongs to; nothing is written once that has ended.
    redo_from : str or None
        Stage from which on results are made again whatever their state.
    raw : mapping of str to RawFile
        The raw files by path from the campaign's folder, as they were hashed.
    """

    steps: Sequence[Step]
    results: Sequence[ResultId]
    layout: Layout
    campaign_file: Path
    origin: Origin
    run: str
    redo_from: str | None
    raw: RawFiles

    @property
    def subject(self) -> str:
        """Id of the test or specimen."""
        return self.steps[0].result.subject


def walk(chain: Chain) -> list[StageRun]:
    """
    Bring a chain up to date, up to the first step that fails; what lies behind a failure is taken away.

    Raises
    ------
    RunEndedError
        If the run that it belongs to has ended.
    """
    with files.only_while(partial(expect_run, chain.layout, chain.run)):
        runs = list(_walked(chain))
        if runs[-1].action != "failed":
            files.remove(chain.layout.error_log(chain.steps[0].result))
    return runs


def _walked(chain: Chain) -> Iterator[StageRun]:
    made: dict[Path, xr.Dataset] = {}
    for number, step in enumerate(chain.steps):
        expect_run(chain.layout, chain.run)
        run = _advance(chain, step, made)
        yield run
        if run.action == "failed":
            clear_behind(chain.layout, chain.results, step.result.order)
            return
        wanted = {path for later in chain.steps[number + 1 :] for path in later.upstream.values()}
        for path in made.keys() - wanted:
            del made[path]


def lost(chain: Chain) -> StageRun:
    """Say of a chain whose process was stopped at which step that was; nothing is kept, so that the next run tries."""
    stopped = next((step for step in chain.steps if _why(chain, step, stored_attributes)), chain.steps[-1]).result
    clear_behind(chain.layout, chain.results, stopped.order - 1)
    return StageRun(stopped.subject, stopped.stage, "failed", stopped.model, _WORKER_LOST)


def clear_behind(layout: Layout, results: Sequence[ResultId], order: int) -> None:
    """Take away a test's results of stages after the one of this order: nothing may follow from a failure."""
    for result in results:
        if result.order > order:
            files.remove(layout.path(result))


def is_fresh(chain: Chain, look: Look) -> list[StageRun] | None:
    """Return what `walk` would say of a chain whose results, as `look` tells of them, are up to date; else None."""
    runs: list[StageRun] = []
    for step in chain.steps:
        if _why(chain, step, look):
            return None
        runs.append(_standing(step, look(step.path)))
        if runs[-1].action == "failed":
            break
    return runs


def _advance(chain: Chain, step: Step, made: dict[Path, xr.Dataset]) -> StageRun:
    """Bring one result up to date; the results made on this walk are not read again."""
    expect_none()
    stored = stored_attributes(step.path)
    recipe = _recipe(chain, step, lambda path: made[path].attrs if path in made else stored_attributes(path))
    because = _because(chain, step, recipe, stored)
    if not because:
        return _standing(step, stored)
    started = time.perf_counter()
    subject, stage, model = step.result.subject, step.result.stage, step.result.model
    attributes = _attributes(chain, step, recipe)
    try:
        if step.is_from_raw:
            result = step.work(step.upstream, step.inputs)
            expect_unchanged(chain.layout.folder, chain.raw)
        else:
            for path in step.upstream.values():
                made[path] = made[path] if path in made else files.read(path)
            result = step.work({name: made[path] for name, path in step.upstream.items()}, step.inputs)
        made[step.path] = files.write(result, step.path, attributes=attributes)
    except RunEndedError:
        raise
    except Exception as error:
        expect_none()  # an interrupt in the import of a compiled module comes as an ImportError
        reason = _reason(chain, step, error, attributes)
        return StageRun(subject, stage, "failed", model, reason, because, time.perf_counter() - started)
    found = tuple(at_stage(result.attrs.get("warnings", []), stage))
    return StageRun(subject, stage, "done", model, "", because, time.perf_counter() - started, found)


def _recipe(chain: Chain, step: Step, look: Look) -> Recipe:
    if step.is_from_raw:
        upstream = {name: file.sha256 for name, file in chain.raw.items()}
    else:
        upstream = {name: look(path).get("content") for name, path in step.upstream.items()}
    return Recipe(step.result.stage, step.code, step.inputs.model_dump_json(), upstream)


def _why(chain: Chain, step: Step, look: Look) -> str:
    """Say why a result has to be made; empty if it does not."""
    return _because(chain, step, _recipe(chain, step, look), look(step.path))


def _because(chain: Chain, step: Step, recipe: Recipe, stored: Mapping[str, Any]) -> str:
    if chain.redo_from is not None and step.result.order >= ASKED_FOR.index(chain.redo_from):
        return "asked for"
    return recipe.why(stored)


def _standing(step: Step, stored: Mapping[str, Any]) -> StageRun:
    subject, stage, model = step.result.subject, step.result.stage, step.result.model
    if stored.get("status") == "failed":
        return StageRun(subject, stage, "failed", model, str(stored.get("reason", "")))
    findings = tuple(at_stage(stored.get("warnings", ()), stage))
    return StageRun(subject, stage, "up-to-date", model, findings=findings)


def _attributes(chain: Chain, step: Step, recipe: Recipe) -> dict[str, Any]:
    attributes: dict[str, Any] = {**global_attributes(chain.origin, step.result), **recipe.attributes}
    if step.is_from_raw:
        hashes = [digest or "" for digest in recipe.upstream.values()]
        attributes |= {"raw_files": list(recipe.upstream), "raw_sha256": hashes}
    return attributes


def _reason(chain: Chain, step: Step, error: Exception, attributes: Mapping[str, Any]) -> str:
    """Return why a step failed, and store that, unless it says nothing of the data: then the next run tries again."""
    if isinstance(error, ColonnadeError):
        reason = str(error)
    elif isinstance(error, MemoryError):
        reason = _SHORT_OF_MEMORY
    else:  # a defect of ours: told as such, the other tests go on
        reason = _internal_error(chain.layout, step, error)
    if _is_of_the_machine(error):
        files.remove(step.path)
        return reason
    try:
        files.write_failed(step.path, reason, attributes=attributes)
    except StoreError as unwritable:
        return f"{reason} This failure could not be stored either: {unwritable}"
    return reason


def _is_of_the_machine(error: Exception) -> bool:
    """Whether disk, memory or an interrupted import failed."""
    if isinstance(error, (StoreError, MemoryError, ImportError)):
        return True
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno is not None and not isinstance(cause, FileNotFoundError)


def _internal_error(layout: Layout, step: Step, error: Exception) -> str:
    """Write the traceback to the error.log of the test or specimen; return what to tell."""
    frames = traceback.extract_tb(error.__traceback__)
    place = f"{frames[-1].filename.rpartition('colonnade')[2].lstrip('/')}:{frames[-1].lineno}" if frames else "?"
    log = layout.error_log(step.result)
    where = f"its traceback is in {log.relative_to(layout.home).as_posix()}"
    try:
        files.write_text(log, "".join(traceback.format_exception(error)))
    except StoreError:
        where = "its traceback could not be written"
    return (
        f"Internal error in {step.result.stage}, {type(error).__name__} at {place}: {error}. This is a bug in "
        f"colonnade, not an error in your campaign; {where}. Please report it with that file."
    )
