"""What a run returns: what became of each stage, and all that was found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from colonnade.findings import Finding, Severity, in_order
from colonnade.store.results import ResultId, Subject

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

    @property
    def of(self) -> Subject:
        """What its subject is."""
        return ResultId(self.subject, self.stage, self.model).of

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
        What happened to the run itself, such as that the system stopped a worker.
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
        return {
            subject: in_order(findings, self.concerning.get(subject, ()))
            for subject, findings in found.items()
            if findings
        }

    @property
    def has_warnings(self) -> bool:
        """Whether any finding is more serious than a note."""
        every = [*self.of_campaign, *(finding for stage in self.stages for finding in stage.findings)]
        return any(finding.severity is not Severity.NOTE for finding in every)
