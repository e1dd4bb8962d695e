"""`colonnade predict`: run as far as the stage predict."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.options import campaign_argument, work_options
from colonnade.cli.work import work


@click.command(epilog="Example: colonnade predict demo --only span-2.5")
@campaign_argument
@work_options
def predict(
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
    Run the models on the recorded base motion, after everything they need.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in.

    Writes up to processed/tests/<ID>/predicted-<MODEL>.nc.
    """
    return work(
        campaign,
        until="predict",
        only=only,
        workers=workers,
        scheduler=scheduler,
        results=results,
        verify=verify,
        strict=strict,
        as_json=as_json,
    )
