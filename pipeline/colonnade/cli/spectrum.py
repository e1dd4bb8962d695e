"""`colonnade spectrum` and `fragility`: what motions and pulses do to a column, and how probably it overturns."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import complain, say, say_drawn, show_json, show_rows, show_table, work_progress
from colonnade.cli.common.options import (
    WithKeys,
    campaign_argument,
    column_keys,
    data_option,
    file_option,
    one_specimen_option,
    opened,
    options_of,
    result_options,
    scheduler_option,
    workers_option,
)

if TYPE_CHECKING:
    from colonnade.figures.files.output import Picture
    from colonnade.workflow.assessing import Assessed
    from colonnade.workflow.executors import Where

ONLY_FOR = {
    "--motion": ("unit", "interval", "column", "peak", "baseline", "drift", "slenderness", "periods"),
    "--pulse": ("omega", "cycles", "phase", "largest", "least_width"),
    "--pulse mavroeidis-papageorgiou": ("cycles", "phase"),
}
"""Options that say nothing without another, and are then refused."""


def _spectrum_keys() -> list[click.Option]:
    from colonnade.workflow.spectrum import AskedSpectrum

    return [*column_keys(), *options_of(AskedSpectrum.model_fields, with_defaults=True)]


@click.command(
    cls=WithKeys,
    keys=_spectrum_keys,
    epilog='Example: colonnade spectrum --motion record.AT2 --shape prism --width "1 m" --height "5 m"',
)
@campaign_argument
@click.option("--motion", metavar="FILE|NAME", help="A file, a test that recorded it, or one of [motions].")
@one_specimen_option
@file_option("--out", "Draw it: .svg, .pdf or .png.")
@data_option
@result_options
def spectrum(
    campaign: Path, motion: str | None, results: Path | None, out: Path | None, data: Path | None, **options: Any
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
    pulse = options["pulse"]
    if (motion is None) == (pulse is None):
        raise click.UsageError("Give either --motion or --pulse.")
    asked_for = ("--motion",) if pulse is None else ("--pulse", f"--pulse {pulse}")
    for other, names in ONLY_FOR.items():
        for name in names:
            if other not in asked_for and options[name] not in (None, ()):
                raise click.UsageError(f"--{name.replace('_', '-')} is only for {other}.")
    from colonnade.workflow.real_column import given_of, picked
    from colonnade.workflow.spectrum import AskedSpectrum, Overturning, Rocking, overturning_of, rocking_of

    _expect_places(out, data)
    is_here = campaign != Path() or Path("campaign.toml").is_file()
    known, layout = opened(campaign, results) if is_here else (None, None)
    column, asked = given_of(options), picked(AskedSpectrum, options)
    found: Rocking | Overturning
    if motion is not None:
        found = rocking_of(known, layout, column, motion, asked)
    else:
        found = overturning_of(known, layout, column, asked)
    written = _saved(found.picture, out, data)
    if options["as_json"]:
        show_json(found.record() | {"figure": out, "data": data})
        return 0
    say(found.verdict())
    show_rows(found.fields())
    for heads, rows in found.tables():
        say()
        show_table(heads, rows)
    say_drawn(written)
    return 0


def _expect_places(out: Path | None, data: Path | None) -> None:
    """Refuse places for a picture and its table before the work is done; the module of figures loads matplotlib."""
    if out or data:
        from colonnade.figures.files.saving import expect_places

        expect_places(out, data)


def _saved(draw: Callable[[], Picture], *places: Path | None) -> list[Path]:
    """Write a picture and its table where they are asked for."""
    if not any(places):
        return []
    from colonnade.figures.files.saving import save

    picture = draw()
    return [save(picture, place) for place in places if place is not None]


def _fragility_keys() -> list[click.Option]:
    from colonnade.campaign.assessment import Assessment

    keys = Assessment.model_fields.keys() - {"specimen", "scale", "measures", "displaced"}
    own = {key: field for key, field in Assessment.model_fields.items() if key in keys}
    return [*column_keys("restitution_range", "friction"), *options_of(own)]


@click.command(
    cls=WithKeys,
    keys=_fragility_keys,
    epilog="Example: colonnade fragility demo --name prism",
)
@campaign_argument
@click.option("--name", multiple=True, metavar="NAME", help="Only this assessment of the campaign; may be repeated.")
@one_specimen_option
@file_option("--out", "Draw the curve: .svg, .pdf or .png.")
@data_option
@workers_option
@scheduler_option
@result_options
def fragility(campaign: Path, name: tuple[str, ...], results: Path | None, as_json: bool, **options: Any) -> int:
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

    out, data, workers, scheduler = (options.pop(key) for key in ("out", "data", "workers", "scheduler"))
    _expect_places(out, data)
    with work_progress("Assessing") as progress:
        found = _assessed(campaign, name, options, results, Where(workers, scheduler, progress))
    if (out or data) and len(found) > 1:
        raise click.UsageError(f"{len(found)} assessments were found. Name one with --name to draw it.")
    first, result = found[0], found[0].result
    written = [] if result is None else _saved(lambda: curves(first.name, first.record, result), out, data)
    if as_json:
        show_json([{"name": each.name, "file": each.path, **each.record.model_dump(mode="json")} for each in found])
    else:
        for each in found:
            _show_assessed(each)
        say_drawn(written)
    return int(any(each.record.status == "failed" for each in found))


def _assessed(
    path: Path, names: tuple[str, ...], options: dict[str, Any], results: Path | None, where: Where
) -> list[Assessed]:
    from colonnade.workflow.assessing import assess_campaign, assess_own
    from colonnade.workflow.real_column import given_of, needs_specimen

    given = given_of(options)
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
