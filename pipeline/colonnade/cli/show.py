"""`colonnade show`: what is known of a campaign, as a table or JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import show_fields, show_json, show_table, shown, shown_ratio
from colonnade.cli.common.findings import line_of
from colonnade.cli.common.options import campaign_and_id, campaign_and_id_argument, json_option, results_option

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.campaign.forms.summary import Summary

Record = dict[str, Any]


@click.group()
def show() -> None:
    """Show what is known: tests, specimens, settings and formats."""


@show.command(epilog="Example: colonnade show tests demo span-2.0")
@campaign_and_id_argument
@results_option
@json_option
def tests(arguments: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """
    Show the tests, measured and predicted, from the last run; with an ID, all that is known of one test.

    A single argument is taken as CAMPAIGN if such a file or folder exists, else as ID.
    """
    from colonnade.store.records.summary import records_of_tests

    campaign, identifier = campaign_and_id(arguments)
    records = {
        name: each.model_dump(mode="json") for name, each in records_of_tests(*_known(campaign, results)).items()
    }
    heads = ("test", "kind", "specimen", "status", "outcome", "|θ|/α", "predicted", "reason or warnings")
    return _show_records("test", records, identifier, heads, _test_cells, as_json=as_json)


@show.command(epilog="Example: colonnade show specimens demo")
@campaign_and_id_argument
@results_option
@json_option
def specimens(arguments: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """
    Show the specimens: geometry, and restitution with its interval, from the last run; with an ID, one specimen.

    A single argument is taken as CAMPAIGN if such a file or folder exists, else as ID.
    """
    from colonnade.store.records.summary import records_of_specimens

    campaign, identifier = campaign_and_id(arguments)
    records = records_of_specimens(*_known(campaign, results))
    heads = ("specimen", "shape", "α rad", "R m", "I₀ kg m²", "p rad/s", "rigid-body e", "e", "source")
    return _show_records("specimen", records, identifier, heads, _specimen_cells, as_json=as_json)


@show.command(epilog="Example: colonnade show settings demo")
@click.argument("campaign", required=False, type=click.Path(path_type=Path), metavar="[CAMPAIGN]")
@json_option
def settings(campaign: Path | None, as_json: bool) -> int:
    """Show every setting: its value in the campaign, its default, and what it does."""
    from colonnade.campaign import FILE_NAME, Processing, load
    from colonnade.campaign.settings import NextSettings
    from colonnade.campaign.settings import settings as all_settings

    if campaign is None and Path(FILE_NAME).is_file():
        campaign = Path()
    known = None if campaign is None else load(campaign)
    rows = list(all_settings(*((known.processing, known.next) if known else (Processing(), NextSettings()))))
    if as_json:
        show_json({row.key: {name: value for name, value in vars(row).items() if name != "key"} for row in rows})
    else:
        cells = [(row.key, shown(row.value), shown(row.default), row.unit, row.description) for row in rows]
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
    """Read a campaign and the summary of its last run, in the folder of results if one is given; nothing is run."""
    from colonnade.campaign import load
    from colonnade.store.layout import Layout
    from colonnade.store.records.summary import read_summary

    campaign = load(path)
    return campaign, read_summary(Layout.of(campaign.folder, results))


def _show_records(
    what: str,
    records: Mapping[str, Record],
    identifier: str | None,
    heads: Sequence[str],
    cells: Callable[[Record], tuple[str, ...]],
    *,
    as_json: bool,
) -> int:
    from colonnade.errors import nearest

    if identifier is not None and identifier not in records:
        raise click.UsageError(f'The campaign has no {what} "{identifier}".{nearest(identifier, records)}')
    if as_json:
        show_json(records if identifier is None else records[identifier])
    elif identifier is None:
        show_table(heads, [(name, *cells(record)) for name, record in records.items()])
    else:
        show_fields(_flat(records[identifier]))
    return 0


def _test_cells(record: Record) -> tuple[str, ...]:
    outcome = record["outcome"] or (f"{record['observed_outcome']} (seen)" if record["observed_outcome"] else "")
    predicted = [
        f"{model}: {' '.join(filter(None, (result['outcome'], shown_ratio(result['peak_ratio']), _until(result))))}"
        for model, result in record["predicted"].items()
        if result.get("outcome")
    ]
    return (
        record["kind"],
        record["specimen"],
        record["status"],
        outcome,
        shown_ratio(record["peak_ratio"]),
        ", ".join(predicted),
        record["reason"] or "; ".join(map(line_of, record["warnings"])),
    )


def _until(predicted: Record) -> str:
    """Write the time up to which a model predicts; empty if it is not known."""
    horizon = predicted.get("horizon")
    return "" if horizon is None else f"up to {horizon:.4g} s"


def _specimen_cells(record: Record) -> tuple[str, ...]:
    from colonnade.store.records.wording import interval

    restitution = record["restitution"]
    value, low, high = (restitution[name] for name in ("value", "low", "high"))
    e = shown(value) if low is None else interval(value, low, high, restitution["level"])
    columns = ("critical_angle", "pole_distance", "inertia", "p", "rigid_restitution")
    geometry = [shown(record[column]) for column in columns]
    return (record["shape"], *geometry, e, restitution["source"] or restitution["reason"] or "")


def _flat(record: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Write a nested record as lines of `a.b` and value, leaving out what is not known."""
    lines: list[tuple[str, str]] = []
    for key, value in record.items():
        if isinstance(value, Mapping):
            lines += _flat(value, f"{prefix}{key}.")
        elif key == "warnings":
            lines += [(f"{prefix}{key}", line_of(each)) for each in value]
        elif value is not None and value != []:
            lines.append((f"{prefix}{key}", shown(value)))
    return lines
