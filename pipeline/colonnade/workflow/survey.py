"""What of a campaign is there, and holds, after a run."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from colonnade.store import files
from colonnade.workflow.chain import INTERNAL_ERROR, walk
from colonnade.workflow.plan import Plan
from colonnade.workflow.result import StageRun


@dataclass(frozen=True)
class Finding:
    """A stage of a test or specimen as it stands, and the file that holds it."""

    run: StageRun
    path: Path

    @property
    def is_done(self) -> bool:
        """Whether its result is there and holds."""
        return self.run.action == "up-to-date"


@dataclass(frozen=True)
class Survey:
    """All stages by test and by specimen."""

    tests: dict[str, list[Finding]]
    specimens: dict[str, Finding]


def survey(plan: Plan, run: Iterable[StageRun]) -> Survey:
    """
    Look at every result of a campaign.

    Parameters
    ----------
    plan : Plan
        Of all stages.
    run : iterable of StageRun
        What has just run: failures that left nothing on disk are known from it alone.

    Returns
    -------
    found : Survey
        Actions are up-to-date, failed, skipped or pending. Results that follow from one that failed are removed.
    """
    failures = {_name(stage): stage for stage in run if stage.action == "failed"}
    outdated: set[Path] = set()

    def look(chain_of_one: list[tuple[StageRun, Path]]) -> list[Finding]:
        found = []
        for stage, path in chain_of_one:
            stood = failures.get(_name(stage), stage) if stage.action == "pending" else stage
            if stood.action == "pending":
                outdated.add(path)
            elif stood.action == "skipped":
                files.remove(path)
            found.append(Finding(stood, path))
        return found

    campaign = plan.campaign
    tests, specimens = {}, {}
    for name in campaign.tests:
        tests[name] = look(_walked(plan.measured(name), outdated))
    for name in campaign.specimens:
        usable = [
            test
            for test in campaign.tests_of(name)
            for found in tests[test]
            if found.run.stage == "restitution" and found.run.action in ("up-to-date", "pending")
        ]
        specimens[name] = look(_walked(plan.pooled(name, usable), outdated))[0]
    for name in campaign.tests:
        tests[name] += look(_walked(plan.predicted(name), outdated))
        if not any(found.run.reason.startswith(INTERNAL_ERROR) for found in tests[name]):
            files.remove(plan.layout.error_log(name))
    return Survey(tests, specimens)
