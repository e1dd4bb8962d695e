"""Run a campaign: tests in parallel, specimens in between, summary and report at the end."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from colonnade.campaign import Campaign, load
from colonnade.errors import CampaignError, nearest
from colonnade.store.layout import Layout
from colonnade.store.results import ASKED_FOR, results_of
from colonnade.workflow.arguments import check_run
from colonnade.workflow.catalogue import Catalogue, remove_altered
from colonnade.workflow.chain import clear_behind
from colonnade.workflow.copies import with_copies
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.pages import bring_up_to_date
from colonnade.workflow.raw_files import RawFiles, raw_files
from colonnade.workflow.results import RunResult
from colonnade.workflow.steps import Graph
from colonnade.workflow.summary import write_summary
from colonnade.workflow.walk import Progress, Walk


def run(
    campaign: Path | str,
    *,
    until: str | None = None,
    start_from: str | None = None,
    only: Sequence[str] | str = (),
    workers: int | None = None,
    scheduler: str | None = None,
    verify: bool = False,
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
        Last stage; stage from which on results are made again whatever their state. One of `ASKED_FOR`.
    only : str or sequence of str, optional
        Ids of the tests to run; default all. Free vibrations of their specimens are run with them, as far as their e.
    workers : int, optional
        Processes; default one a core.
    scheduler : str, optional
        Address of a running Dask scheduler, whose workers are used instead. They share the campaign's folder.
    verify : bool, optional
        Read every raw file, result and page again, whatever its size and time; what was altered is made again.
    results : Path or str, optional
        Folder that holds `processed` and `report`, such as one on another disk; default that of the campaign file.
    progress : callable, optional
        Called with each stage that ended, how many tests have, and of how many.

    Returns
    -------
    result : RunResult

    Raises
    ------
    ValueError
        If an argument is not of its kind.
    CampaignError
        If the campaign file is not usable, or a stage or test is not known.
    StoreError
        If another run is under way, or results cannot be written.
    """
    stages = {"until": until, "start_from": start_from}
    check_run(
        campaign,
        stages=stages,
        only=only,
        workers=workers,
        scheduler=scheduler,
        verify=verify,
        results=results,
        progress=progress,
    )
    loaded = load(Path(campaign))
    last, first = _known_stage("until", until) or "report", _known_stage("start_from", start_from)
    if first is not None and ASKED_FOR.index(first) > ASKED_FOR.index(last):
        raise CampaignError(f"from {first} until {last}: the last stage comes before the first.")
    tests = _chosen(loaded, (only,) if isinstance(only, str) else only)
    layout, notices = Layout.of(loaded.folder, results), list[str]()
    with only_run(layout) as name:
        catalogue = Catalogue(layout, verify=verify)
        raw = {test.id: raw_files(loaded, test, catalogue) for test in loaded.tests.values()}
        loaded = _with_copies(loaded, raw)
        if verify:
            notices += remove_altered(layout)
        for test in loaded.tests.values():
            if loaded.review(test.id).excluded:
                clear_behind(layout, results_of(loaded, test), order=-1)
        graph = Graph(loaded, layout, catalogue)
        walk = Walk(graph, name, raw, first, last, workers, scheduler, progress, notices.append)
        walk.through(tests)
        outdated = (walk.stale() - walk.failed.keys()) | (loaded.tests.keys() - set(walk.kept))
        write_summary(loaded, layout, catalogue, outdated=outdated, failed=walk.failed, workers=workers)
        report = None
        if last == "report":
            report = bring_up_to_date(loaded, layout, catalogue, outdated, workers)
        catalogue.save()
    concerning = {name: loaded.concerning(name) for name in loaded.tests}
    return RunResult(tuple(walk.stages), layout.summary_json, report, loaded.warnings, concerning, tuple(notices))


def _with_copies(campaign: Campaign, raw: dict[str, RawFiles]) -> Campaign:
    kept = {name: files for name, files in raw.items() if not campaign.review(name).excluded}
    return with_copies(
        campaign,
        {
            name: {path: None if file.is_empty else file.sha256 for path, file in files.items()}
            for name, files in kept.items()
        },
    )


def _known_stage(name: str, stage: str | None) -> str | None:
    if stage is not None and stage not in ASKED_FOR:
        raise CampaignError(f'{name}: there is no stage "{stage}".{nearest(stage, ASKED_FOR)}')
    return stage


def _chosen(campaign: Campaign, only: Sequence[str]) -> list[str]:
    for name in only:
        if name not in campaign.tests:
            raise CampaignError(f'{campaign.path.name} has no test "{name}".{nearest(name, campaign.tests)}')
        if excluded := campaign.review(name).excluded:
            raise CampaignError(f"{name} is {excluded}. To run it again, take that [[exclude]] out of review.toml.")
    return [name for name in campaign.tests if (not only or name in only) and not campaign.review(name).excluded]
