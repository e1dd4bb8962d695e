"""A chain: the steps of one test or specimen, brought up to date one after the other, often in a worker process."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.errors import SHORT_OF_MEMORY, ColonnadeError, RunEndedError, StoreError
from colonnade.findings import at_stage
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.freshness import NEVER_RUN, Recipe
from colonnade.store.layout import Layout
from colonnade.store.provenance import Origin, global_attributes
from colonnade.store.results import RUN_STAGES, ResultId
from colonnade.workflow.catalogue import stored_attributes
from colonnade.workflow.execution.lock import expect_run
from colonnade.workflow.outcome import StageRun
from colonnade.workflow.raw_files import RawFiles, expect_unchanged
from colonnade.workflow.steps import Step

if TYPE_CHECKING:
    import xarray as xr

Look = Callable[[Path], Mapping[str, Any]]
"""Returns the stored attributes of a result, given its path."""

_WORKER_LOST = (
    "The system stopped the process that worked on this test, twice: the second time nothing else was running. Either "
    "memory ran out, or a damaged raw file crashed the library that reads it. Close other programs and run again. If "
    "the test still fails, copy the raw file from the recorder again, or export it as text."
)


@dataclass(frozen=True)
class Chain:
    """
    The steps of one test or specimen, with all that a worker needs to make them.

    Attributes
    ----------
    steps : sequence of Step
        At least one.
    results : sequence of ResultId
        All results of the test: those that follow a failed one are removed.
    layout : Layout
    campaign_file : Path
    origin : Origin
        The campaign, as each result names it.
    run_id : str
        The run that it belongs to; nothing is written once that has ended.
    start_from : str or None
        First stage whose results are recomputed whatever their state.
    raw : mapping of str to RawFile
        The raw files as they were hashed, by path within the campaign's folder.
    """

    steps: Sequence[Step]
    results: Sequence[ResultId]
    layout: Layout
    campaign_file: Path
    origin: Origin
    run_id: str
    start_from: str | None
    raw: RawFiles

    @property
    def subject(self) -> str:
        """Id of the test or specimen."""
        return self.steps[0].result.subject


def bring_up_to_date(chain: Chain) -> list[StageRun]:
    """
    Bring a chain up to date, up to the first step that fails; results that follow a failed one are removed.

    Raises
    ------
    RunEndedError
        If the run that it belongs to has ended.
    """
    with files.only_while(partial(expect_run, chain.layout, chain.run_id)):
        runs = list(_runs(chain))
        if runs[-1].action != "failed":
            files.remove(chain.layout.error_log(chain.steps[0].result))
    return runs


def if_up_to_date(chain: Chain, look: Look) -> list[StageRun] | None:
    """Return what `bring_up_to_date` would for a chain with nothing to do, by the attributes from `look`; else None."""
    runs: list[StageRun] = []
    for step in chain.steps:
        if _why(chain, step, look):
            return None
        runs.append(_unchanged(step, look(step.path)))
        if runs[-1].action == "failed":
            break
    return runs


def why_pending(chain: Chain, look: Look) -> str | None:
    """Say why the results of a test cannot be shown: empty if it was never run, None if they are up to date."""
    done = if_up_to_date(chain, look)
    if done is not None:
        return None
    first, why = next((number, why) for number, step in enumerate(chain.steps) if (why := _why(chain, step, look)))
    if why != NEVER_RUN:
        return f"its results are out of date ({why}); run again"
    return f"run only as far as {chain.steps[first - 1].result.stage}; `colonnade run` does the rest" if first else ""


def worker_lost(chain: Chain) -> StageRun:
    """Report a chain whose process was stopped; no failure is stored, so that the next run tries again."""
    stopped = next((step for step in chain.steps if _why(chain, step, stored_attributes)), chain.steps[-1]).result
    remove_later(chain.layout, chain.results, stopped.order - 1)
    return StageRun(stopped.subject, stopped.stage, "failed", stopped.model, _WORKER_LOST)


def remove_later(layout: Layout, results: Sequence[ResultId], order: int) -> None:
    """Remove a test's results of stages after the one of this order: nothing may follow from a failure."""
    for result in results:
        if result.order > order:
            files.remove(layout.path(result))


def _runs(chain: Chain) -> Iterator[StageRun]:
    made: dict[Path, xr.Dataset] = {}
    for number, step in enumerate(chain.steps):
        expect_run(chain.layout, chain.run_id)
        run = _run_step(chain, step, made)
        yield run
        if run.action == "failed":
            remove_later(chain.layout, chain.results, step.result.order)
            return
        wanted = {path for later in chain.steps[number + 1 :] for path in later.upstream.values()}
        for path in made.keys() - wanted:
            del made[path]


def _run_step(chain: Chain, step: Step, made: dict[Path, xr.Dataset]) -> StageRun:
    """Bring one result up to date; `made` holds the results of this chain, which are not read again."""
    expect_none()
    stored = stored_attributes(step.path)
    recipe = _recipe(chain, step, lambda path: made[path].attrs if path in made else stored_attributes(path))
    because = _why(chain, step, lambda path: stored, recipe)
    if not because:
        return _unchanged(step, stored)
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
        reason = _store_failure(chain, step, error, attributes)
        return StageRun(subject, stage, "failed", model, reason, because, time.perf_counter() - started)
    found = tuple(at_stage(result.attrs.get("warnings", []), stage))
    return StageRun(subject, stage, "done", model, "", because, time.perf_counter() - started, found)


def _recipe(chain: Chain, step: Step, look: Look) -> Recipe:
    if step.is_from_raw:
        upstream = {name: file.sha256 for name, file in chain.raw.items()}
    else:
        upstream = {name: look(path).get("content") for name, path in step.upstream.items()}
    return Recipe(step.result.stage, step.code, step.inputs.model_dump_json(), {**upstream, **step.given})


def _why(chain: Chain, step: Step, look: Look, recipe: Recipe | None = None) -> str:
    """Say why a result has to be made; empty if it does not."""
    if chain.start_from is not None and step.result.order >= RUN_STAGES.index(chain.start_from):
        return "asked for"
    return (recipe or _recipe(chain, step, look)).why(look(step.path))


def _unchanged(step: Step, stored: Mapping[str, Any]) -> StageRun:
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


def _store_failure(chain: Chain, step: Step, error: Exception, attributes: Mapping[str, Any]) -> str:
    """Return why a step failed, and store it; a failure of the machine is not stored, so that the next run retries."""
    if isinstance(error, ColonnadeError):
        reason = str(error)
    elif isinstance(error, MemoryError):
        reason = SHORT_OF_MEMORY
    else:  # a bug in colonnade: reported as such, the other tests go on
        reason = _internal_error(chain.layout, step, error)
    if _is_machine_failure(error):
        files.remove(step.path)
        return reason
    try:
        files.write_failed(step.path, reason, attributes=attributes)
    except StoreError as unwritable:
        return f"{reason} This failure could not be stored either: {unwritable}"
    return reason


def _is_machine_failure(error: Exception) -> bool:
    """Whether the disk, the memory or an interrupted import caused it, not the data."""
    if isinstance(error, (StoreError, MemoryError, ImportError)):
        return True
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno is not None and not isinstance(cause, FileNotFoundError)


def _internal_error(layout: Layout, step: Step, error: Exception) -> str:
    """Write the traceback to the error.log of the test or specimen; return the message."""
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
