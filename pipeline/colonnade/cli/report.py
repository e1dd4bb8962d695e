"""`colonnade report`: run as far as the stage report."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.options import campaign_argument, work_options
from colonnade.cli.work import work


@click.command(epilog="Example: colonnade report demo")
@campaign_argument
@work_options
def report(
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
    Make the report, after everything it needs.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in.

    Writes report/index.html beside campaign.toml, with a page a test and a specimen; also where tests failed.
    """
    return work(
        campaign,
        until="report",
        only=only,
        workers=workers,
        scheduler=scheduler,
        results=results,
        verify=verify,
        strict=strict,
        as_json=as_json,
    )
