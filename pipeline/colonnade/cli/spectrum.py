"""`colonnade spectrum` and `fragility`: what motions and pulses do to a column, and how probably it overturns."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import (
    complain,
    expect_places,
    saved,
    say,
    say_drawn,
    show_json,
    show_rows,
    show_table,
    work_progress,
)
from colonnade.cli.common.options import (
    Asking,
    campaign_argument,
    column_keys,
    drawing_options,
    opened,
    options_of,
    result_options,
    scheduler_option,
    workers_option,
)

if TYPE_CHECKING:
    from colonnade.workflow.assessing import Assessed
    from colonnade.workflow.executors import Where


def _spectrum_keys() -> list[click.Option]:
    from colonnade.workflow.spectrum import AskedSpectrum

    return [*options_of(AskedSpectrum.model_fields, alone=True), *column_keys()]


@click.command(
    cls=Asking,
    keys=_spectrum_keys,
    epilog='Example: colonnade spectrum --motion record.AT2 --shape prism --width "1 m" --height "5 m"',
)
@campaign_argument
@drawing_options("Draw it: .svg, .pdf or .png.")
@result_options
def spectrum(
    campaign: Path, given: dict[str, Any], results: Path | None, out: Path | None, data: Path | None, as_json: bool
) -> int:
    """
    Show what a base motion or a pulse does to a column.

    --motion gives the rocking spectrum of a motion: the largest angle over the size of blocks as slender as the column,
    with the intensity measures of the motion. --pulse gives the overturning spectrum of a pulse: the amplitudes from
    which it overturns the column, and up to which it may not, over frequency.

    The column is a specimen of CAMPAIGN, or is given by --shape and its sizes, or by --critical-angle and --p; then no
    campaign is needed. A specimen has the e that its predictions use. Of the real column, or with another α or p, say
    it: by --restitution or [prototype.ID].
    {CAMPAIGN}
    """
    from colonnade.workflow.real_column import picked
    from colonnade.workflow.spectrum import AskedSpectrum, spectrum_of

    asked = picked(AskedSpectrum, given)
    expect_places(out, data)
    is_here = campaign != Path() or Path("campaign.toml").is_file()
    found = spectrum_of(asked, given, *(opened(campaign, results) if is_here else (None, None)))
    written = saved(found.draw, out, data)
    if as_json:
        show_json(found.record | {"figure": out, "data": data})
        return 0
    say(found.verdict)
    show_rows(found.fields)
    for heads, rows in found.tables:
        say()
        show_table(heads, rows)
    say_drawn(written)
    return 0


def _fragility_keys() -> list[click.Option]:
    from colonnade.campaign.assessment import Assessment

    keys = Assessment.model_fields.keys() - {"specimen", "scale", "measures", "displaced"}
    own = {key: field for key, field in Assessment.model_fields.items() if key in keys}
    return [*column_keys("restitution_range", "friction"), *options_of(own)]


@click.command(
    cls=Asking,
    keys=_fragility_keys,
    epilog="Example: colonnade fragility demo --name prism",
)
@campaign_argument
@click.option("--name", multiple=True, metavar="NAME", help="Only this assessment of the campaign; may be repeated.")
@drawing_options("Draw the curve: .svg, .pdf or .png.")
@workers_option
@scheduler_option
@result_options
def fragility(
    campaign: Path,
    name: tuple[str, ...],
    given: dict[str, Any],
    out: Path | None,
    data: Path | None,
    workers: int | None,
    scheduler: str | None,
    results: Path | None,
    as_json: bool,
) -> int:
    """
    Say how probably a real column overturns on a set of ground motions.

    {CAMPAIGN} Without options it brings the campaign's [assessments] up to date, as `run` does. With --specimen and
    --records, or options that replace keys of an assessment, it answers a question of your own and stores nothing; the
    files may be anywhere. A column that is not a specimen is given by --shape and its sizes, or by --critical-angle
    and --p, with --restitution; then no campaign is needed.

    An interrupted assessment of the campaign is continued.
    """
    from colonnade.report.assessments_page import curves
    from colonnade.workflow.executors import Where

    expect_places(out, data)
    with work_progress("Assessing") as progress:
        found = _assessed(campaign, name, given, results, Where(workers, scheduler, progress))
    if (out or data) and len(found) > 1:
        raise click.UsageError(f"{len(found)} assessments were found. Name one with --name to draw it.")
    first, result = found[0], found[0].result
    written = [] if result is None else saved(lambda: curves(first.name, first.record, result), out, data)
    if as_json:
        show_json([{"name": each.name, "file": each.path, **dict(each.record)} for each in found])
    else:
        for each in found:
            _show_assessed(each)
        say_drawn(written)
    return int(any(each.record.status == "failed" for each in found))


def _assessed(
    path: Path, names: tuple[str, ...], given: dict[str, Any], results: Path | None, where: Where
) -> list[Assessed]:
    from colonnade.workflow.assessing import assess_campaign, assess_own
    from colonnade.workflow.real_column import needs_specimen

    if not names and not needs_specimen(given):
        return [assess_own(None, None, None, given, where)]
    loaded, layout = opened(path, results)
    if not given:
        return assess_campaign(loaded, layout, names, where)
    if len(names) > 1:
        raise click.UsageError("Options are for one assessment. Name one.")
    base = names[0] if names else next(iter(loaded.assessments)) if len(loaded.assessments) == 1 else None
    return [assess_own(loaded, layout, base, given, where)]


def _show_assessed(assessed: Assessed) -> None:
    from colonnade.report.assessments_page import symbol
    from colonnade.store.records.assessment import level, sentences
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
