"""The steps of one test, one after the other, in a process of their own."""

from __future__ import annotations

import json
import time
import traceback
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal

from colonnade.campaign import Campaign
from colonnade.errors import ColonnadeError, RunEndedError, StoreError
from colonnade.findings import Finding, at_stage
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import global_attributes
from colonnade.store.results import ASKED_FOR
from colonnade.workflow.execution.lock import expect_run
from colonnade.workflow.freshness import Look, RawFile, ingredients, key_of, stored_attributes, why_stale
from colonnade.workflow.results import Action, StageRun
from colonnade.workflow.steps import Step, measuring_steps, predicting_steps

Phase = Literal["measuring", "predicting"]

_SHORT_OF_MEMORY = (
    "The machine ran short of memory. What was finished is kept; run again with fewer workers (`--workers 1` takes the "
    "least), or with less else open."
)

_WORKER_LOST = (
    "The system stopped the process that worked on this test, and again when it was tried alone: memory ran out, or a "
    "damaged raw file crashed the library that reads it. Run again with less else open; if it stays so, copy the raw "
    "file from the recorder again, or export it as text."
)


@dataclass(frozen=True)
class Chain:
    """
    The steps of one test that a worker walks through.

    Attributes
    ----------
    campaign : Campaign
        With no other test in it, so that it is light to send.
    layout : Layout
    test : str
    phase : str
        From raw files to what was measured, or from there to the comparison.
    until : str
        Last stage.
    run : str
        The run that it belongs to; nothing is written once that has ended.
    redo_from : str or None
        Stage from which on results are made again whatever their state.
    raw : mapping of str to RawFile
        The raw files by path, as they were hashed.
    """

    campaign: Campaign
    layout: Layout
    test: str
    phase: Phase
    until: str
    run: str
    redo_from: str | None
    raw: Mapping[str, RawFile]

    @classmethod
    def of(cls, campaign: Campaign, layout: Layout, test: str, **rest: Any) -> Chain:
        """Build the chain of one test."""
        alone = replace(campaign, tests={test: campaign.tests[test]}, reviews={test: campaign.review(test)})
        return cls(alone, layout, test, **rest)

    def steps(self) -> list[Step]:
        """Return the steps up to `until`."""
        build = measuring_steps if self.phase == "measuring" else predicting_steps
        last = ASKED_FOR.index(self.until)
        return [
            step for step in build(self.campaign, self.layout, self.campaign.tests[self.test]) if step.order <= last
        ]


def walk(chain: Chain) -> list[StageRun]:
    """
    Bring a chain up to date, up to the first step that fails; what lies behind a failure is taken away.

    Raises
    ------
    RunEndedError
        If the run that it belongs to has ended.
    """
    with files.only_while(partial(expect_run, chain.layout, chain.run)):
        return _walked(chain)


def _walked(chain: Chain) -> list[StageRun]:
    runs: list[StageRun] = []
    for step in chain.steps():
        expect_run(chain.layout, chain.run)
        run = advance(chain.campaign, chain.layout, chain.test, step, redo_from=chain.redo_from, raw=chain.raw)
        runs.append(run)
        if run.action == "failed":
            clear_behind(chain.campaign, chain.layout, chain.test, step.order)
            return runs
    files.remove(chain.layout.error_log(chain.test))
    return runs


def lost(chain: Chain) -> StageRun:
    """Say of a chain whose process was stopped at which step that was; nothing is kept, so that the next run tries."""
    steps = chain.steps()
    stopped = next(
        (step for step in steps if _state(step, chain.redo_from, chain.raw, stored_attributes).because), steps[-1]
    )
    clear_behind(chain.campaign, chain.layout, chain.test, stopped.order - 1)
    return StageRun(chain.test, stopped.stage, "failed", stopped.model, _WORKER_LOST)


def clear_behind(campaign: Campaign, layout: Layout, test: str, order: int) -> None:
    """Take away a test's results of stages after the one of this order: nothing may follow from a failure."""
    for build in (measuring_steps, predicting_steps):
        for step in build(campaign, layout, campaign.tests[test]):
            if step.order > order:
                files.remove(step.path)


def is_fresh(chain: Chain, look: Look) -> list[StageRun] | None:
    """Return what `walk` would say of a chain whose results, as `look` tells of them, are up to date; else None."""
    runs: list[StageRun] = []
    for step in chain.steps():
        state = _state(step, chain.redo_from, chain.raw, look)
        if state.because:
            return None
        runs.append(_standing(chain.test, step, state.stored))
        if runs[-1].action == "failed":
            break
    return runs


