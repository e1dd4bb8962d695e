"""Check: what a run would refuse or warn of, found by doing the measuring part of it in memory; nothing is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.errors import ReadError, StageError
from colonnade.findings import Finding, Severity, at_stage, note
from colonnade.interruption import expect_none
from colonnade.readers.recording import Recording
from colonnade.workflow.steps import models_of


@dataclass
class Checked:
    """
    What is to be said of one test.

    Attributes
    ----------
    problems : list of str
        Why it would fail.
    findings : list of Finding
        What a run would warn of, as far as it shows without identification and prediction.
    concerning : tuple of Finding
        What is to be said of its specimen and set-up in the campaign file.
    """

    problems: list[str] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    concerning: tuple[Finding, ...] = ()

    @property
    def status(self) -> str:
        """In a word: would fail, doubtful (results would be wrong) or good."""
        if self.problems:
            return "would fail"
        is_doubtful = any(found.severity is Severity.SERIOUS for found in (*self.findings, *self.concerning))
        return "doubtful" if is_doubtful else "good"


Reading = Callable[[Path, str, str], Recording]


def check(campaign: Campaign, advance: Callable[[], None] = lambda: None) -> dict[str, Checked]:
    """
    Read every raw file of a campaign and take each test as far as its prediction would begin.

    Parameters
    ----------
    campaign : Campaign
    advance : callable, optional
        Called after each test.

    Returns
    -------
    checked : dict of str to Checked
        By test.
    """
    from colonnade.readers.registry import read

    @lru_cache(maxsize=2)  # tests that share a file stand beside each other in most campaigns
    def reading(path: Path, setup: str, recorder: str) -> Recording:
        file = campaign.setups[setup].recorders[recorder].file
        return read(path, file.format, file.options, within=campaign.folder)

    found = {}
    for name, test in campaign.tests.items():
        expect_none()
        if excluded := campaign.review(name).excluded:
            found[name] = Checked(findings=[note("excluded", f"{excluded} (review.toml).")])
        else:
            found[name] = _checked(campaign, test, reading)
        advance()
    return found


def _checked(campaign: Campaign, test: Test, reading: Reading) -> Checked:
    checked = Checked(concerning=campaign.concerning(test.id))
    recordings: dict[str, Recording] = {}
    for recorder, path in test.files.items():
        try:
            recordings[recorder] = reading(path, test.setup, recorder)
        except ReadError as error:
            checked.problems.append(str(error))
    checked.problems += _missing_columns(campaign, test, recordings)
    if not checked.problems:
        try:
            _measure(campaign, test, recordings, checked.findings)
        except (ReadError, StageError) as error:
            checked.problems.append(str(error))
    return checked


def _missing_columns(campaign: Campaign, test: Test, recordings: dict[str, Recording]) -> list[str]:
    """Find every column of a test that its files do not have; `ingest` stops at the first."""
    problems = []
    for name, channel in campaign.channels(test).items():
        for column in (channel.column, channel.time):
            if channel.recorder in recordings and column is not None:
                try:
                    recordings[channel.recorder].channel(column)
                except ReadError as error:
                    problems.append(f"channel {name}: {error}")
    return problems


def _measure(campaign: Campaign, test: Test, recordings: dict[str, Recording], findings: list[Finding]) -> None:
    """
    Do what a run does up to the start of a prediction; what each stage warns of is added to the findings.

    Raises
    ------
    ReadError, StageError
        As the stages do.
    """
    from colonnade.stages import condition, ingest, predict, restitution, rocking
    from colonnade.stages.beginning import begin

    recorded = ingest.ingest(recordings, ingest.instructions(campaign, test))
    findings += at_stage(recorded.attrs["warnings"], "ingest")
    conditioned = condition.condition(recorded, condition.instructions(campaign, test))
    findings += at_stage(conditioned.attrs["warnings"], "condition")
    measured = rocking.rocking(conditioned, rocking.instructions(campaign, test))
    findings += at_stage(measured.attrs["warnings"], "rocking")
    if test.kind == "free-vibration":
        restitution.expect_angle(measured)
    for model in models_of(campaign, test)[:1]:  # the base motion and the start are the same for all
        beginning = begin(measured, predict.instructions(campaign, test, model))
        findings += at_stage(beginning.warnings, "predict")
