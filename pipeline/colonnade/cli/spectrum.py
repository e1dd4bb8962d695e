"""`colonnade spectrum` and `fragility`: what motions and pulses do to a column, and how probably it overturns."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import complain, say, show_fields, show_json, show_table, work_progress
from colonnade.cli.common.options import (
    CAMPAIGN,
    WithKeys,
    campaign_argument,
    column_keys,
    json_option,
    one_specimen_option,
    options_of,
    results_option,
    scheduler_option,
    workers_option,
)

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.store.layout import Layout
    from colonnade.workflow.assessing import Assessed
    from colonnade.workflow.executors import Where
    from colonnade.workflow.spectrum import Overturning, Rocking

OF_MOTION = ("unit", "interval", "column", "peak", "baseline", "drift", "slenderness", "periods")
OF_PULSE = ("omega", "cycles", "phase", "largest", "least_width")
"""Options that say nothing with the other of --motion and --pulse, and are refused there."""

SHAPE = ("cycles", "phase")
"""Those of one pulse alone."""


def _spectrum_keys() -> list[click.Option]:
    from colonnade.workflow.spectrum import AskedSpectrum

    return [*column_keys(), *options_of(AskedSpectrum.model_fields, with_defaults=True)]


@click.command(
    cls=WithKeys,
    keys=_spectrum_keys,
    epilog='Example: colonnade spectrum --motion record.AT2 --shape prism --width "1 m" --height "5 m"',
    help=f"""
    Show what a base motion or a pulse does to a column.

    --motion gives the rocking spectrum of a motion: the largest angle over the size of blocks as slender as the column,
    with the intensity measures of the motion. --pulse gives the overturning spectrum of a pulse: the amplitudes from
    which it overturns the column, and up to which it may not, over frequency.

    The column is a specimen of CAMPAIGN, or is given by --shape and its sizes, or by --critical-angle and --p; then no
    campaign is needed. A specimen has the e that its predictions use. Of the real column, or with another α or p, say
    it: by --restitution or [prototype.ID].
    {CAMPAIGN}
    """,
)
@campaign_argument
@click.option("--motion", metavar="FILE|NAME", help="A file, a test that recorded it, or one of [motions].")
@one_specimen_option
@click.option("--out", type=click.Path(path_type=Path), metavar="FILE", help="Draw it: .svg, .pdf or .png.")
@click.option("--data", type=click.Path(path_type=Path), metavar="FILE", help="Write what is drawn as a .csv table.")
@results_option
@json_option
def spectrum(campaign: Path, motion: str | None, results: Path | None, **options: Any) -> int:
    """Compute a spectrum, show and draw it, and return the exit code."""
    pulse = options["pulse"]
    if (motion is None) == (pulse is None):
        raise click.UsageError("Give either --motion or --pulse.")
    _refuse(options, OF_MOTION if pulse else OF_PULSE, "--motion" if pulse else "--pulse")
    if pulse != "mavroeidis-papageorgiou":
        _refuse(options, SHAPE, "--pulse mavroeidis-papageorgiou")
    from colonnade.workflow.real_column import AskedColumn, picked
    from colonnade.workflow.spectrum import AskedSpectrum, overturning_of, rocking_of

    out, data, as_json = (options.pop(name) for name in ("out", "data", "as_json"))
    if out is not None or data is not None:
        from colonnade.figures.files.saving import expect_places

        expect_places(out, data)
    known, layout = _campaign(campaign, results)
    column, asked = AskedColumn.of(options), picked(AskedSpectrum, options)
    if motion is not None:
        return _show(rocking_of(known, layout, column, motion, asked), out, data, as_json)
    return _show(overturning_of(known, layout, column, asked), out, data, as_json)


def _refuse(options: Mapping[str, Any], names: Iterable[str], only: str) -> None:
    """Refuse options that are given but say nothing."""
    for name in names:
        if options[name] not in (None, ()):
            raise click.UsageError(f"--{name.replace('_', '-')} is only for {only}.")


def _campaign(path: Path, results: Path | None) -> tuple[Campaign | None, Layout | None]:
    """Load the campaign if one is named, or if the current folder is one."""
    if path == Path() and not Path("campaign.toml").is_file():
        return None, None
    from colonnade.campaign import load
    from colonnade.store.layout import Layout

    campaign = load(path)
    return campaign, Layout.of(campaign.path, results)


def _show(found: Rocking | Overturning, out: Path | None, data: Path | None, as_json: bool) -> int:
    from colonnade.workflow import spectrum as shown

    written: list[Path] = []
    if out is not None or data is not None:
        from colonnade.figures.files.saving import save

        picture = shown.picture_of(found)
        written = [save(picture, place) for place in (out, data) if place is not None]
    if as_json:
        show_json(shown.record_of(found) | {"figure": out, "data": data})
        return 0
    more = shown.motion_fields(found) if isinstance(found, shown.Rocking) else shown.pulse_fields(found)
    say(shown.verdict(found))
    show_fields([*shown.column_fields(found.column), *more])
    say()
    if isinstance(found, shown.Rocking):
        show_table(shown.MEASURE_HEADS, shown.measure_rows(found))
        say()
        show_table(shown.ROCKING_HEADS, shown.rocking_rows(found))
    else:
        show_table(shown.OVERTURNING_HEADS, shown.overturning_rows(found))
    for place in written:
        say(f"{'data' if place.suffix.lower() == '.csv' else 'figure'}: {place}")
    return 0


def _fragility_keys() -> list[click.Option]:
    from colonnade.campaign.assessment import Assessment

    keys = Assessment.model_fields.keys() - {"specimen", "scale", "measures", "displaced"}
    own = {key: field for key, field in Assessment.model_fields.items() if key in keys}
    return [*column_keys("restitution_range", "friction"), *options_of(own)]


@click.command(
    cls=WithKeys,
    keys=_fragility_keys,
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
@one_specimen_option
@click.option("--out", type=click.Path(path_type=Path), metavar="FILE", help="Draw the curve: .svg, .pdf or .png.")
@click.option("--data", type=click.Path(path_type=Path), metavar="FILE", help="Write what is drawn as a .csv table.")
@workers_option
@scheduler_option
@results_option
@json_option
def fragility(campaign: Path, name: tuple[str, ...], results: Path | None, as_json: bool, **options: Any) -> int:
    """Assess, show the answers, and return the exit code."""
    from colonnade.workflow.executors import Where

    out, data, workers, scheduler = (options.pop(key) for key in ("out", "data", "workers", "scheduler"))
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
            _show_assessed(each)
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
    from colonnade.report.assessments_page import curves

    if assessed.result is None:
        return []
    picture = curves(assessed.name, assessed.record, assessed.result)
    return [save(picture, place) for place in (out, data) if place is not None]


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