def advance(
    campaign: Campaign,
    layout: Layout,
    subject: str,
    step: Step,
    *,
    redo_from: str | None,
    raw: Mapping[str, RawFile],
) -> StageRun:
    """Bring one result up to date."""
    expect_none()
    state = _state(step, redo_from, raw, stored_attributes)
    if not state.because:
        return _standing(subject, step, state.stored)
    started = time.perf_counter()
    attributes = _attributes(campaign, subject, step, state)
    reason = ""
    found: list[Finding] = []
    try:
        upstream: Mapping[str, Any] = step.upstream
        if not step.is_from_raw:
            upstream = {name: files.read(path) for name, path in step.upstream.items()}
        result = step.work(upstream, step.instructions)
        if step.is_from_raw:
            _expect_unchanged(campaign, raw)
        files.write(result, step.path, attributes=attributes)
        found = at_stage(result.attrs.get("warnings", []), step.stage)
        if step.is_of_specimen:
            files.remove(layout.specimen_error_log(subject))
    except RunEndedError:
        raise
    except Exception as error:
        expect_none()  # an interrupt in the import of a compiled module comes as an ImportError
        if isinstance(error, ColonnadeError):
            reason = str(error)
        elif isinstance(error, MemoryError):
            reason = _SHORT_OF_MEMORY
        else:  # a defect of ours: told as such, the other tests go on
            reason = _internal_error(layout, subject, step, error)
        if _is_of_the_machine(error):
            files.remove(step.path)
        else:
            reason = _store_failure(step, reason, attributes)
    seconds = time.perf_counter() - started
    action: Action = "failed" if reason else "done"
    return StageRun(subject, step.stage, action, step.model, reason, state.because, seconds, tuple(found))


def _is_of_the_machine(error: Exception) -> bool:
    """Whether disk, memory or an interrupted import failed: that says nothing of the data, so the next run tries."""
    if isinstance(error, (StoreError, MemoryError, ImportError)):
        return True
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno is not None and not isinstance(cause, FileNotFoundError)


def _expect_unchanged(campaign: Campaign, raw: Mapping[str, RawFile]) -> None:
    for name, file in raw.items():
        if not file.is_still(campaign.folder / name):
            raise StoreError(
                f"{name}: it changed while it was read, perhaps as the recorder is still writing. Run again after that."
            )


@dataclass(frozen=True)
class _State:
    """Attributes of a stored result, what a new one would be made from, and why it is needed, if it is."""

    stored: Mapping[str, Any]
    made_from: Mapping[str, Any]
    key: str
    because: str


def _state(step: Step, redo_from: str | None, raw: Mapping[str, RawFile], look: Look) -> _State:
    upstream: dict[str, str | None]
    if step.is_from_raw:
        upstream = {name: file.sha256 for name, file in raw.items()}
    else:
        upstream = {name: look(path).get("content") for name, path in step.upstream.items()}
    made_from = ingredients(step.instructions.model_dump_json(), upstream)
    key = key_of(step.stage, made_from)
    stored = look(step.path)
    if redo_from is not None and step.order >= ASKED_FOR.index(redo_from):
        because = "asked for"
    else:
        because = "" if stored.get("key") == key else why_stale(stored, made_from, from_raw=step.is_from_raw)
    return _State(stored, made_from, key, because)


def _standing(subject: str, step: Step, stored: Mapping[str, Any]) -> StageRun:
    if stored.get("status") == "failed":
        return StageRun(subject, step.stage, "failed", step.model, str(stored.get("reason", "")))
    findings = tuple(at_stage(stored.get("warnings", ()), step.stage))
    return StageRun(subject, step.stage, "up-to-date", step.model, findings=findings)


def _attributes(campaign: Campaign, subject: str, step: Step, state: _State) -> dict[str, Any]:
    attributes: dict[str, Any] = dict(
        global_attributes(
            campaign=campaign.campaign,
            title=campaign.title,
            facility=campaign.facility,
            stage=step.stage,
            test=None if step.is_of_specimen else subject,
            specimen=subject if step.is_of_specimen else None,
        )
    )
    attributes |= {
        "key": state.key,
        "ingredients": json.dumps(state.made_from, sort_keys=True),
        "settings": step.instructions.model_dump_json(),
    }
    if step.is_from_raw:
        upstream = state.made_from["upstream"]
        attributes |= {"raw_files": list(upstream), "raw_sha256": [digest or "" for digest in upstream.values()]}
    return attributes


def _store_failure(step: Step, reason: str, attributes: Mapping[str, Any]) -> str:
    try:
        files.write_failed(step.path, reason, attributes=attributes)
    except StoreError as error:
        return f"{reason} And the failure itself could not be stored: {error}"
    return reason


def _internal_error(layout: Layout, subject: str, step: Step, error: Exception) -> str:
    """Write the traceback to the error.log of the test or specimen; return what to tell."""
    frames = traceback.extract_tb(error.__traceback__)
    place = f"{frames[-1].filename.rpartition('colonnade')[2].lstrip('/')}:{frames[-1].lineno}" if frames else "?"
    log = layout.specimen_error_log(subject) if step.is_of_specimen else layout.error_log(subject)
    where = f"its traceback is in {log.relative_to(layout.home).as_posix()}"
    try:
        files.write_text(log, "".join(traceback.format_exception(error)))
    except StoreError:
        where = "its traceback could not be written"
    return (
        f"Internal error in {step.stage}, {type(error).__name__} at {place}: {error}. This is a defect of colonnade, "
        f"not of your campaign; {where}. Please report it with that file."
    )
