"""`colonnade schema`: the JSON Schemas of the contracts."""

from __future__ import annotations

import rich_click as click

from colonnade.cli.common.console import show_json


@click.command(epilog="Example: colonnade schema campaign > campaign.schema.json")
@click.argument("contract", type=click.Choice(("campaign", "summary", "review", "forecast")))
def schema(contract: str) -> int:
    """
    Write the JSON Schema of campaign.toml, of processed/summary.json, of review.toml or of a file in forecasts/.

    Editors that know TOML schemas complete and check a campaign.toml with it; loggers and scripts in any language can
    check what they write and read with it.
    """
    from colonnade.campaign.forms.schema import json_schema

    show_json(json_schema(contract))
    return 0
