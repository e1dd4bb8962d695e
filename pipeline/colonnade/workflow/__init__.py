"""The workflow: brings the results of a campaign up to date."""

from colonnade.workflow.result import Progress, RunResult, StageRun
from colonnade.workflow.run import run

__all__ = ["Progress", "RunResult", "StageRun", "run"]
