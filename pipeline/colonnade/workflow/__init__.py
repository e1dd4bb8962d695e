"""The workflow: what is out of date, in which order it is recomputed, and in how many processes."""

from colonnade.workflow.chain import RunResult, StageRun
from colonnade.workflow.run import run

__all__ = ["RunResult", "StageRun", "run"]
