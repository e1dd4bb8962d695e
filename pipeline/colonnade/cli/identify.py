"""`colonnade identify`: run as far as the stage restitution."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.options import campaign_argument, work_options
from colonnade.cli.work import work


@click.command(epilog="Example: colonnade identify demo")
@campaign_argument
@work_options
def identify(
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
    Identify the restitution: run up to each specimen's pooled e.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in.

    Writes up to processed/tests/<ID>/restitution.nc of each free vibration, and processed/specimens/<ID>.nc.
    """
    return work(
        campaign,
        until="restitution",
        only=only,
        workers=workers,
        scheduler=scheduler,
        results=results,
        verify=verify,
        strict=strict,
        as_json=as_json,
    )
