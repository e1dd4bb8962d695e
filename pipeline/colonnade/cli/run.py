"""`colonnade run`: all stages and the report, only what is out of date."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.options import campaign_argument, work_options
from colonnade.cli.work import STAGES, work


@click.command(epilog="Example: colonnade run demo --from predict --only span-2.0")
@campaign_argument
@click.option("--until", type=click.Choice(STAGES), metavar="STAGE", help="Stop after this stage.")
@click.option("--from", "start_from", type=click.Choice(STAGES), metavar="STAGE", help="Redo it and what follows.")
@work_options
def run(
    campaign: Path,
    until: str | None,
    start_from: str | None,
    only: tuple[str, ...],
    workers: int | None,
    scheduler: str | None,
    results: Path | None,
    verify: bool,
    strict: bool,
    as_json: bool,
) -> int:
    """
    Run all stages and the report, only what is out of date.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in. Every result that was redone is listed
    with the reason. A test that fails does not stop the others; the exit code is then 1.

    Stages are ingest, condition, rocking, restitution, predict, ensemble, compare and report.
    """
    return work(
        campaign,
        until=until,
        start_from=start_from,
        only=only,
        workers=workers,
        scheduler=scheduler,
        results=results,
        verify=verify,
        strict=strict,
        as_json=as_json,
    )
