"""Run a campaign: tests in parallel, specimens in between, summary and report at the end."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from dataclasses import replace
from pathlib import Path

from colonnade.campaign import Campaign, load
from colonnade.errors import CampaignError, nearest
from colonnade.interruption import expect_none
from colonnade.store.layout import Layout
from colonnade.store.results import ASKED_FOR, models_of
from colonnade.workflow.arguments import check_run
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.chain import Chain, Phase, advance, clear_behind, is_fresh
from colonnade.workflow.copies import with_copies
from colonnade.workflow.execution.cluster import Tell
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.execution.processes import execute
from colonnade.workflow.freshness import RawIndex, remove_altered, report_key, source_hash
from colonnade.workflow.pages import WrittenPages
from colonnade.workflow.pooling import pool
from colonnade.workflow.results import RunResult, StageRun
from colonnade.workflow.steps import CONTACT, contact_step
from colonnade.workflow.summary import write_summary

Progress = Callable[[StageRun, int, int], None]
Places = tuple[int | None, str | None]
"""Where tests are worked on: number of processes, and the address of a scheduler in their place."""


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
        raise CampaignError(f"from {first} until {last}: the stage to stop at comes before the one to start from.")
    tests = _chosen(loaded, (only,) if isinstance(only, str) else only)
    layout, places = Layout.of(loaded.folder, results), (workers, scheduler)
    notices: list[str] = []
    with only_run(layout) as this_run:
        index = RawIndex(layout, verify=verify)
        raw = {
            name: index.look(
                (path, loaded.setups[test.setup].recorders[recorder].file) for recorder, path in test.files.items()
            )
            for name, test in loaded.tests.items()
        }
        index.save()
        loaded = with_copies(
            loaded,
            {
                name: {path: file.sha256 if file.size else None for path, file in files.items()}
                for name, files in raw.items()
                if not loaded.review(name).excluded
            },
        )
        catalogue = Catalogue(layout, verify=verify)
        if verify:
            notices += remove_altered(layout)
        for name in loaded.tests:
            if loaded.review(name).excluded:
                clear_behind(loaded, layout, name, order=-1)

        def chains(names: Iterable[str], phase: Phase, until: str = last) -> list[Chain]:
            return [
                Chain.of(loaded, layout, name, phase=phase, until=until, run=this_run, redo_from=first, raw=raw[name])
                for name in names
            ]

        def walked(names: Iterable[str], phase: Phase) -> Iterator[StageRun]:
            return _walked(chains(names, phase), catalogue, places, progress, notices.append)

        runs = list(walked(tests, "measuring"))
        if ASKED_FOR.index(last) >= ASKED_FOR.index("predict"):
            asked = set(tests)
            runs += walked([name for name in _free_vibrations(loaded, tests) if name not in asked], "measuring")
        if ASKED_FOR.index(last) >= ASKED_FOR.index("restitution"):
            runs += pool(loaded, layout, catalogue.attributes, redo_from=first)
        if ASKED_FOR.index(last) >= ASKED_FOR.index("predict"):
            unpooled = _reasons(runs, of_specimens=True)
            runs += _calibrate(
                loaded, layout, [name for name in tests if loaded.tests[name].specimen not in unpooled], first
            )
        failed = _reasons(runs, of_specimens=False)
        unknown = _reasons(runs, of_specimens=True)
        if ASKED_FOR.index(last) >= ASKED_FOR.index("predict"):
            ready = []
            for name in tests:
                if (specimen := loaded.tests[name].specimen) in unknown:
                    clear_behind(loaded, layout, name, ASKED_FOR.index("restitution"))
                    failed.setdefault(name, f"specimen {specimen}: {unknown[specimen]}")
                elif name not in failed:
                    ready.append(name)
            runs += walked(ready, "predicting")
        failed |= _reasons(runs, of_specimens=False)
        kept = [name for name in loaded.tests if not loaded.review(name).excluded]
        whole = (*chains(kept, "measuring", "report"), *chains(kept, "predicting", "report"))
        look = catalogue.attributes
        stale = {chain.test for chain in whole if is_fresh(replace(chain, redo_from=None), look) is None}
        outdated = (stale - failed.keys()) | (loaded.tests.keys() - set(kept))
        write_summary(loaded, layout, catalogue, outdated=outdated, failed=failed)
        report = _report(loaded, layout, catalogue, outdated, verify=verify) if last == "report" else None
        catalogue.save()
    concerning = {name: loaded.concerning(name) for name in loaded.tests}
    return RunResult(tuple(runs), layout.summary_json, report, loaded.warnings, concerning, tuple(notices))


def _report(campaign: Campaign, layout: Layout, catalogue: Catalogue, outdated: Set[str], *, verify: bool) -> Path:
    """Build the pages, unless those that are there are whole and show just this."""
    key = report_key(campaign, layout, outdated, catalogue.attributes)
    pages = WrittenPages(layout, verify=verify)
    if pages.show(key):
        return layout.report
    from colonnade.report import build
    from colonnade.report.pages import addresses

    pages.remove_altered()
    page = build(campaign, layout, outdated, code=source_hash(without=("cli", "laboratory")))
    pages.save(key, addresses(campaign))
    return page


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


def _free_vibrations(campaign: Campaign, tests: Sequence[str]) -> list[str]:
    """Ids of the free vibrations of these tests' specimens: predictions take their restitution."""
    specimens = {campaign.tests[name].specimen for name in tests}
    return [
        name
        for name, test in campaign.tests.items()
        if test.kind == "free-vibration" and test.specimen in specimens and not campaign.review(name).excluded
    ]


def _walked(
    chains: Sequence[Chain], catalogue: Catalogue, places: Places, progress: Progress | None, tell: Tell
) -> Iterator[StageRun]:
    """Walk the chains, those with nothing to do here and the others in worker processes."""
    done = 0
    waiting = []
    for chain in chains:
        expect_none()
        standing = is_fresh(chain, catalogue.attributes)
        if standing is None:
            waiting.append(chain)
            continue
        done += 1
        yield from _told(standing, done, len(chains), progress)
    for runs in execute(waiting, *places, tell):
        done += 1
        yield from _told(runs, done, len(chains), progress)


def _told(runs: list[StageRun], done: int, total: int, progress: Progress | None) -> list[StageRun]:
    if progress is not None:
        for stage in runs:
            progress(stage, done, total)
    return runs


def _reasons(runs: Iterable[StageRun], *, of_specimens: bool) -> dict[str, str]:
    """Why tests, or specimens, failed."""
    return {
        stage.subject: stage.reason
        for stage in runs
        if stage.action == "failed" and (stage.stage in ("specimen", CONTACT)) == of_specimens
    }


def _calibrate(campaign: Campaign, layout: Layout, tests: Sequence[str], redo_from: str | None) -> list[StageRun]:
    """Bring the laws of contact up to date of the specimens whose tests are predicted by that model."""
    asked = {test.specimen for test in (campaign.tests[name] for name in tests) if CONTACT in models_of(campaign, test)}
    return [
        advance(campaign, layout, name, contact_step(campaign, layout, name), redo_from=redo_from, raw={})
        for name in campaign.specimens
        if name in asked
    ]
