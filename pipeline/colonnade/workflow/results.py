"""What a run says of itself."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Action = Literal["done", "up-to-date", "failed"]


@dataclass(frozen=True)
class StageRun:
    """
    What became of one stage of one test or specimen.

    Attributes
    ----------
    subject : str
        Id of the test or specimen.
    stage : str
        Name of the stage; "specimen" for what pools a specimen's free vibrations.
    action : str
        done, up-to-date or failed, now or in an earlier run.
    model : str or None
        Where the stage runs once a model.
    reason : str
        Why it failed.
    because : str
        Why it ran: "never run", "raw file changed", "settings changed", "upstream changed", "code changed" or "asked
        for"; empty where it did not.
    seconds : float
    """

    subject: str
    stage: str
    action: Action
    model: str | None = None
    reason: str = ""
    because: str = ""
    seconds: float = 0.0


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
        The report's page, None where the run stopped before it.
    """

    stages: tuple[StageRun, ...]
    summary: Path
    report: Path | None

    @property
    def failed(self) -> bool:
        """Whether a stage failed, now or in an earlier run whose failure still stands."""
        return any(stage.action == "failed" for stage in self.stages)
