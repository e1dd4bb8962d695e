"""One test, as fast as it goes: measured, identified, predicted in the plane; and the line that says what is known."""

from __future__ import annotations

import json
import shlex
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import RestitutionSummary, TestSummary
from colonnade.errors import CampaignError
from colonnade.findings import Severity
from colonnade.store.layout import Layout
from colonnade.store.records import wording
from colonnade.store.records.stored import Failure, Stored
from colonnade.store.records.test import record_of_specimen, record_of_test
from colonnade.units.text import listed, number
from colonnade.workflow.executors import Where
from colonnade.workflow.graph import Graph
from colonnade.workflow.pooling import restitution_taken
from colonnade.workflow.product import Catalogue
from colonnade.workflow.walk import Walk, walking

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Line:
    """
    What is known of a test that was just recorded.

    Attributes
    ----------
    test : str
        Its id.
    record : TestSummary
        As it will be in the summary, without what takes longer.
    restitution : RestitutionSummary
        The e of its specimen that is known so far.
    seconds : float
        From the last change of its files to this line.
    """

    test: str
    record: TestSummary
    restitution: RestitutionSummary
    seconds: float

    def text(self) -> str:
        """Write it for people."""
        record, level = self.record, self.restitution.level
        why = record.reason or (record.restitution.reason if record.restitution else None)
        parts = [wording.measured(record, level) + (f": {why}" if why else "")]
        parts += [f"{model} {said}" for model, said in wording.predicted(record).items()]
        so_far = [] if record.restitution is None else [f"{record.specimen} {wording.pooled(self.restitution)}"]
        parts += [self._place(), *so_far, *self._warnings()]
        return f"{self.test}: {'; '.join(filter(None, parts))} ({number(self.seconds, 2)} s)"

    def as_json(self) -> dict[str, Any]:
        """Give it for programs."""
        return {
            "test": self.test,
            "seconds": round(self.seconds, 2),
            **self.record.model_dump(mode="json"),
            "specimen_restitution": self.restitution.model_dump(mode="json"),
        }

    def _place(self) -> str:
        ratio = self.record.amplitude_ratio
        if ratio is None or self.record.frequency_ratio is None:
            return ""
        return f"Ω {number(self.record.frequency_ratio)}, A {number(ratio)}"

    def _warnings(self) -> list[str]:
        worst = [each for each in self.record.warnings if each.severity is not Severity.NOTE and not each.explained]
        shown = [f"{each.severity}: {each.text.rstrip('.')}" for each in worst[:2]]
        return [*shown, f"and {listed([each.kind for each in worst[2:]])}"] if len(worst) > 2 else shown


def measure(campaign: Campaign, layout: Layout, name: str, finished: float) -> Line:
    """
    Bring one test up to date as far as it takes seconds, and say what is known of it then.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    name : str
        Id of the test.
    finished : float
        When its files were last changed, s since 1970.

    Raises
    ------
    StoreError
        If a run holds the campaign, or results cannot be written.
    """
    test = campaign.tests[name]
    with walking(campaign, layout, Where(workers=1)) as walk:
        made = walk.at_once(name)
    stored = Stored()
    for result in made:
        stored.add(result, layout.path(result))
    if reason := walk.failed["test"].get(name, ""):
        stored.failures = stored.failures or [Failure("", reason)]
    else:
        _compare(campaign, test, stored)
    record = record_of_test(campaign, test, stored)
    pooled = restitution_taken(campaign, layout, test.specimen)
    known = record_of_specimen(campaign, test.specimen, pooled).restitution
    return Line(name, record, known, time.time() - finished)


def measured(campaign: Campaign, layout: Layout) -> set[str]:
    """Give the tests that nothing has to be measured of: their results are up to date, or they are left out."""
    walk = Walk(Graph(campaign, layout, Catalogue(layout)), "")
    return set(campaign.tests) - walk.stale(until="restitution")


def _compare(campaign: Campaign, test: Test, stored: Stored) -> None:
    """Add the comparison with the models that have run; it is not kept, as the whole one follows."""
    from colonnade.stages.compare import CompareInputs, compare

    predicted: dict[str, xr.Dataset] = {model: stored.datasets["predict", model] for model in stored.models("predict")}
    if ("rocking", None) in stored.datasets:
        measured = stored.datasets["rocking", None]
        stored.datasets["compare", None] = compare(measured, predicted, CompareInputs.of(campaign, test))


PATIENCE = 10.0
"""Seconds after which the command is ended."""


def command_of(text: str) -> list[str]:
    """
    Split a command into program and arguments; no shell reads it.

    Raises
    ------
    CampaignError
        If it is empty or a quote is not closed.

    Examples
    --------
    >>> command_of("notify-send 'A test'")
    ['notify-send', 'A test']
    """
    try:
        parts = shlex.split(text)
    except ValueError as error:
        raise CampaignError(f"--notify {text!r}: this is not a command ({error}).") from None
    if not parts:
        raise CampaignError("--notify: it is empty. A program and its arguments were expected.")
    return parts


def notify(command: Sequence[str], line: Mapping[str, Any]) -> str:
    """Give a line to a command, and wait for it; return what went wrong, empty if nothing did."""
    try:
        done = subprocess.run(
            command,
            input=json.dumps(line, ensure_ascii=False),
            encoding="utf-8",
            errors="replace",
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=PATIENCE,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"{command[0]} was ended: it took longer than {PATIENCE:g} s."
    except OSError as error:
        return f"{command[0]} could not be started ({error.strerror or error})."
    if done.returncode:
        said = (done.stderr or "").strip().splitlines()
        return f"{command[0]} ended with {done.returncode}{f': {said[-1][:200]}' if said else ''}."
    return ""
