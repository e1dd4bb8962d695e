"""What a run tells about itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Action = Literal["done", "up-to-date", "failed", "skipped", "pending"]


@dataclass(frozen=True)
class StageRun:
    """
    What became of one stage of one test or specimen.

    Attributes
    ----------
    subject : str
        Id of the test or specimen.
    stage : str
        "specimen" for what pools a specimen's free vibrations.
    action : str
        done (executed now), up-to-date, failed (now, or before from the same input), skipped (something it needs
        failed), pending (out of date, and not asked for).
    model : str or None
        Where the stage runs once a model.
    reason : str
        Why it failed or was skipped.
    because : str
        Why it was executed: never run, raw file changed, settings changed, upstream changed, code changed, …
    seconds : float
        How long that took.
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
    What became of a run.

    Attributes
    ----------
    stages : tuple of StageRun
        Every stage that was looked at, in the order of the tests.
    summary : Path
        processed/summary.json.
    report : Path or None
        The page, where the run went that far.
    failed : bool
        Whether some test or specimen of this run failed, now or before.
    """

    stages: tuple[StageRun, ...]
    summary: Path
    report: Path | None
    failed: bool


Progress = Callable[[StageRun, int, int], None]
"""Called as stages end, with how many of all have ended."""
