"""The workflow: what is out of date, in which order, in how many processes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import chain as joined
from pathlib import Path

from colonnade.campaign import Campaign, load
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.chain import Chain, walk
from colonnade.workflow.lock import run_lock
from colonnade.workflow.plan import Plan
from colonnade.workflow.processes import execute
from colonnade.workflow.rawfiles import RawIndex
from colonnade.workflow.result import Progress, RunResult, StageRun
from colonnade.workflow.selection import Selection, select
from colonnade.workflow.summary import write_summary
from colonnade.workflow.survey import survey
from colonnade.workflow.table import STAGES, Table


def run(
    campaign_path: Path | str,
    *,
    until: str | None = None,
    start_from: str | None = None,
    only: Iterable[str] = (),
    workers: int | None = None,
    verify: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """
    Bring the results of a campaign up to date.

    Parameters
    ----------
    campaign_path : Path or str
        A campaign.toml or its folder.
    until : str, optional
        Last stage: ingest, condition, rocking, restitution, predict, compare or report (the default).
    start_from : str, optional
        Stage that is redone, with what follows, even where it is up to date.
    only : iterable of str, optional
        Tests. The free vibrations of their specimens are brought up to date with them, as far as predictions need it.
    workers : int, optional
        Processes; one a core by default.
    verify : bool, optional
        Hash every raw file and every stored result again.
    progress : callable, optional
        Called with each StageRun, the number of stages that have ended and the number of all.

    Returns
    -------
    result : RunResult
        A test that fails is told in it, and does not stop the others.

    Raises
    ------
    CampaignError
        If the campaign file, a stage or a test is wrong.
    StoreError
        If another run is writing there, or results cannot be written at all.
    """
    campaign = load(Path(campaign_path))
    selection = select(campaign, until, start_from, only)
    return run_stages(campaign, STAGES, selection, workers=workers, verify=verify, progress=progress or _unheard)


def run_stages(
    campaign: Campaign,
    table: Table,
    selection: Selection,
    *,
    workers: int | None,
    verify: bool,
    progress: Progress,
) -> RunResult:
    """Run the stages of a table; see `run`."""
    layout = Layout(campaign.folder)
    with run_lock(layout):
        files.sweep(layout.processed)
        index = RawIndex(campaign.folder, layout.raw_index, verify=verify)
        plan = Plan(campaign, table, layout, index, selection, verify)
        stages = _execute_all(plan, selection, workers, progress)
        index.save()
        found = survey(plan.of_all, stages)
        write_summary(campaign, layout, found)
        report = _report(campaign, layout) if selection.includes("report") else None
    failed = any(stage.action in ("failed", "skipped") for stage in stages)
    return RunResult(tuple(stages), layout.summary_json, report, failed)


def _execute_all(plan: Plan, selection: Selection, workers: int | None, progress: Progress) -> list[StageRun]:
    specimens = list(dict.fromkeys(plan.campaign.tests[test].specimen for test in selection.tests))
    pooling = specimens if selection.includes("restitution") else []
    measured = [plan.measured(test) for test in selection.needed]
    predicted = [plan.predicted(test) for test in selection.tests]
    total = sum(len(chain.steps) for chain in measured + predicted) + len(pooling)
    bench = _Bench(total, workers, progress)
    bench.bring_up_to_date(measured)
    restitutions = {stage.subject: stage.action for stage in bench.ended if stage.stage == "restitution"}
    pools = [
        plan.pooled(
            specimen,
            [test for test in plan.campaign.tests_of(specimen) if restitutions.get(test) in ("done", "up-to-date")],
        )
        for specimen in pooling
    ]
    bench.bring_up_to_date(pools, here=True)
    bench.bring_up_to_date(predicted)
    order = {subject: number for number, subject in enumerate(joined(selection.needed, specimens))}
    return sorted(bench.ended, key=lambda stage: order[stage.subject])


@dataclass
class _Bench:
    """Executes chains and counts what has ended."""

    total: int
    workers: int | None
    progress: Callable[[StageRun, int, int], None]
    ended: list[StageRun] = field(default_factory=list)

    def bring_up_to_date(self, chains: Iterable[Chain], *, here: bool = False) -> None:
        """Execute those of the chains that are out of date; `here`: in this process."""
        stale = []
        for chain in chains:
            looked = walk(chain, execute=False)
            if any(stage.action in ("pending", "skipped") for stage in looked):
                stale.append(chain)
            else:
                self._note(looked)
        for ended in execute(stale, 1 if here else self.workers):
            self._note(ended)

    def _note(self, stages: list[StageRun]) -> None:
        for stage in stages:
            self.ended.append(stage)
            self.progress(stage, len(self.ended), self.total)


def _report(campaign: Campaign, layout: Layout) -> Path:
    # Drawing libraries load slowly, and no worker needs them.
    from colonnade.report.build import build

    return build(campaign, layout)


def _unheard(stage: StageRun, done: int, total: int) -> None:
    """Take progress where nobody listens."""
