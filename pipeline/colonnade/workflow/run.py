"""Run a campaign: tests in parallel, specimens in between, summary and report at the end."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Annotated

from pydantic import Field, validate_call

from colonnade.campaign import Campaign, load
from colonnade.campaign.forms.summary import Summary
from colonnade.errors import CampaignError, nearest
from colonnade.store.forecasts import read_forecasts
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice
from colonnade.store.results import RUN_STAGES
from colonnade.workflow.chain import RunResult, remove_results
from colonnade.workflow.executors import Where
from colonnade.workflow.graph import copies, expect_known
from colonnade.workflow.pages import Report, photos_shown
from colonnade.workflow.summary import choose, finding_of, foreseen_of, write_summary
from colonnade.workflow.walk import Progress, Walk, walking

MOST_WORKERS = 10_000
"""Processes; no machine has as many cores."""


@validate_call(config={"strict": True})
def run(
    campaign: Path | str,
    *,
    until: str | None = None,
    start_from: str | None = None,
    only: Sequence[str] | str = (),
    workers: Annotated[int, Field(ge=1, le=MOST_WORKERS)] | None = None,
    scheduler: str | None = None,
    verify: bool = False,
    awaiting: bool = False,
    results: Path | str | None = None,
    progress: Progress | None = None,
) -> RunResult:
    """
    Run what is out of date in a campaign.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder.
    until, start_from : str, optional
        Last stage, and first stage whose results are recomputed whatever their state; each one of `RUN_STAGES`.
    only : str or sequence of str, optional
        Ids of the tests to run; default all. Free vibrations of their specimens are run too, as far as e.
    workers : int, optional
        Processes; default one a core.
    scheduler : str, optional
        Address of a running Dask scheduler, whose workers are used instead. They share the campaign's folder.
    verify : bool, optional
        Read every raw file, result and page again, whatever its size and time; what was altered is recomputed.
    awaiting : bool, optional
        Take every test without its raw file for planned: it is pending, not failed.
    results : Path or str, optional
        Folder that holds `processed` and `report`, such as one on another disk; default that of the campaign file.
    progress : callable, optional
        Called with each stage that ended, the number of tests done, and their total.

    Returns
    -------
    result : RunResult

    Raises
    ------
    ValueError
        If an argument has the wrong type.
    CampaignError
        If the campaign file is not usable, or a stage or test is unknown.
    StoreError
        If another run is in progress, or results cannot be written.

    Examples
    --------
    >>> from colonnade.errors import CampaignError
    >>> try:
    ...     run("no-such-folder", until="restitution")
    ... except CampaignError as error:
    ...     print(str(error)[:25])
    no-such-folder: not found
    """
    loaded = load(Path(campaign)).awaiting() if awaiting else load(Path(campaign))
    last = _last_stage(start_from, until)
    tests = _chosen(loaded, (only,) if isinstance(only, str) else only)
    layout, report, notices = Layout.of(loaded.path, results), None, list[str]()
    with walking(loaded, layout, Where(workers, scheduler), verify=verify) as walk:
        walk.start_from, walk.until, walk.progress = start_from, last, progress
        notices += walk.graph.catalogue.remove_altered()
        for name in loaded.tests.keys() - walk.included:
            remove_results(layout, name)
        walk.through(tests)
        outdated, summary = _summed_up(walk, awaiting=awaiting)
        if last == "report":
            report = _reported(walk, outdated, summary)
    loaded = walk.graph.campaign
    concerning = {name: loaded.concerning(name) for name in loaded.tests}
    return RunResult(tuple(walk.stages), layout.summary_json, report, loaded.warnings, concerning, tuple(notices))


def _summed_up(walk: Walk, *, awaiting: bool) -> tuple[set[str], Summary]:
    """
    Score forecasts, assess real columns, and write the summary.

    Return the tests that are out of date, too.
    """
    graph, layout = walk.graph, walk.graph.layout
    raw = {name: graph.raw(test) for name, test in graph.campaign.tests.items()}
    forecasts = read_forecasts(layout)
    walk.warn([*copies(graph.campaign, raw), *map(finding_of, forecasts.refused)])
    outdated = walk.stale() | (graph.campaign.tests.keys() - walk.included)
    chosen = choose(graph.campaign, forecasts, raw)
    walk.score(chosen.scored, outdated)
    if not awaiting:  # while tests arrive, the answers about real columns wait for the last of them
        walk.assess(graph.campaign.assessments)
    summary = write_summary(
        walk.graph,
        outdated=outdated,
        failed=walk.failed["test"],
        unassessed=walk.stale_assessments(),
        foreseen=foreseen_of(layout, forecasts, chosen),
        workers=walk.where.workers,
    )
    return outdated, summary


def _reported(walk: Walk, outdated: Collection[str], summary: Summary) -> Path:
    """Bring maps, photos, advice and pages up to date."""
    from colonnade.workflow.maps import kept_maps

    known = [name for name in walk.graph.campaign.specimens if name not in walk.failed["specimen"]]
    walk.follow([product] for product in kept_maps(walk.graph, summary, known))
    photos, unshown = photos_shown(walk.graph)
    walk.warn(unshown)
    graph, campaign, workers = walk.graph, walk.graph.campaign, walk.where.workers
    advice: list[Advice] = []
    if campaign.awaited or campaign.next.model_fields_set or campaign.table.model_fields_set:
        from colonnade.workflow.advising import advise

        advice = advise(campaign, graph.layout, graph.catalogue, workers=workers)
    return Report(graph, outdated, summary.forecasts, advice, photos, workers).bring_up_to_date()


def _last_stage(start_from: str | None, until: str | None) -> str:
    for name, stage in {"start_from": start_from, "until": until}.items():
        if stage is not None and stage not in RUN_STAGES:
            raise CampaignError(f'{name}: unknown stage "{stage}".{nearest(stage, RUN_STAGES)}')
    last = until or "report"
    if start_from is not None and RUN_STAGES.index(start_from) > RUN_STAGES.index(last):
        raise CampaignError(f"from {start_from} until {last}: the last stage comes before the first.")
    return last


def _chosen(campaign: Campaign, only: Sequence[str]) -> list[str]:
    expect_known(campaign, "test", only)
    for name in only:
        if excluded := campaign.review(name).excluded:
            raise CampaignError(f"{name} is {excluded}. To run it again, delete that [[exclude]] from review.toml.")
        if awaited := campaign.left_out(name):
            raise CampaignError(f"{name} is planned and has no raw file yet; {awaited}.")
    return [name for name in campaign.tests if (not only or name in only) and not campaign.left_out(name)]
