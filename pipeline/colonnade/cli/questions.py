"""The questions that a campaign or a column is asked: what comes next, what a model foresees, what overturns it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common import options
from colonnade.cli.common.console import (
    complain,
    expect_places,
    saved,
    say,
    say_drawn,
    show_json,
    show_paragraph,
    show_rows,
    show_table,
    work_progress,
)
from colonnade.errors import count

if TYPE_CHECKING:
    from colonnade.campaign.forms.forecast import ForecastFile
    from colonnade.store.records.advice import Advice
    from colonnade.workflow.asked import Given
    from colonnade.workflow.assessing import Assessed
    from colonnade.workflow.foresee import AskedForecast
    from colonnade.workflow.maps import MapMade, Wanted
    from colonnade.workflow.spectrum import AskedSpectrum


@click.command(
    cls=options.Asking,
    asks="colonnade.workflow.foresee:AskedForecast",
    epilog='Example: colonnade foresee demo --specimen prism --motion "El Centro 1940 NS" --level "0.3 g" --level 1.5x',
)
@options.campaign_argument
@options.result_options
def foresee(campaign: Path, asked: AskedForecast, results: Path | None, as_json: bool) -> None:
    """
    Forecast what a specimen does on a base motion.

    {CAMPAIGN} Run it first: a forecast takes the e that is identified so far.

    Writes a file for each level into forecasts/, which is never changed. After the test `run` scores the last one with
    --test that was made before the raw file of that test was there.
    """
    from colonnade.workflow.foresee import foresee as make

    with work_progress("Foreseeing"):
        made = make(*options.opened(campaign, results), asked)
    if as_json:
        show_json([{"file": path, **forecast.model_dump(by_alias=True)} for path, forecast in made.items()])
        return
    for path, forecast in made.items():
        _show(forecast)
        say(f"forecast: {path}")


def _show(forecast: ForecastFile) -> None:
    """Write what the table must do, and under it what each model foresees, side by side."""
    from colonnade.store.records.forecast import FORESEEN, shown_model, shown_table

    acceleration, velocity, displacement = shown_table(forecast.table)
    show_paragraph(f"{forecast.level}: the table reaches {acceleration}; velocity {velocity}; stroke {displacement}")
    columns = [shown_model(model) for model in forecast.models.values()]
    show_table(("", *forecast.models), list(zip(FORESEEN, *columns, strict=True)))


@click.command(
    "next",
    epilog="Example: colonnade next demo --specimen prism",
)
@options.campaign_argument
@options.specimen_option
@options.result_options
def next_command(campaign: Path, specimen: tuple[str, ...], results: Path | None, as_json: bool) -> None:
    """
    Say which test tells most: the next one, and the others of all specimens by what they tell.

    {CAMPAIGN} It uses the results of the last run. Each advice has its reason, its risk of overturning and what the
    table must do; "enough" means that no test of this kind is needed. A Span is advised at most a fifth above the
    largest that was tested. The settings are in [next], the limits of the table in [table]. Nothing is written.
    """
    from colonnade.workflow.advising import advise
    from colonnade.workflow.product import Catalogue

    loaded, layout = options.opened(campaign, results)
    loaded = loaded.awaiting()
    with work_progress("Looking for the test that tells most"):
        found = advise(loaded, layout, Catalogue(layout), specimen)
    if as_json:
        show_json({"advice": found, "awaited": loaded.awaited})
        return
    _show_advice(found)
    for test, file in loaded.awaited.items():
        show_paragraph(f"{test}: expected: {file}")


def _show_advice(advice: Sequence[Advice]) -> None:
    """Write the test to do next with its reason, then the others."""
    from colonnade.store.records.advice import HEADS

    if not advice:
        say("Nothing to advise: no free vibration, sine test or earthquake has been run.")
        return
    needed = [each for each in advice if not each.is_enough and not each.beyond][:1]
    for each in needed:
        show_paragraph(f"Do this next: {each.what()}")
        show_paragraph(f"Because {each.reason}.")
    if not needed:
        say("No test that the table can do is needed.")
    say()
    show_table(HEADS, [each.row() for each in advice if each not in needed])


@click.command(
    cls=options.Asking,
    asks="colonnade.workflow.spectrum:AskedSpectrum",
    others=options.column_keys,
    epilog='Example: colonnade spectrum --motion record.AT2 --shape prism --width "1 m" --height "5 m"',
)
@options.campaign_argument
@options.drawing_options("Draw it: .svg, .pdf or .png.")
@options.result_options
def spectrum(
    campaign: Path, asked: AskedSpectrum, given: Given, results: Path | None, as_json: bool, **places: Path | None
) -> None:
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
    from colonnade.workflow.spectrum import spectrum_of

    out, data = places["out"], places["data"]
    expect_places(out, data)
    found = spectrum_of(asked, given, *options.opened_if_there(campaign, results))
    drawn = saved(found.draw, out, data)
    if as_json:
        show_json(found.record | {"figure": out, "data": data})
        return
    say(found.verdict)
    show_rows(found.fields)
    for heads, rows in found.tables:
        say()
        show_table(heads, rows)
    say_drawn(drawn)


def _fragility_keys() -> list[click.Option]:
    from colonnade.campaign.assessment import Assessment

    others = ("specimen", "scale", "measures", "displaced")
    own = [key for key in Assessment.model_fields if key not in others]
    return [*options.column_keys("restitution_range", "friction"), *options.options_of(Assessment, own)]


@click.command(
    cls=options.Asking,
    others=_fragility_keys,
    epilog="Example: colonnade fragility demo --name prism",
)
@options.campaign_argument
@click.option("--name", multiple=True, metavar="NAME", help="Only this assessment of the campaign; may be repeated.")
@options.drawing_options("Draw the curve: .svg, .pdf or .png.")
@options.workers_option
@options.scheduler_option
@options.result_options
def fragility(
    campaign: Path,
    name: tuple[str, ...],
    given: Given,
    out: Path | None,
    data: Path | None,
    as_json: bool,
    **choices: Any,
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
    from colonnade.workflow.asked import needs_specimen
    from colonnade.workflow.assessing import assess
    from colonnade.workflow.executors import Where

    expect_places(out, data)
    loaded, layout = options.opened(campaign, choices["results"]) if name or needs_specimen(given) else (None, None)
    with work_progress("Assessing") as progress:
        found = assess(loaded, layout, name, given, Where(choices["workers"], choices["scheduler"], progress))
    if (out or data) and len(found) > 1:
        raise click.UsageError(f"{len(found)} assessments were found. Name one with --name to draw it.")
    first, result = found[0], found[0].result
    drawn = [] if result is None else saved(lambda: curves(first.name, first.record, result), out, data)
    if as_json:
        show_json([{"name": each.name, "file": each.path, **dict(each.record)} for each in found])
    else:
        for each in found:
            _show_assessed(each)
        say_drawn(drawn)
    return int(any(each.record.status == "failed" for each in found))


def _show_assessed(assessed: Assessed) -> None:
    from colonnade.store.records.assessment import deciding, sentences

    record = assessed.record
    verdict, *others = sentences(record)
    of = "" if record.specimen == assessed.name else f" ({record.specimen})"
    say(f"{assessed.name}{of}: {verdict}")
    for sentence in filter(None, (*others, deciding(record))):
        say(f"  {sentence}")
    for kind, said in (("warning", record.warnings), ("note", record.notes)):
        for each in said:
            complain(f"{kind}: {each}")
    if assessed.path is not None:
        say(f"result: {assessed.path}")


@click.command(
    "map",
    cls=options.Asking,
    asks="colonnade.workflow.maps:Wanted",
    epilog="Example: colonnade map demo --specimen prism --omega 1.1 7.8 --ramp 3",
)
@options.campaign_argument
@options.specimen_option
@options.workers_option
@options.scheduler_option
@options.result_options
def map_command(
    campaign: Path, specimen: tuple[str, ...], asked: Wanted, results: Path | None, as_json: bool, **choices: Any
) -> None:
    """
    Compute stability maps over frequency and amplitude, with the measured points on them.

    {CAMPAIGN} Run it first: the map uses the identified restitution, and shows the sine tests by their measured
    outcome.

    An interrupted map is continued. An existing map is only redrawn.

    Writes processed/maps/<SPECIMEN>-<MODEL>.nc, and one picture of the maps of all models; with --responses also
    <SPECIMEN>-<MODEL>-response.nc and its picture.
    """
    from colonnade.workflow.executors import Where
    from colonnade.workflow.maps import make_maps

    with work_progress(f"Mapping by the {' and the '.join(asked.models)} model") as progress:
        made = make_maps(*options.opened(campaign, results), asked, specimen, Where(progress=progress, **choices))
    if as_json:
        show_json(made)
        return
    for each in made:
        say(f"{each.specimen}, {each.model} model: {_how(each)}")
        say(f"{each.kind}: {each.path}")
    for figure in dict.fromkeys(each.figure for each in made):
        say(f"figure: {figure}")


def _how(made: MapMade) -> str:
    from colonnade.workflow.product import NEVER_RUN

    why = f"computed again, {made.because}" if made.because else "up to date"
    why = "computed" if made.because == NEVER_RUN else why
    return f"{count(made.measured, 'measured point')}, e {made.restitution_source}; {why}"


@click.command(epilog="Example: colonnade calibrate demo --specimen prism")
@options.campaign_argument
@options.specimen_option
@options.workers_option
@options.result_options
def calibrate(
    campaign: Path, specimen: tuple[str, ...], workers: int | None, results: Path | None, as_json: bool
) -> int:
    """
    Find the contact damping with which the contact model gives each specimen's restitution.

    {CAMPAIGN} Identify its free vibrations first.

    e is identified from the rocking angle of a free vibration of the model, as from a record. The mean velocity ratio
    of its impacts is shown with it: a contact that bounces also loses energy between impacts, so the two differ. If e
    cannot be identified, as after too few impacts, the mean velocity ratio is used, and it says so.

    Mesh and step are those of the settings (processing.predict.contact). Writes processed/contact/<SPECIMEN>.nc, as a
    run does.
    """
    from colonnade.report.specimens_page import law_facts
    from colonnade.store.records.stored import Stored
    from colonnade.store.results import ResultId
    from colonnade.workflow.calibration import calibrate as calibrated

    made = calibrated(*options.opened(campaign, results), specimen, workers)
    if as_json:
        show_json(made)
    for each in () if as_json else made:
        say("specimen {specimen}: {reason}".format_map(each) if each["reason"] else f"specimen {each['specimen']}")
        if each["path"] is not None:
            stored = Stored()
            stored.add(ResultId(each["specimen"], "contact"), each["path"])
            show_rows(law_facts(stored))
            say("law: {path}".format_map(each))
    return int(any(each["path"] is None for each in made))
