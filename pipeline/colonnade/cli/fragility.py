"""`colonnade fragility`: how probably a real column overturns on a set of ground motions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import complain, say, show_json, show_table
from colonnade.cli.common.options import (
    CAMPAIGN,
    LateChoice,
    campaign_argument,
    column_options,
    json_option,
    plane_models,
    results_option,
    scheduler_option,
    workers_option,
)
from colonnade.cli.common.progress import work_progress

if TYPE_CHECKING:
    from colonnade.workflow.assessing import Assessed
    from colonnade.workflow.executors import Where


@click.command(
    epilog="Example: colonnade fragility demo --name prism",
    help=f"""
    Say how probably a real column overturns on a set of ground motions.

    {CAMPAIGN} Without options it brings the campaign's [assessments] up to date, as `run` does. With --specimen and
    --records, or options that replace keys of an assessment, it answers a question of your own and stores nothing; the
    files may be anywhere. A column that is not a specimen is given by --shape and its sizes, or by --critical-angle
    and --p, with --restitution; then no campaign is needed.

    An interrupted assessment of the campaign is continued.
    """,
)
@campaign_argument
@click.option("--name", multiple=True, metavar="NAME", help="Only this assessment of the campaign; may be repeated.")
@column_options
@click.option(
    "--records", type=click.Path(path_type=Path), metavar="DIR|FILE", help="Ground motions: a folder or a list."
)
@click.option("--restitution-range", type=float, nargs=2, metavar="LOW HIGH", help="Limits between which e is drawn.")
@click.option("--friction", type=float, metavar="MU", help="Friction between the column and what it stands on.")
@click.option("--measure", metavar="ID", help="Measure of intensity over which the records are scaled, such as pgv.")
@click.option(
    "--level", "levels", multiple=True, metavar="LEVEL", help='One level of it, such as "0.4 m/s"; repeat it.'
)
@click.option("--hazard", type=click.Path(path_type=Path), metavar="FILE", help="Annual rates of exceedance, as CSV.")
@click.option("--overturned", type=float, metavar="SHARE", help="Share of α beyond which it counts as overturned.")
@click.option("--model", type=LateChoice(plane_models), help="Model of rocking.")
@click.option("--draws", type=int, metavar="N", help="Draws of e, α, p and friction.")
@click.option("--drift", type=float, metavar="SHARE", help="Largest end velocity over PGV of a record without drift.")
@click.option("--baseline", metavar="METHOD", help="Correct the records: linear, quadratic or highpass(0.1 Hz).")
@click.option("--resamples", type=int, metavar="N", help="Times that the records are drawn again.")
@click.option("--seed", type=int, metavar="N", help="Of all that is drawn.")
@click.option("--out", type=click.Path(path_type=Path), metavar="FILE", help="Draw the curve: .svg, .pdf or .png.")
@click.option("--data", type=click.Path(path_type=Path), metavar="FILE", help="Write what is drawn as a .csv table.")
@workers_option
@scheduler_option
@results_option
@json_option
def fragility(
    campaign: Path,
    name: tuple[str, ...],
    out: Path | None,
    data: Path | None,
    workers: int | None,
    scheduler: str | None,
    results: Path | None,
    as_json: bool,
    **options: Any,
) -> int:
    """Assess, show the answers, and return the exit code."""
    from colonnade.workflow.executors import Where

    if out is not None or data is not None:
        from colonnade.figures.files.saving import expect_places

        expect_places(out, data)
    with work_progress("Assessing") as progress:
        found = _assessed(campaign, name, options, results, Where(workers, scheduler, progress))
    if (out or data) and len(found) > 1:
        raise click.UsageError(f"{len(found)} assessments were found. Name one with --name to draw it.")
    written = _drawn(found[0], out, data) if out or data else []
    if as_json:
        show_json([{"name": each.name, "file": each.path, **each.record.model_dump(mode="json")} for each in found])
    else:
        for each in found:
            _show(each)
        for place in written:
            say(f"{'data' if place.suffix.lower() == '.csv' else 'figure'}: {place}")
    return int(any(each.record.status == "failed" for each in found))


def _assessed(
    path: Path, names: tuple[str, ...], options: dict[str, Any], results: Path | None, where: Where
) -> list[Assessed]:
    from colonnade.campaign import load
    from colonnade.store.layout import Layout
    from colonnade.workflow.assessing import assess_campaign, assess_own
    from colonnade.workflow.real_column import AskedColumn

    column = AskedColumn.of(options)
    given = {key: value for key, value in options.items() if value is not None and value != ()}
    asked = {key: list(value) if isinstance(value, tuple) else value for key, value in given.items()}
    if not names and not column.needs_specimen:
        return [assess_own(None, None, None, column, asked, where)]
    loaded = load(path)
    layout = Layout.of(loaded.path, results)
    if not asked:
        return assess_campaign(loaded, layout, names, where)
    if len(names) > 1:
        raise click.UsageError("Options are for one assessment. Name one.")
    base = names[0] if names else next(iter(loaded.assessments)) if len(loaded.assessments) == 1 else None
    return [assess_own(loaded, layout, base, column, asked, where)]


def _drawn(assessed: Assessed, out: Path | None, data: Path | None) -> list[Path]:
    from colonnade.figures.files.saving import save
    from colonnade.report.assessments_page.page import curves

    if assessed.result is None:
        return []
    picture = curves(assessed.name, assessed.record, assessed.result)
    return [save(picture, place) for place in (out, data) if place is not None]


def _show(assessed: Assessed) -> None:
    from colonnade.report.assessments_page.page import symbol
    from colonnade.store.records.assessment import NOT_COVERED, level, sentences
    from colonnade.units.text import format_percent, number

    record = assessed.record
    verdict, *others = sentences(record)
    of = "" if record.specimen == assessed.name else f" ({record.specimen})"
    say(f"{assessed.name}{of}: {verdict}")
    for sentence in others:
        say(f"  {sentence}")
    for said in record.warnings:
        complain(f"warning: {said}")
    for said in record.notes:
        complain(f"note: {said}")
    if record.status == "failed":
        return
    say(f"  {NOT_COVERED}")
    say()
    rows = [
        (
            *(symbol(each.measure), number(each.deviance), number(each.auc, 2), number(each.scatter, 2)),
            "–" if each.best is None else format_percent(each.best),
        )
        for each in record.measures
    ]
    show_table(("measure", "deviance", "AUC", "scatter of ln peak", "best in"), rows)
    if record.deciding:
        without = (
            f"{each.record} (median without it {level(record.measure, each.median)})" for each in record.deciding
        )
        say(f"The records that change the answer most: {', '.join(without)}.")
    if assessed.path is not None:
        say(f"result: {assessed.path}")
