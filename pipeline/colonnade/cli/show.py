"""`colonnade show` and `schema`: what is known of a campaign, and the JSON Schemas of the contracts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common import options
from colonnade.cli.common.console import say, show_json, show_rows, show_table
from colonnade.cli.common.findings import counted
from colonnade.findings import Severity
from colonnade.units.text import shown

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.campaign.forms.summary import SpecimenSummary, Summary, TestSummary

Record = dict[str, Any]


@click.group(cls=options.Commands)
def show() -> None:
    """Show what is known: tests, specimens, settings and formats."""


@show.command(epilog="Example: colonnade show tests demo span-2.0")
@options.campaign_and_id_argument
@options.result_options
def tests(arguments: tuple[str, ...], results: Path | None, as_json: bool) -> None:
    """
    Show the tests, measured and predicted, from the last run; with an ID, all that is known of one test.

    Peaks are over the critical angle α.

    A single argument is taken as CAMPAIGN if such a file or folder exists, else as ID.
    """
    from colonnade.store.records.summary import records_of_tests

    campaign, identifier = options.campaign_and_id(arguments)
    known, summary = _known(campaign, results)
    records = records_of_tests(known, summary)
    if identifier is None and not as_json:
        show_tests(records, {} if summary is None else summary.specimens)
    else:
        dumped = {name: each.model_dump(mode="json") for name, each in records.items()}
        _show_records("test", dumped, identifier, as_json)


def show_tests(
    tests: Mapping[str, TestSummary], specimens: Mapping[str, SpecimenSummary], last: Mapping[str, str] | None = None
) -> None:
    """
    Write what tests gave, what each model predicts of them with its verdict, and how many findings they have.

    Of a test that is not complete, the `last` stage that ran.
    """
    from colonnade.store.records.wording import LEGEND, measured, predicted

    models = list(dict.fromkeys(model for test in tests.values() for model in predicted(test)))
    rows = []
    for name, test in tests.items():
        level = specimens[test.specimen].restitution.level if test.specimen in specimens else None
        told = measured(test, level)
        if last and told == test.status == "pending":
            told = f"done up to {last[name]}"
        said, found = predicted(test), Counter(each.severity for each in test.warnings)
        del found[Severity.NOTE]
        rows.append((name, told, *(said.get(model, "") for model in models), counted(found)))
    show_table(("test", "measured", *models, "findings"), rows)
    if models:
        say(LEGEND)


@show.command(epilog="Example: colonnade show specimens demo")
@options.campaign_and_id_argument
@options.result_options
def specimens(arguments: tuple[str, ...], results: Path | None, as_json: bool) -> None:
    """
    Show the specimens: geometry, and restitution with its interval, from the last run; with an ID, one specimen.

    A single argument is taken as CAMPAIGN if such a file or folder exists, else as ID.
    """
    from colonnade.store.records.summary import records_of_specimens

    campaign, identifier = options.campaign_and_id(arguments)
    records = records_of_specimens(*_known(campaign, results))
    if identifier is None and not as_json:
        heads = ("specimen", "shape", "α rad", "R m", "I₀ kg m²", "p rad/s", "rigid-body e", "e", "source")
        show_table(heads, [(name, *_specimen_cells(record)) for name, record in records.items()])
    else:
        _show_records("specimen", records, identifier, as_json)


@show.command(epilog="Example: colonnade show settings demo")
@options.campaign_argument
@options.json_option
def settings(campaign: Path, as_json: bool) -> None:
    """Show every setting: its value in the campaign, its default, and what it does."""
    from colonnade.campaign import Processing
    from colonnade.campaign.settings import NextSettings
    from colonnade.campaign.settings import settings as all_settings

    known, _ = options.opened_if_there(campaign, None)
    processing, advice = (known.processing, known.next) if known else (Processing(), NextSettings())
    rows = all_settings(processing, "processing") | all_settings(advice, "next")
    if as_json:
        show_json(rows)
    else:
        cells = [(key, *map(shown, row.values())) for key, row in rows.items()]
        show_table(("setting", "value", "default", "unit", "what it does"), cells)


@show.command(epilog="Example: colonnade show formats --json")
@options.json_option
def formats(as_json: bool) -> None:
    """Show the raw formats that can be read, and the options of each."""
    from colonnade.readers.registry import formats as all_formats

    known = all_formats().values()
    if as_json:
        told = ((each, each.options.model_json_schema().get("properties", {})) for each in known)
        show_json(
            {each.name: {"summary": each.summary, "suffixes": each.suffixes, "options": own} for each, own in told}
        )
        return
    cells = []
    for each in known:
        cells.append((each.name, " ".join(each.suffixes), each.summary))
        cells += [("", name, field.description or "") for name, field in each.options.model_fields.items()]
    show_table(("format", "endings, options", "what it is, what an option says"), cells)


def _known(path: Path, results: Path | None) -> tuple[Campaign, Summary | None]:
    """Read a campaign and the summary of its last run; nothing is run."""
    from colonnade.store.records.summary import read_summary

    campaign, layout = options.opened(path, results)
    return campaign, read_summary(layout)


def _show_records(what: str, records: Mapping[str, Record], identifier: str | None, as_json: bool) -> None:
    from colonnade.errors import nearest
    from colonnade.store.records.wording import lines_of

    if identifier is not None and identifier not in records:
        raise click.UsageError(f'The campaign has no {what} "{identifier}".{nearest(identifier, records)}')
    if as_json:
        show_json(records if identifier is None else records[identifier])
    elif identifier is not None:
        show_rows([(what, identifier), *lines_of(records[identifier])])


def _specimen_cells(record: Record) -> tuple[str, ...]:
    from colonnade.store.records.wording import estimated

    columns = ("critical_angle", "pole_distance", "inertia", "p", "rigid_restitution")
    geometry = [shown(record[column]) for column in columns]
    e = record["restitution"]
    return (record["shape"], *geometry, estimated(e), (e["reason"] if e["value"] is None else e["source"]) or "")


@click.command(epilog="Example: colonnade schema campaign > campaign.schema.json")
@click.argument("contract", type=click.Choice(("campaign", "summary", "review", "forecast")))
def schema(contract: str) -> None:
    """
    Write the JSON Schema of campaign.toml, of processed/summary.json, of review.toml or of a file in forecasts/.

    Editors that know TOML schemas complete and check a campaign.toml with it; loggers and scripts in any language can
    check what they write and read with it.
    """
    from colonnade.campaign.forms.schema import json_schema

    show_json(json_schema(contract))
