"""One test, as fast as it goes: measured, identified, predicted in the plane; and the line that says what is known."""

from __future__ import annotations

import json
import shlex
import subprocess
from collections.abc import Mapping, Sequence
from contextlib import suppress
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
from colonnade.workflow.graph import Graph, restitution_taken
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
    """

    test: str
    record: TestSummary
    restitution: RestitutionSummary

    def text(self) -> str:
        """Write it for people."""
        record, level = self.record, self.restitution.level
        why = record.reason or (record.restitution.reason if record.restitution else None)
        parts = [wording.measured(record, level) + (f": {why}" if why else "")]
        parts += [f"{model} {said}" for model, said in wording.predicted(record).items()]
        if record.frequency_ratio is not None and record.amplitude_ratio is not None:
            parts.append(f"Ω {number(record.frequency_ratio)}, A {number(record.amplitude_ratio)}")
        if record.restitution is not None:
            parts.append(f"{record.specimen} {wording.pooled(self.restitution)}")
        worst = [each for each in record.warnings if each.severity is not Severity.NOTE and not each.explained]
        parts += [f"{each.severity}: {each.text.rstrip('.')}" for each in worst[:2]]
        parts += [f"and {listed([each.kind for each in worst[2:]])}"] if worst[2:] else []
        return f"{self.test}: {'; '.join(parts)}"

    def as_json(self) -> dict[str, Any]:
        """Give it for programs."""
        known = self.restitution.model_dump(mode="json")
        return {"test": self.test, **self.record.model_dump(mode="json"), "specimen_restitution": known}


def measure(campaign: Campaign, layout: Layout, name: str) -> Line:
    """
    Bring one test up to date as far as it takes seconds, and say what is known of it then.

    Raises
    ------
    StoreError
        If a run holds the campaign, or results cannot be written.
    """
    test, stored = campaign.tests[name], Stored()
    with walking(campaign, layout, Where(workers=1)) as walk:
        made = walk.at_once(name)
    for result in made:
        stored.add(result, layout.path(result))
    if reason := walk.failed["test"].get(name, ""):
        stored.failures = stored.failures or [Failure("", reason)]
    else:
        _compare(campaign, test, stored)
    pooled = restitution_taken(campaign, layout, test.specimen)
    known = record_of_specimen(campaign, test.specimen, pooled).restitution
    return Line(name, record_of_test(campaign, test, stored), known)


def measured(campaign: Campaign, layout: Layout) -> set[str]:
    """Give the tests that nothing has to be measured of: their results are up to date, or they are left out."""
    walk = Walk(Graph(campaign, layout, Catalogue(layout)), "")
    return set(campaign.tests) - walk.stale(until="restitution")


def _compare(campaign: Campaign, test: Test, stored: Stored) -> None:
    """Add the comparison with the models that have run; it is not kept, as the whole one follows."""
    from colonnade.stages.compare import CompareInputs, compare

    predicted: dict[str, xr.Dataset] = {model: stored.datasets["predict", model] for model in stored.models("predict")}
    if stored.has("rocking"):
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
    with suppress(ValueError):
        if parts := shlex.split(text):
            return parts
    raise CampaignError(f"--notify {text!r}: A program and its arguments were expected, with each quote closed.")


def notify(command: Sequence[str], line: Mapping[str, Any]) -> str:
    """Give a line to a command, and wait for it; return what went wrong, empty if nothing did."""
    text = json.dumps(line, ensure_ascii=False).encode()
    try:
        subprocess.run(command, input=text, stdout=subprocess.DEVNULL, timeout=PATIENCE, check=True)
    except subprocess.TimeoutExpired:
        return f"--notify: {command[0]} was ended: it took longer than {PATIENCE:g} s."
    except (OSError, subprocess.CalledProcessError) as error:
        return f"--notify: {error}"
    return ""
