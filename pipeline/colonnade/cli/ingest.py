"""`colonnade ingest`: run as far as the stage ingest."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.options import campaign_argument, work_options
from colonnade.cli.work import work


@click.command(epilog="Example: colonnade ingest demo --only free-01")
@campaign_argument
@work_options
def ingest(
    campaign: Path,
    only: tuple[str, ...],
    workers: int | None,
    scheduler: str | None,
    results: Path | None,
    verify: bool,
    strict: bool,
    as_json: bool,
) -> int:
    """
    Read the raw files into SI channels with quality flags.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in.

    Writes processed/tests/<ID>/recorded.nc.
    """
    return work(
        campaign,
        until="ingest",
        only=only,
        workers=workers,
        scheduler=scheduler,
        results=results,
        verify=verify,
        strict=strict,
        as_json=as_json,
    )
