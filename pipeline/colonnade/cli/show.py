"""`colonnade show` and `schema`: what is known of a campaign, and the JSON Schemas of the contracts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_rows, show_table, shown
from colonnade.cli.common.findings import counted, line_of
from colonnade.cli.common.options import (
    campaign_and_id,
    campaign_and_id_argument,
    campaign_argument,
    json_option,
    opened,
    opened_if_there,
    result_options,
)
from colonnade.findings import Severity
from colonnade.units.text import interval

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.campaign.forms.summary import SpecimenSummary, Summary, TestSummary

Record = dict[str, Any]


@click.group()
def show() -> None:
    """Show what is known: tests, specimens, settings and formats."""


@show.command(epilog="Example: colonnade show tests demo span-2.0")
@campaign_and_id_argument
@result_options
def tests(arguments: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """
    Show the tests, measured and predicted, from the last run; with an ID, all that is known of one test.

    Peaks are over the critical angle α.

    A single argument is taken as CAMPAIGN if such a file or folder exists, else as ID.
    """
    from colonnade.store.records.summary import records_of_tests

    campaign, identifier = campaign_and_id(arguments)
    known, summary = _known(campaign, results)
    records = records_of_tests(known, summary)
    if identifier is None and not as_json:
        show_tests(records, {} if summary is None else summary.specimens)
        return 0
    return _show_records(
        "test", {name: each.model_dump(mode="json") for name, each in records.items()}, identifier, as_json
    )


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
@campaign_and_id_argument
@result_options
def specimens(arguments: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """
    Show the specimens: geometry, and restitution with its interval, from the last run; with an ID, one specimen.

    A single argument is taken as CAMPAIGN if such a file or folder exists, else as ID.
    """
    from colonnade.store.records.summary import records_of_specimens

    campaign, identifier = campaign_and_id(arguments)
    records = records_of_specimens(*_known(campaign, results))
    if identifier is None and not as_json:
        heads = ("specimen", "shape", "α rad", "R m", "I₀ kg m²", "p rad/s", "rigid-body e", "e", "source")
        show_table(heads, [(name, *_specimen_cells(record)) for name, record in records.items()])
        return 0
    return _show_records("specimen", records, identifier, as_json)


@show.command(epilog="Example: colonnade show settings demo")
@campaign_argument
@json_option
def settings(campaign: Path, as_json: bool) -> int:
    """Show every setting: its value in the campaign, its default, and what it does."""
    from colonnade.campaign import Processing
    from colonnade.campaign.settings import NextSettings
    from colonnade.campaign.settings import settings as all_settings

    known, _ = opened_if_there(campaign, None)
    processing, advice = (known.processing, known.next) if known else (Processing(), NextSettings())
    rows = all_settings(processing, "processing") | all_settings(advice, "next")
    if as_json:
        show_json(rows)
    else:
        cells = [
            (key, shown(row["value"]), shown(row["default"]), row["unit"], row["description"])
            for key, row in rows.items()
        ]
        show_table(("setting", "value", "default", "unit", "what it does"), cells)
    return 0


@show.command(epilog="Example: colonnade show formats --json")
@json_option
def formats(as_json: bool) -> int:
    """Show the raw formats that can be read, and the options of each."""
    from colonnade.readers.registry import formats as all_formats

    known = all_formats().values()
    if as_json:
        show_json(
            {
                each.name: {
                    "summary": each.summary,
                    "suffixes": each.suffixes,
                    "options": each.options.model_json_schema().get("properties", {}),
                }
                for each in known
            }
        )
        return 0
    cells = [(each.name, " ".join(each.suffixes), each.summary) for each in known]
    show_table(("format", "usual endings", "what it is"), cells)
    options = [
        (each.name, name, field.description or "")
        for each in known
        for name, field in each.options.model_fields.items()
    ]
    show_table(("format", "option", "what it says"), options)
    return 0


def _known(path: Path, results: Path | None) -> tuple[Campaign, Summary | None]:
    """Read a campaign and the summary of its last run; nothing is run."""
    from colonnade.store.records.summary import read_summary

    campaign, layout = opened(path, results)
    return campaign, read_summary(layout)


def _show_records(what: str, records: Mapping[str, Record], identifier: str | None, as_json: bool) -> int:
    from colonnade.errors import nearest

    if identifier is not None and identifier not in records:
        raise click.UsageError(f'The campaign has no {what} "{identifier}".{nearest(identifier, records)}')
    if as_json:
        show_json(records if identifier is None else records[identifier])
    elif identifier is not None:
        show_rows([(what, identifier), *_flat(records[identifier])])
    return 0


def _specimen_cells(record: Record) -> tuple[str, ...]:
    columns = ("critical_angle", "pole_distance", "inertia", "p", "rigid_restitution")
    geometry = [shown(record[column]) for column in columns]
    e = record["restitution"]
    return (record["shape"], *geometry, _estimate(e), (e["reason"] if e["value"] is None else e["source"]) or "")


def _estimate(e: Mapping[str, Any]) -> str:
    """Write a coefficient of restitution with its interval, if it has one."""
    return shown(e["value"]) if e["low"] is None else interval(e["value"], e["low"], e["high"], e.get("level"))


def _flat(record: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Write a nested record as lines of `a.b` and value, leaving out what is not known."""
    lines: list[tuple[str, str]] = []
    for key, value in record.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            is_estimate = {"value", "low", "high"} <= value.keys()
            lines += [(name, _estimate(value))] if is_estimate and value["value"] is not None else []
            left = {each: of for each, of in value.items() if not is_estimate or each not in ESTIMATE}
            lines += _flat(left, f"{name}.")
        elif key == "warnings":
            lines += [(name, line_of(each)) for each in value]
        elif value is not None and value != []:
            lines.append((name, _with_unit(key, value)))
    return lines


ESTIMATE = ("value", "low", "high", "level")
"""Keys of a number with its interval."""

SMALL = {"m": "mm", "rad": "mrad"}
"""Units of values below 0.1."""


def _with_unit(key: str, value: object) -> str:
    unit = _units().get(key, "")
    if isinstance(value, float) and unit in SMALL and 0.0 < abs(value) < 0.1:
        value, unit = round(1000 * value, 4), SMALL[unit]
    return f"{shown(value)} {unit}".rstrip()


@cache
def _units() -> dict[str, str]:
    """Give the units of keys of the summary; all other numbers have none."""
    from colonnade.campaign.forms.schema import json_schema
    from colonnade.campaign.specimen import OUTER_DIMENSIONS

    forms = json_schema("summary")["$defs"].values()
    said = {key: field for form in forms for key, field in form.get("properties", {}).items() if "unit" in field}
    return {key: field["unit"] for key, field in said.items()} | dict.fromkeys(OUTER_DIMENSIONS, "m")


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
